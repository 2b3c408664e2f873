"""Liaisons: the motions they leave, what they lock, and the reactions of that."""
