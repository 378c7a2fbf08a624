"""Systems: a definition with the values of its parameters."""

from __future__ import annotations

import os
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from . import arrays
from ._hamiltonian import Definition, Function
from ._hamiltonian import System as _System
from .ensembles import Ensemble
from .functions import Grid, Spline
from .runs import Run, Solution, State, made, sensitivities, solved
from .variables import Variables


def define(definition, /, **values) -> System:
    """Reads a definition in the language of ``hamiltonian!``, or takes an expression of SymPy.

    A text may declare its parameters with ``struct Name { lam = 1.0 }``. Without that, every name that is neither a
    coordinate nor a momentum is a parameter. ``values`` are those of the parameters and sizes: numbers and arrays of
    numbers, and a `Spline` or a `Grid` for a parameter ``V: fn(r)``. A parameter that is not named has its default.

    An expression of SymPy needs ``coordinates`` and ``momenta``, tuples of symbols, and ``time`` if H depends on it.
    ``events``, ``monitors`` and ``invariants`` are dictionaries of more expressions by their names.

    >>> hh = define('''
    ...     H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lam*(x^2*y - y^3/3);
    ...     event section = x
    ... ''', lam=1.0)
    >>> hh.coordinates, hh.momenta, hh.events
    (('x', 'y'), ('px', 'py'), ('section',))

    Raises:
        DefinitionError: The text has errors, which the exception shows with their places.
        TypeError: A value is missing, has an unknown name, or is no number.
        ValueError: A value has a wrong shape, or is NaN.
    """
    if not isinstance(definition, str):
        from .expressions import text_of  # SymPy is imported by its users alone.

        own = ("coordinates", "momenta", "time", "events", "monitors", "invariants")
        definition = text_of(definition, **{name: values.pop(name) for name in own if name in values})
    return _made(Definition(definition, "definition"), definition, "definition", values)


def load(path: str | os.PathLike[str], /, **values) -> System:
    """Reads a definition from a file of text in UTF-8, see `define`.

    Raises:
        OSError: The file cannot be read.
        UnicodeDecodeError: It is no UTF-8.
    """
    source = os.fspath(path)
    with open(source, encoding="utf-8") as file:
        text = file.read()
    return _made(Definition(text, source), text, source, values)


def _restored(text: str, source: str, values: dict) -> System:
    """The system of a pickle."""
    return _made(Definition(text, source), text, source, values)


def _made(definition: Definition, text: str, source: str, values: dict) -> System:
    """The system of a definition that was read."""
    functions = definition.functions
    known = {name: _value(name, value, name in functions) for name, value in values.items()}
    own = definition.system(_flat(known))
    for name, extents, _ in own.parameters:
        if name in known and list(known[name].shape) != extents:
            raise ValueError(f"`{name}` must have the shape {tuple(extents)}, found {known[name].shape}")
    for value in known.values():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return System(definition, own, text, source, known)


def _value(name: str, value, is_function: bool) -> np.ndarray | Spline | Grid:
    """A value that was checked: numbers, or a function with data."""
    if not is_function:
        return arrays.numbers(name, value)
    if not isinstance(value, (Spline, Grid)):
        raise TypeError(f"`{name}` must be a function: a `Spline` or a `Grid`, found a value of type {type(value).__name__}")
    return value


def _flat(values: dict) -> list[tuple[str, float | np.ndarray | Function]]:
    """Numbers, arrays row after row, and functions."""

    def flat(value):
        if isinstance(value, (Spline, Grid)):
            return value._own
        return float(value) if value.ndim == 0 else value.ravel()

    return [(name, flat(value)) for name, value in values.items()]


class System:
    """A definition with the values of its parameters and sizes. `define` makes it, and nothing changes it.

    ``q`` and ``p`` of its methods are arrays of the shape `shape`. That is the shape of the array for a definition with
    one, such as ``(n, 3)`` of ``H(q[n][3]; p[n][3])``. Otherwise it is the number of coordinates: group after group in
    the order of the declaration, arrays row after row.
    """

    text: str
    """The definition."""
    source: str
    """Its name in errors."""
    declared: Variables
    """The variables in which the definition is written: ``coordinates``, ``momenta``, ``velocities`` and ``shape``. They
    are those of the system, unless the definition has ``coordinates …`` or ``dt = …``: see `from_declared`."""

    def __init__(self, definition: Definition, own: _System, text: str, source: str, values: dict):
        self._definition, self._own, self._values = definition, own, values
        self.text, self.source = text, source
        self._variables, self.declared = Variables(own.groups), Variables(own.declared_groups)

    @property
    def name(self) -> str:
        """The name of the struct; ``H`` of a definition without one."""
        return self._definition.name

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of q and p: that of the only array, or the number of coordinates."""
        return self._variables.shape

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of the coordinates."""
        return self._variables.coordinates

    @property
    def momenta(self) -> tuple[str, ...]:
        """The names of their momenta."""
        return self._variables.momenta

    @property
    def clock(self) -> str:
        """The name of the time of runs: ``t``, or ``s`` of a definition with ``dt = g*ds``."""
        return self._own.clock

    @property
    def parameters(self) -> dict[str, float | np.ndarray]:
        """The values of the parameters, defaults included."""
        all = self._own.parameters
        return {name: numbers.reshape(extents) if extents else float(numbers[0]) for name, extents, numbers in all}

    @property
    def sizes(self) -> dict[str, int]:
        """The values of the sizes."""
        return dict(self._own.sizes)

    def _of_kind(self, kind: str) -> tuple[str, ...]:
        return tuple(name for name, own in self._own.observables if own == kind)

    @property
    def invariants(self) -> tuple[str, ...]:
        """The names of the declared invariants, which are proven."""
        return self._of_kind("invariant")

    @property
    def monitors(self) -> tuple[str, ...]:
        """The names of the declared monitors."""
        return self._of_kind("monitor")

    @property
    def events(self) -> tuple[str, ...]:
        """The names of the declared events."""
        return self._of_kind("event")

    @property
    def cyclic(self) -> tuple[str, ...]:
        """The coordinates that do not appear in H: their momenta are conserved."""
        return tuple(self._own.cyclic)

    @property
    def pieces(self) -> dict[str, str]:
        """The pieces of H with exact flows, the outermost first: names and formulas. None if H does not split."""
        return dict(self._own.pieces)

    @property
    def missing(self) -> dict[str, str]:
        """The properties that schemes may require and that H is not proven to have, with the reasons."""
        return dict(self._own.missing)

    @property
    def facts(self) -> tuple[str, ...]:
        """What is proven of H, a sentence each: its structure, its pieces."""
        return tuple(self._definition.facts)

    @property
    def latex(self) -> str:
        """H in LaTeX."""
        return self._definition.latex

    def with_(self, **values) -> System:
        """The same definition with other values of some parameters or sizes. The text is not read again."""
        return _made(self._definition, self.text, self.source, {**self._values, **values})

    def H(self, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> np.ndarray:
        """H(q, p, t). Leading axes of q, p and t are broadcast: one number for each point.

        It is the H of the definition, also with ``dt = g*ds``, where the system's own Hamiltonian is g·(H + p_t). A point outside the domain of H gives NaN or an infinity.
        """
        leading, points = self._variables.points(q, p, t)
        return self._own.energy(*points).reshape(leading)

    def gradient(self, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """(∂H/∂q, ∂H/∂p), exact, at each point; see `H`."""
        leading, points = self._variables.points(q, p, t)
        dq, dp = self._own.gradient(*points)
        return dq.reshape(leading + self.shape), dp.reshape(leading + self.shape)

    def field(self, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """(q̇, ṗ) = (∂H/∂p, −∂H/∂q + f) at each point, f the force; see `H`."""
        leading, points = self._variables.points(q, p, t)
        dq, dp = self._own.field(*points)
        return dq.reshape(leading + self.shape), dp.reshape(leading + self.shape)

    def observable(self, name: str, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> np.ndarray:
        """The invariant, monitor or event of that name at each point; see `H`. A component is ``"name[2]"``.

        Raises:
            KeyError: There is none of that name; the exception lists those there are.
        """
        if name not in (known for known, _ in self._own.observables):
            raise KeyError(self._unknown(name))
        leading, points = self._variables.points(q, p, t)
        return self._own.observable(name, *points).reshape(leading)

    def from_declared(self, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> State:
        """The state of the system from one in the variables of the definition, see `declared`; many along leading axes.

        With ``coordinates …``, q and p are those of the new coordinates. With ``dt = g*ds``, the time is the last
        coordinate, its momentum is −H, and the new time s is 0. Otherwise the state is the same.

        >>> kepler = define('''
        ...     H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2);
        ...     coordinates polar(x, y);
        ...     dt = sqrt(x^2 + y^2)*ds
        ... ''')
        >>> kepler.coordinates, kepler.clock
        (('r', 'phi', 't'), 's')
        >>> start = kepler.from_declared(q=[0.5, 0.0], p=[0.0, 1.5])
        >>> sol = kepler.solve(start.q, start.p, t=[0, 2*np.pi/np.sqrt(1.75)])  # once around
        >>> bool(abs(sol.declared.q[1] - [0.5, 0.0]).max() < 1e-8)
        True
        """
        return self._of_declared(q, p, t, False)

    def from_velocity(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0) -> State:
        """The state of the system from coordinates and velocities of a Lagrangian; see `from_declared`.

        >>> pendulum = define("L(theta; v) = l^2*v^2/2 + l*cos(theta)", l=2.0)
        >>> pendulum.from_velocity(0.5, 1.5).p
        array([6.])

        Raises:
            ValueError: The definition gives H.
        """
        return self._of_declared(q, v, t, True)

    def to_declared(self, q: ArrayLike, p: ArrayLike, t: ArrayLike = 0.0) -> State:
        """The state in the variables of the definition from one of the system; many along leading axes.

        With ``dt = g*ds``, its t is the time t of the definition.
        """
        leading, points = self._variables.points(q, p, t)
        return self._states(leading, self.declared.shape, self._own.to_declared(*points))

    def _of_declared(self, q, p, t, velocities: bool) -> State:
        leading, points = self.declared.points(q, p, t)
        return self._states(leading, self.shape, self._own.of_declared(*points, velocities))

    def _states(self, leading: tuple[int, ...], shape: tuple[int, ...], rows) -> State:
        """States of one row each, in this shape behind the leading axes."""
        t, q, p = rows
        return State(t.reshape(leading)[()], q.reshape(leading + shape), p.reshape(leading + shape))

    def solve(
        self,
        q: ArrayLike,
        p: ArrayLike,
        t: ArrayLike,
        *,
        tolerance: float | tuple[float, float] | None = None,
        scheme: str | None = None,
        step: float | None = None,
    ) -> Solution:
        """The states at the times t, from q and p at the first of them, with the crossings of all declared events.

        The steps follow ``tolerance``, 1e-10 by default: a relative tolerance, or (relative, absolute). Its scheme is
        ``GaussNystrom8`` if T is a quadratic form of the momenta and there is no force, and ``Gauss8`` otherwise. Or a
        ``scheme`` of `schemes` makes fixed steps of the size ``step``, also for times that decrease.

        >>> spring = define("H(x; p) = p^2/2 + x^2/2; event turn = p")
        >>> sol = spring.solve(q=1.0, p=0.0, t=np.linspace(0, 10, 5), tolerance=1e-12)
        >>> bool(abs(sol.q[-1, 0] - np.cos(10)) < 1e-11), len(sol.events["turn"].t)
        (True, 3)

        Raises:
            ValueError: The scheme requires a structure that H does not have, or an argument has a wrong shape or value.
            RunError: A step fails. The attribute ``solution`` of the exception has the states before it, as it has after
                Ctrl-C.
        """
        return solved(self, q, p, t, tolerance, scheme, step)

    def run(
        self,
        q: ArrayLike,
        p: ArrayLike,
        t: float = 0.0,
        *,
        scheme: str | None = None,
        step: float | None = None,
        tolerance: float | tuple[float, float] | None = None,
    ) -> Run:
        """A run from q and p at the time t that advances step by step; see `solve` for its scheme and steps.

        >>> run = define("H(x; p) = p^2/2 + x^2/2").run(q=1.0, p=0.0, scheme="GaussNystrom8", step=0.1)
        >>> state = run.advance(100)
        >>> run.steps, bool(abs(run.energy - 0.5) < 1e-14)
        (100, True)
        """
        return Run(self, made(self, q, p, t, scheme, step, tolerance))

    def ensemble(
        self, q: ArrayLike, p: ArrayLike, t: float = 0.0, *, threads: int | None = None, **values: ArrayLike
    ) -> Ensemble:
        """Members with starts and parameters of their own: leading axes of q, p and parameters are broadcast.

        ``threads`` is their number, by default as many as the machine runs at once. The results do not depend on it.

        >>> spring = define("H(x; p) = p^2/2 + k*x^2/2", k=1.0)
        >>> swarm = spring.ensemble(q=1.0, p=0.0, k=np.array([1.0, 4.0, 9.0]))
        >>> end = swarm.advance_to(1.0, step=0.01)
        >>> bool(np.abs(end.q[:, 0] - np.cos([1, 2, 3])).max() < 1e-6)
        True
        """
        return Ensemble(self, q, p, t, threads, values)

    def sensitivity(
        self, solution: Solution, tolerance: float = 1e-9, parameters: str | Iterable[str] = ()
    ) -> np.ndarray:
        """The derivatives of the states of a solution with respect to its start, and behind it to ``parameters``: a matrix
        for each time.

        Rows and columns are all coordinates, then all momenta, arrays row after row. Then each parameter that is named has
        a column, an array one for each element. They are exact derivatives of the maps of ``GaussNystrom8`` or
        ``Gauss8``, by dual numbers, with steps that are halved until the matrix between two times changes by less than
        ``tolerance``, relative to its largest element.

        >>> spring = define("H(x; p) = p^2/2 + k*x^2/2", k=4.0)
        >>> sol = spring.solve(q=1.0, p=0.0, t=[0, 1])
        >>> by_k = spring.sensitivity(sol, parameters="k")[-1, 0, 2]
        >>> bool(abs(by_k + np.sin(2)/4) < 1e-9)  # x = cos(√k·t)
        True
        """
        return sensitivities(solution, tolerance, parameters)

    def _unknown(self, name: str) -> str:
        """The text of a ``KeyError`` for an observable that is not declared."""
        known = [own for own, _ in self._own.observables]
        return f"{self.name} declares no {name!r}; it has: {', '.join(known) or 'none'}"

    def _flat(self) -> list[tuple[str, float | np.ndarray | Function]]:
        return _flat(self._values)

    def __repr__(self) -> str:
        values = {**self.sizes, **self.parameters}
        shown = ", ".join(f"{name} = {_short(value)}" for name, value in values.items())
        # One fact is a statement for the definition, in lines of its own.
        facts = [fact for fact in self.facts if "\n" not in fact]
        lines = [self._definition.formula, *([f"with {shown}"] if shown else []), *facts]
        for kind in ("invariant", "monitor", "event"):
            names = self._of_kind(kind)
            lines += [f"{kind}s: {', '.join(names)}"] if names else []
        return "\n".join(lines)

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex}$"

    def __reduce__(self):
        return _restored, (self.text, self.source, self._values)

    def __copy__(self) -> System:
        return self

    def __deepcopy__(self, memo) -> System:
        return self


def _short(value) -> str:
    """A value in one line."""
    if np.ndim(value) == 0:
        return repr(value)
    return np.array2string(value, threshold=6, edgeitems=2, separator=", ").replace("\n", "")
