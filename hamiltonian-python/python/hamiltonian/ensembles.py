"""Ensembles: many members of one definition."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from . import arrays
from ._hamiltonian import Members, Swarm, indicators, sweep
from .runs import State

if TYPE_CHECKING:
    from .system import System


class Ensemble:
    """Members of one definition with starts and parameters of their own. `System.ensemble` makes it.

    Members advance together, in SIMD lanes and on all cores, with the interpreter's lock released. A member that fails is
    NaN from then on, and the others continue. Ctrl-C raises `KeyboardInterrupt` at a whole number of steps of all members:
    `state` has what is done, and the next call continues. An ensemble that is pickled and read back continues with the same
    bits.
    """

    system: System
    """The system with the parameters that all members share."""
    shape: tuple[int, ...]
    """The shape of the members, from the leading axes of q, p and the parameters."""
    errors: dict[tuple[int, ...], str]
    """The errors of the members that failed, by their index."""

    def __init__(self, system: System, q, p, t, threads, values: dict):
        self.system, self.errors = system, {}
        self._threads = None if threads is None else arrays.count("threads", threads)
        q = arrays.points("q", system._variables.number_or_row(arrays.finite("q", q)), system.shape)
        p = arrays.points("p", system._variables.number_or_row(arrays.finite("p", p)), system.shape)
        axes = len(system.shape)
        leading = {"q": q.shape[: q.ndim - axes], "p": p.shape[: p.ndim - axes]}
        known = {name: extents for name, extents, _ in system._own.parameters}
        own = {}
        for name, value in values.items():
            if name in system.sizes:
                raise ValueError(f"the size `{name}` is that of all members: give it to `define` or `with_`")
            if name not in known:
                all = ", ".join(f"`{one}`" for one in known) or "none"
                raise TypeError(f"there is no parameter `{name}`; there are {all}")
            value = arrays.points(name, arrays.numbers(name, value), tuple(known[name]))
            own[name] = value
            leading[name] = value.shape[: value.ndim - len(known[name])]
        self.shape = arrays.together(**leading)
        if math.prod(self.shape + system.shape) == 0:
            raise ValueError("an ensemble needs at least one member, and its system at least one coordinate")
        rows = [
            (name, not known[name], arrays.rows(value, self.shape, tuple(known[name]))) for name, value in own.items()
        ]
        self._values = rows
        self._members = Members(system._definition, system._own, system._flat(), rows)
        self._own: Swarm | None = None
        self._scheme: str | None = None
        self._step: float | None = None
        # Where the members of `_own` began.
        self._start = arrays.number("t", t), arrays.rows(q, self.shape, system.shape), arrays.rows(p, self.shape, system.shape)

    @property
    def t(self) -> float:
        """The time of the members that have not failed."""
        return self._start[0] if self._own is None else self._own.t

    @property
    def state(self) -> State:
        """The current states: q and p of shape ``(*shape, *system.shape)``, t of shape ``shape``."""
        if self._own is None:
            t, q, p = self._start
            return self._shaped((np.full(len(q), t), q, p, []))
        return self._shaped(self._own.states())

    @property
    def energy(self) -> np.ndarray:
        """H of each member at its state."""
        t, q, p = self._rows()
        return self._members.energy(q, p, t).reshape(self.shape)

    def advance(self, steps: int, step: float | None = None, scheme: str | None = None, progress: bool = False) -> State:
        """Makes steps of every member that has not failed, and returns the states; see `advance_to`."""
        steps = arrays.count("steps", steps)
        self._advance(self._begin(step, scheme), steps, progress)
        return self.state

    def advance_to(self, t: float, step: float | None = None, scheme: str | None = None, progress: bool = False) -> State:
        """Advances all members to the time t and returns the states there.

        ``step`` is the size of the steps, with which the first call begins; a call without it keeps the last one. t need
        not be a whole number of steps away: the states returned are those at t, and `state` those of the whole steps.
        ``scheme`` is one of ``schemes()`` that ensembles have. By default it is ``BlanesMoan4`` if H has exact flows, and
        ``Gauss4`` otherwise. With ``progress``, tqdm shows a bar if it is installed.

        Raises:
            ValueError: t lies behind, the step is zero or of the wrong sign, or the scheme does not fit H.
            KeyboardInterrupt: After Ctrl-C. The steps made so far are kept.
        """
        t = arrays.number("t", t)
        own = self._begin(step, scheme)
        whole = math.floor((t - own.t) / (self._step or 1.0) * (1 + 1e-12))
        if 1 < whole < arrays.MOST:
            self._advance(own, whole - 1, progress)
        return self._shaped(own.advance_until(t))

    def lyapunov(self, t: float, step: float | None = None, deviations: int = 1, every: int = 10) -> np.ndarray:
        """The greatest Lyapunov exponents of each member over the time t, from its current state, in units of 1/time.

        They are the mean rates of growth of ``deviations`` derivatives of the numerical map, which are made orthonormal
        after each ``every`` steps. The last axis of the result has them, if there is more than one. The members do not
        advance.
        """
        deviations = arrays.count("deviations", deviations)
        most = 2 * math.prod(self.system.shape)
        if not 1 <= deviations <= most:
            raise ValueError(f"`deviations` must be from 1 to {most}, found {deviations}")
        numbers = self._indicators(t, step, deviations, every)
        return numbers.reshape(self.shape if deviations == 1 else (*self.shape, deviations))

    def megno(self, t: float, step: float | None = None, every: int = 10) -> np.ndarray:
        """MEGNO of each member over the time t, from its current state: near 2 for regular motion, growing like λt/2 for
        chaos with the Lyapunov exponent λ. The members do not advance."""
        return self._indicators(t, step, 0, every).reshape(self.shape)

    def sweep(
        self,
        path: str | os.PathLike[str],
        t: ArrayLike,
        record: Iterable[str],
        step: float | None = None,
        scheme: str | None = None,
        progress: bool = False,
    ) -> None:
        """Runs each member from its current state to the time t, and writes numbers of it into a Zarr store, which xarray
        opens. The members do not advance.

        ``record`` has the names of columns: a coordinate or a momentum, such as ``x`` or ``q[0][2]``, ``t``, ``H``, an
        observable, or ``drift``, the largest relative change of H at a whole step. With a list of times for ``t``, each
        column has the dimensions ``member`` and ``t``, and ``t`` is no column. Members are numbered along the shape of the
        ensemble, the last axis fastest. A member that fails is NaN, and ``status`` has the kind of its failure. ``step``
        and ``scheme`` are those of `advance_to`.

        Memory does not grow with the number of times. After Ctrl-C the same call continues with the members that are
        missing. Each has the bits of a run that begins at its current state.

        >>> import tempfile, xarray
        >>> spring = define("H(x; p) = p^2/2 + k*x^2/2", k=1.0)
        >>> swarm = spring.ensemble(q=1.0, p=0.0, k=np.array([1.0, 4.0, 9.0]))
        >>> path = tempfile.mkdtemp() + "/springs.zarr"
        >>> swarm.sweep(path, t=[0.5, 1.0], record=["x", "drift"], step=0.01)
        >>> data = xarray.open_zarr(path)
        >>> bool(abs(data.x.sel(t=1.0) - np.cos([1, 2, 3])).max() < 1e-6)
        True

        Raises:
            ValueError: There is nothing of that name, the scheme does not fit H, or t lies behind.
            RunError: The store has members of another sweep, or cannot be written.
        """
        step, scheme = self._of_steps(step, scheme)
        columns = [record] if isinstance(record, str) else list(record)
        times = arrays.finite("t", t)
        if times.ndim > 1 or times.size == 0:
            raise ValueError(f"`t` must be a time or a list of times, found an array of shape {times.shape}")
        _, q, p = self._rows()
        at = None if times.ndim == 0 else np.ascontiguousarray(times)
        bar = _bar(len(self), "member") if progress else None
        own = self._members, q, p, float(self.t), scheme, step, float(times.ravel()[-1]), at, columns, os.fspath(path)
        if bar is None:
            return sweep(*own, self._threads)
        with bar:
            sweep(*own, self._threads, lambda made: bar.update(made - bar.n))

    def _indicators(self, t, step, deviations: int, every) -> np.ndarray:
        step = self._step if step is None else arrays.number("step", step)
        if step is None:
            raise TypeError("the first call needs a `step`")
        steps = round(arrays.number("t", t) / step) if step else 0
        if not 1 <= steps < arrays.MOST:
            raise ValueError(f"there must be from 1 to 2^53 steps of {step} in the time {t}")
        now, q, p = self._rows()
        splitting = "Split" not in self.system.missing
        own = splitting, step, steps, arrays.count("every", every), deviations
        numbers, errors = indicators(self._members, q, p, float(self.t), *own)
        self._keep(errors)
        return numbers

    def _of_steps(self, step, scheme) -> tuple[float, str]:
        """A step and a scheme, by default the last ones."""
        if step is None and self._step is None:
            raise TypeError("the first call needs a `step`")
        step = self._step if step is None else arrays.number("step", step)
        if scheme is None:
            scheme = self._scheme or ("BlanesMoan4" if "Split" not in self.system.missing else "Gauss4")
        if not isinstance(scheme, str):
            raise TypeError(f"`scheme` must be a name such as 'BlanesMoan4', found {type(scheme).__name__}")
        return step, scheme

    def _begin(self, step, scheme) -> Swarm:
        """The members, with another step or scheme from their current states."""
        step, scheme = self._of_steps(step, scheme)
        if self._own is not None and (step, scheme) == (self._step, self._scheme):
            return self._own
        _, q, p = self._rows()
        start = self.t, q, p
        self._own = Swarm(self._members, q, p, self.t, scheme, step, self._threads)
        self._step, self._scheme, self._start = step, scheme, start
        return self._own

    def _advance(self, own: Swarm, steps: int, progress: bool) -> None:
        bar = _bar(steps) if progress else None
        if bar is None:
            return own.advance(steps)
        with bar:
            own.advance(steps, lambda made: bar.update(made - bar.n))

    def _rows(self):
        """The current states, one a row."""
        if self._own is None:
            t, q, p = self._start
            return np.full(len(q), t), q, p
        t, q, p, _ = self._own.states()
        return t, q, p

    def _shaped(self, rows) -> State:
        t, q, p, errors = rows
        self._keep(errors)
        shape = self.shape + self.system.shape
        return State(t.reshape(self.shape), q.reshape(shape), p.reshape(shape))

    def _keep(self, errors) -> None:
        """Keeps the first error of each member."""
        for member, text in errors:
            index = tuple(int(i) for i in np.unravel_index(member, self.shape))
            self.errors.setdefault(index, text)

    def __getstate__(self) -> dict:
        kept = {name: value for name, value in vars(self).items() if name != "_members"}
        kept["_own"] = None if self._own is None else self._own.save()
        return kept

    def __setstate__(self, kept: dict) -> None:
        saved = kept.pop("_own")
        vars(self).update(kept)
        system, (t, q, p) = self.system, self._start
        self._members = Members(system._definition, system._own, system._flat(), self._values)
        self._own = None if saved is None else Swarm.resume(self._members, q, p, t, saved, self._threads)

    def __len__(self) -> int:
        return math.prod(self.shape)

    def __repr__(self) -> str:
        failed = f", {len(self.errors)} failed" if self.errors else ""
        return f"{len(self)} members of {self.system.name} at t = {self.t:.6g}{failed}"


def _bar(steps: int, unit: str = "step"):
    """A bar of tqdm; none if it is not installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(total=steps, unit=unit)
