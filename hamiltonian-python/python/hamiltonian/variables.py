"""The variables of a system: their names and the shape of its arrays."""

from __future__ import annotations

import math

import numpy as np

from . import arrays

#: Names of coordinates, of momenta, of velocities or None, and extents.
Group = tuple[str, str, "str | None", "list[int]"]


class Variables:
    """The names of coordinates and momenta, and the shape of arrays of them."""

    shape: tuple[int, ...]
    """The shape of q and p: that of the only array, or the number of coordinates."""
    coordinates: tuple[str, ...]
    """The names of the coordinates."""
    momenta: tuple[str, ...]
    """The names of their momenta."""
    velocities: tuple[str, ...]
    """The names of their velocities, of a Lagrangian; otherwise none."""

    def __init__(self, groups: list[Group]):
        self._extents = [tuple(extents) for *_, extents in groups]
        only = len(groups) == 1 and self._extents[0]
        self.shape = only or (sum(map(math.prod, self._extents)),)
        self.coordinates = tuple(name for name, *_ in groups)
        self.momenta = tuple(name for _, name, *_ in groups)
        self.velocities = tuple(name for *_, name, _ in groups if name is not None)

    def group(self, points: np.ndarray, number: int) -> np.ndarray:
        """One group of coordinates of points, or of their momenta."""
        leading = points.shape[: points.ndim - len(self.shape)]
        before = sum(map(math.prod, self._extents[:number]))
        extents = self._extents[number]
        return points.reshape(*leading, -1)[..., before : before + math.prod(extents)].reshape(*leading, *extents)

    def points(self, q, p, t) -> tuple[tuple[int, ...], tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """The leading axes of all points, and q, p and t as rows."""
        shape, axes = self.shape, len(self.shape)
        q = arrays.points("q", self.number_or_row(arrays.numbers("q", q)), shape)
        p = arrays.points("p", self.number_or_row(arrays.numbers("p", p)), shape)
        t = arrays.numbers("t", t)
        leading = arrays.together(q=q.shape[: q.ndim - axes], p=p.shape[: p.ndim - axes], t=t.shape)
        times = arrays.rows(t, leading, ())[:, 0]
        return leading, (arrays.rows(q, leading, shape), arrays.rows(p, leading, shape), times)

    def number_or_row(self, value: np.ndarray) -> np.ndarray:
        """The value; a number for a point of one coordinate."""
        return value.reshape(1) if self.shape == (1,) and value.ndim == 0 else value

    def __repr__(self) -> str:
        return f"({', '.join(self.coordinates)}; {', '.join(self.momenta)}) of shape {self.shape}"
