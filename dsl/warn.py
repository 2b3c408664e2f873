"""Warnings: what is surely not meant, told once a model is without faults."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.scope import Build, Instance


def warn(made: list[Instance], model: checked.Model, build: Build) -> None:
    """Report what a sound model says in vain."""
