"""Single runs and their solutions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import arrays
from ._hamiltonian import Run as _Run
from ._hamiltonian import derivative

if TYPE_CHECKING:
    from .system import System

#: The relative tolerance of a run that is given neither a tolerance nor a scheme.
TOLERANCE = 1e-10


class State(NamedTuple):
    """Coordinates and momenta at a time. Of many members, each has leading axes."""

    t: Any
    """The time, a number; of many members, an array."""
    q: np.ndarray
    """The coordinates, of the system's shape."""
    p: np.ndarray
    """The momenta, of the system's shape."""


class Crossings(NamedTuple):
    """The states at which an event is 0 to rounding, in the order of the run."""

    t: np.ndarray
    """The times."""
    q: np.ndarray
    """The coordinates, one state a row."""
    p: np.ndarray
    """The momenta, one state a row."""
    rising: np.ndarray
    """True where the function of the event increases along the run."""


def start_of(system: System, q, p, t) -> tuple[np.ndarray, np.ndarray, float]:
    """A checked start, flat."""
    numbers = [system._variables.number_or_row(arrays.finite(name, value)) for name, value in (("q", q), ("p", p))]
    q, p = (arrays.point(name, value, system.shape).ravel() for name, value in zip("qp", numbers))
    return q, p, arrays.number("t", t)


def tolerances(tolerance) -> tuple[float, float]:
    """The relative and the absolute tolerance: a number is relative, and a pair is both."""
    pair = arrays.finite("tolerance", tolerance)
    if pair.shape not in ((), (2,)):
        raise ValueError(f"`tolerance` must be a number or (relative, absolute), found an array of shape {pair.shape}")
    relative, absolute = (float(pair), 0.0) if pair.ndim == 0 else pair.tolist()
    return relative, absolute


def made(system: System, q, p, t, scheme, step, tolerance) -> _Run:
    """A run of a scheme with a step, or with steps from a tolerance."""
    q, p, t = start_of(system, q, p, t)
    if (scheme is None) != (step is None):
        raise TypeError("a scheme needs its `step`, and a step its `scheme`; without both, `tolerance` sets the steps")
    if scheme is None:
        relative, absolute = tolerances(TOLERANCE if tolerance is None else tolerance)
        return _Run.to_tolerance(system._own, q, p, t, relative, absolute)
    if tolerance is not None:
        raise TypeError("give a `tolerance`, or a `scheme` with its `step`")
    if not isinstance(scheme, str):
        raise TypeError(f"`scheme` must be a name such as 'GaussNystrom8', found {type(scheme).__name__}")
    return _Run.by_scheme(system._own, q, p, t, scheme, arrays.number("step", step))


def states(system: System, rows) -> State:
    """States of one row each, in the shape of the system."""
    t, q, p = rows
    return State(t, q.reshape(len(t), *system.shape), p.reshape(len(t), *system.shape))


def events_of(system: System, run: _Run) -> dict[str, Crossings]:
    """The crossings of each event."""
    names, rising, rows = run.crossings()
    all = states(system, rows)
    found = {}
    for event in system.events:
        own = np.array([name == event for name in names], dtype=bool)
        found[event] = Crossings(all.t[own], all.q[own], all.p[own], np.array(rising, dtype=bool)[own])
    return found


class Solution:
    """The states of a run at given times, with the crossings of its events. `System.solve` makes it."""

    system: System
    """The system."""
    t: np.ndarray
    """The times."""
    q: np.ndarray
    """The coordinates: a state for each time, of the system's shape."""
    p: np.ndarray
    """The momenta."""
    events: dict[str, Crossings]
    """The crossings of each declared event."""
    scheme: str
    """The name of the scheme."""
    order: int
    """Its order."""
    steps: int
    """The number of steps made."""
    refused_steps: int
    """How often a size of a step was refused, with a tolerance; otherwise 0."""

    def __init__(self, system: System, run: _Run, rows):
        self.system = system
        self.t, self.q, self.p = states(system, rows)
        self.events = events_of(system, run)
        self.scheme, self.order, self.source = run.scheme
        self.steps, self.refused_steps = run.steps, run.refused_steps

    @property
    def energy(self) -> np.ndarray:
        """H at each state."""
        return self.system.H(self.q, self.p, self.t)

    @property
    def declared(self) -> State:
        """The states in the variables of the definition; see `System.to_declared`."""
        return self.system.to_declared(self.q, self.p, self.t)

    def observable(self, name: str) -> np.ndarray:
        """The invariant, monitor or event of that name at each state."""
        return self.system.observable(name, self.q, self.p, self.t)

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        span = f" from t = {self.t[0]:.6g} to {self.t[-1]:.6g}" if len(self.t) else ""
        shown = [f"{len(self.t)} states{span}, {self.scheme}, {self.steps} steps"]
        shown += [f"{name}: {len(found.t)} crossings" for name, found in self.events.items()]
        return "\n".join(shown)

    def plot(self, x="t", y=None, ax=None, **style):
        """Draws one quantity over another and returns matplotlib's axes.

        A quantity is ``"t"``, ``"energy"``, or the name of a coordinate, a momentum or an observable, such as ``"x"``.
        Without ``y``, all coordinates are drawn. ``style`` goes to ``Axes.plot``.
        """
        import matplotlib.pyplot as plt

        ax = plt.gca() if ax is None else ax
        names = list(self.system.coordinates) if y is None else [y] if isinstance(y, str) else list(y)
        for name in names:
            ax.plot(self._quantity(x), self._quantity(name), **{"label": name, **style})
        ax.set_xlabel(x)
        if len(names) == 1:
            ax.set_ylabel(names[0])
        else:
            ax.legend()
        return ax

    def _quantity(self, name: str) -> np.ndarray:
        """A quantity by its name, one row a state."""
        if name in ("t", "energy"):
            return getattr(self, name)
        for side, names in ((self.q, self.system.coordinates), (self.p, self.system.momenta)):
            if name in names:
                return self.system._variables.group(side, names.index(name)).reshape(len(self.t), -1)
        return self.observable(name)


def solved(system: System, q, p, t, tolerance, scheme, step) -> Solution:
    """See `System.solve`."""
    times = np.atleast_1d(arrays.finite("t", t))
    if times.ndim != 1 or times.size == 0:
        raise ValueError(f"`t` must be a list of times, found an array of shape {times.shape}")
    steps = np.diff(times)
    backwards = times[-1] < times[0]
    if (steps > 0).any() and (steps < 0).any():
        raise ValueError("`t` must increase or decrease throughout")
    if step is not None:
        step = math.copysign(arrays.number("step", step), -1.0 if backwards else 1.0)
    elif backwards:
        raise ValueError("steps from a tolerance go forwards alone: give a `scheme` and its `step` for times that decrease")
    run = made(system, q, p, times[0], scheme, step, tolerance)
    rows, error = run.states_at(times)
    solution = Solution(system, run, rows)
    if error is not None:
        # What was computed before a failure or Ctrl-C.
        setattr(error, "solution", solution)
        raise error
    return solution


def sensitivities(solution: Solution, tolerance, parameters) -> np.ndarray:
    """See `System.sensitivity`."""
    system, t = solution.system, solution.t
    relative = arrays.number("tolerance", tolerance)
    if relative <= 0:
        raise ValueError(f"`tolerance` must be positive, found {relative}")
    size = 2 * math.prod(system.shape)
    if size == 0:
        raise ValueError("a system without coordinates has no derivatives")
    numbers = _numbers(system, [parameters] if isinstance(parameters, str) else list(parameters))
    nystrom = not {"Separable", "QuadraticKinetic", "Unforced"} & set(system.missing)
    matrix = np.eye(size, size + len(numbers))
    all = np.empty((len(t), *matrix.shape))
    mean = (t[-1] - t[0]) / max(solution.steps, 1) if len(t) else 1.0
    for row in range(len(t)):
        if row and t[row] != t[row - 1]:
            time = t[row] - t[row - 1]
            start = solution.q[row - 1].ravel(), solution.p[row - 1].ravel(), t[row - 1]
            steps = max(1, math.ceil(time / mean)) if mean else 1
            own = _converged(system, start, time, steps, nystrom, relative, numbers)
            matrix = own[:, :size] @ matrix
            matrix[:, size:] += own[:, size:]
        all[row] = matrix
    return all


def _numbers(system: System, parameters: list[str]) -> list[tuple[str, int]]:
    """Each parameter with each of its elements, row after row."""
    known = system.parameters
    for name in parameters:
        if name not in known:
            all = ", ".join(f"`{one}`" for one in known) or "none"
            raise TypeError(f"there is no parameter `{name}`; there are {all}")
    return [(name, element) for name in parameters for element in range(np.size(known[name]))]


def _converged(system: System, start, time: float, steps: int, nystrom: bool, relative: float, numbers) -> np.ndarray:
    """The derivatives of the state after some time, by steps that are halved until they change no more."""
    q, p, t = start
    last = derivative(system._own, q, p, t, time, steps, nystrom, numbers)
    for _ in range(20):
        steps *= 2
        own = derivative(system._own, q, p, t, time, steps, nystrom, numbers)
        if np.abs(own - last).max() <= relative * np.abs(own).max():
            return own
        last = own
    from .errors import RunError

    raise RunError(f"the derivative does not converge to the tolerance {relative} within {steps} steps from t = {t}")


class Run:
    """One trajectory that advances. `System.run` makes it.

    It is pickled with its scheme and all that it carries, so a run that was read back continues with the same bits.
    """

    def __init__(self, system: System, own: _Run):
        self.system, self._own = system, own

    def advance(self, steps: int = 1) -> State:
        """Makes steps and returns the state. After Ctrl-C or a failure, the run stands at its last good step."""
        self._own.advance(arrays.count("steps", steps))
        return self.state

    def advance_to(self, t: float) -> State:
        """Advances to the time t, a whole number of steps away, and returns the state.

        Raises:
            ValueError: t is not a whole number of steps away, or the steps follow a tolerance: `advance_until` takes any
                later time.
        """
        self._own.advance_to(arrays.number("t", t))
        return self.state

    def advance_until(self, t: float) -> State:
        """Advances by the whole steps up to t, any later time, and returns the state at t."""
        rows, error = self._own.states_at(np.array([arrays.number("t", t)]))
        if error is not None:
            raise error
        return State(*(part[0] for part in states(self.system, rows)))

    @property
    def state(self) -> State:
        """The current state."""
        return State(*(part[0] for part in states(self.system, self._own.state())))

    @property
    def t(self) -> float:
        """The current time."""
        return self._own.t

    @property
    def q(self) -> np.ndarray:
        """The current coordinates."""
        return self.state.q

    @property
    def p(self) -> np.ndarray:
        """The current momenta."""
        return self.state.p

    @property
    def energy(self) -> float:
        """H at the current state."""
        return self._own.energy

    @property
    def steps(self) -> int:
        """The number of steps made."""
        return self._own.steps

    @property
    def step(self) -> float:
        """The step size; with a tolerance, the first one."""
        return self._own.step

    @property
    def refused_steps(self) -> int:
        """How often a size of a step was refused, with a tolerance; otherwise 0."""
        return self._own.refused_steps

    @property
    def scheme(self) -> str:
        """The name of the scheme."""
        return self._own.scheme[0]

    @property
    def events(self) -> dict[str, Crossings]:
        """The crossings of each declared event so far."""
        return events_of(self.system, self._own)

    def observable(self, name: str) -> float:
        """The invariant, monitor or event of that name at the current state."""
        value = self._own.observable(name)
        if value is None:
            raise KeyError(self.system._unknown(name))
        return value

    def __reduce__(self):
        return _resumed, (self.system, self._own.save())

    def __repr__(self) -> str:
        return f"{self.scheme} at t = {self.t:.6g} after {self.steps} steps"


def _resumed(system: System, bytes: bytes) -> Run:
    """The run of a pickle."""
    return Run(system, _Run.resume(system._own, bytes))
