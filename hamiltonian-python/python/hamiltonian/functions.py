"""Functions with data: the values of parameters ``V: fn(r)``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import arrays
from ._hamiltonian import Function as _Function


class Spline:
    """The cubic spline through values at knots, a function of one number.

    It is straight at both ends, or has the ``slopes`` there, or is ``periodic``; a periodic one repeats its first value at
    the last knot. Outside of the knots a spline that is not periodic is NaN, so a run that leaves them ends with an error.

    >>> from hamiltonian import define
    >>> well = define("struct Well { V: fn(r) } H(r; p) = p^2/2 + V(r)", V=Spline([0, 1, 2, 3, 4], [4, 1, 0, 1, 4]))
    >>> float(well.H(3.0, 0.0))
    1.0

    Raises:
        ValueError: The knots do not increase, there are too few, or the numbers of knots and values differ.
    """

    def __init__(self, knots: ArrayLike, values: ArrayLike, slopes: ArrayLike | None = None, periodic: bool = False):
        self.knots, self.values = (_row(name, value) for name, value in (("knots", knots), ("values", values)))
        self.slopes = None if slopes is None else _pair("slopes", slopes)
        self.periodic = bool(periodic)
        if self.slopes is not None and self.periodic:
            raise ValueError("a periodic spline has no `slopes`")
        self._own = _Function.spline(self.knots, self.values, self.slopes, self.periodic)

    def __call__(self, x: ArrayLike) -> np.ndarray:
        """The values at x."""
        x = arrays.numbers("x", x)
        return self._own.values(x.reshape(-1, 1)).reshape(x.shape)[()]

    def __reduce__(self):
        return Spline, (self.knots, self.values, self.slopes, self.periodic)

    def __repr__(self) -> str:
        return f"Spline through {len(self.knots)} knots from {self.knots[0]:.6g} to {self.knots[-1]:.6g}"


class Grid:
    """The bicubic spline through the values on a regular grid in the plane, a function of two numbers.

    ``values[i, j]`` is the value at ``origin + (i*spacing[0], j*spacing[1])``. A ``periodic`` grid repeats in both
    directions; another one is NaN outside of its points.

    Raises:
        ValueError: There are too few points, or a spacing is not positive.
    """

    def __init__(self, origin: ArrayLike, spacing: ArrayLike, values: ArrayLike, periodic: bool = False):
        self.origin, self.spacing = _pair("origin", origin), _pair("spacing", spacing)
        self.values = arrays.finite("values", values)
        if self.values.ndim != 2:
            raise ValueError(f"`values` must have two axes, found {self.values.ndim}")
        self.periodic = bool(periodic)
        self._own = _Function.grid(self.origin, self.spacing, self.values, self.periodic)

    def __call__(self, x: ArrayLike, y: ArrayLike) -> np.ndarray:
        """The values at the points (x, y), whose axes are broadcast."""
        x, y = np.broadcast_arrays(arrays.numbers("x", x), arrays.numbers("y", y))
        points = np.stack([x.ravel(), y.ravel()], axis=-1)
        return self._own.values(points).reshape(x.shape)[()]

    def __reduce__(self):
        return Grid, (self.origin, self.spacing, self.values, self.periodic)

    def __repr__(self) -> str:
        return f"Grid of {self.values.shape[0]} × {self.values.shape[1]} values"


def _row(name: str, value: ArrayLike) -> np.ndarray:
    row = arrays.finite(name, value)
    if row.ndim != 1:
        raise ValueError(f"`{name}` must be a list of numbers, found an array of shape {row.shape}")
    return row


def _pair(name: str, value: ArrayLike) -> tuple[float, float]:
    pair = arrays.finite(name, value)
    if pair.shape != (2,):
        raise ValueError(f"`{name}` must be two numbers, found an array of shape {pair.shape}")
    return float(pair[0]), float(pair[1])
