"""Scenes with impacts, in the plane and in space, judged by the laws of impact in plain numpy.

`scene` describes bodies, contacts, joints and percussions and writes their text; `rows` gives their
gaps and directions; `plane` and `space` draw scenes; `keller` computes the impact of one contact;
`check` holds results against the laws.
"""
