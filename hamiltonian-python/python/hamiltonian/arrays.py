"""Checks of numbers and arrays that a user gives.

Every function takes the name of the argument, which the exception shows.
"""

from __future__ import annotations

import math

import numpy as np


def numbers(name: str, value) -> np.ndarray:
    """The value as an array of float64, row after row; a ``TypeError`` or ``ValueError`` if it is no such array."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise ValueError(f"`{name}` has masked elements, and must have numbers alone")
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(f"`{name}` has rows of different lengths") from None
    if array.dtype == object:
        array = whole_numbers(name, array)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"`{name}` must be a real number or an array of them, found {described(value, array)}")
    return np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)


def whole_numbers(name: str, array: np.ndarray) -> np.ndarray:
    """Numbers that NumPy takes for objects, such as those of SymPy and ``fractions``, as float64."""
    try:
        # `None` would be NaN.
        if any(element is None or isinstance(element, str) for element in array.flat):
            raise TypeError
        return array.astype(np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"`{name}` must be a real number or an array of them, found objects that are none") from None
    except OverflowError:
        raise ValueError(f"`{name}` has a number outside the range of float64") from None


def described(value, array: np.ndarray) -> str:
    """The type of a value that is no number, in words."""
    if array.ndim == 0:
        return f"a value of type {type(value).__name__}"
    return f"an array of {array.dtype}"


def finite(name: str, value) -> np.ndarray:
    """An array without NaN and infinities."""
    array = numbers(name, value)
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        place = f" at index {index if len(index) > 1 else index[0]}" if index else ""
        raise ValueError(f"`{name}` is {array[index]}{place}, and must be finite")
    return array


def number(name: str, value) -> float:
    """A finite number."""
    array = finite(name, value)
    if array.ndim != 0:
        raise ValueError(f"`{name}` must be a number, found an array of shape {array.shape}")
    return float(array)


#: From here on, not every whole number is one of float64.
MOST = 2**53


def count(name: str, value) -> int:
    """A whole number that is not negative."""
    size = number(name, value)
    if not 0 <= size < MOST or not size.is_integer():
        raise ValueError(f"`{name}` must be a whole number from 0 to 2^53, found {value}")
    return int(size)


def point(name: str, value: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """One point of this shape. A number stands for an array of equal numbers."""
    if value.shape != shape and value.ndim != 0:
        raise ValueError(f"`{name}` must have the shape {shape}, found {value.shape}")
    return np.ascontiguousarray(np.broadcast_to(value, shape))


def points(name: str, value: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Points of this shape along the leading axes. A number stands for a point of equal numbers."""
    if value.ndim == 0:
        return np.broadcast_to(value, shape)
    if value.ndim < len(shape) or value.shape[value.ndim - len(shape) :] != shape:
        leading = ", ".join(["…", *map(str, shape)])
        raise ValueError(f"`{name}` must have the shape ({leading}), found {value.shape}")
    return value


def together(**shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that the leading axes of all arguments have together."""
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        shown = ", ".join(f"`{name}` {shape}" for name, shape in shapes.items() if shape)
        raise ValueError(f"the leading axes do not fit together: {shown}") from None


def rows(value: np.ndarray, leading: tuple[int, ...], shape: tuple[int, ...]) -> np.ndarray:
    """The points as rows of a matrix."""
    whole = np.broadcast_to(value, leading + shape)
    return np.ascontiguousarray(whole).reshape(math.prod(leading), math.prod(shape))
