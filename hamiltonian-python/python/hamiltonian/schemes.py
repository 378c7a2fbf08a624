"""The names of the schemes."""

from __future__ import annotations

from typing import NamedTuple

from . import _hamiltonian


class Scheme(NamedTuple):
    """A scheme of the library."""

    name: str
    """The name, which runs take."""
    order: int
    """The error of a trajectory is O(step^order)."""
    source: str
    """Author, year, equation, DOI."""
    in_ensembles: bool
    """True if ensembles take it too."""


def schemes() -> tuple[Scheme, ...]:
    """All schemes.

    >>> [scheme.order for scheme in schemes() if scheme.name == "GaussNystrom8"]
    [16]
    """
    return tuple(Scheme(*fields) for fields in _hamiltonian.schemes())
