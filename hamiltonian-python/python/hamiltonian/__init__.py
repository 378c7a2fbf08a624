"""Hamiltonian systems from one line of mathematics.

>>> import hamiltonian as hm
>>> spring = hm.define("H(x; p) = p^2/2 + k*x^2/2", k=4.0)
>>> float(spring.H(0.5, 1.0))
1.0

A text in the language of the Rust macro ``hamiltonian!`` is read, checked and differentiated when it is defined. Nothing is
compiled. The chapter "From Python" of the book shows tasks, and the chapter "The language" has every construct.
"""

from .ensembles import Ensemble
from .errors import DefinitionError, Diagnostic, RunError
from .functions import Grid, Spline
from .runs import Crossings, Run, Solution, State
from .schemes import Scheme, schemes
from .system import System, define, load

__all__ = [
    *("DefinitionError", "Diagnostic", "RunError"),
    *("Crossings", "Ensemble", "Grid", "Run", "Scheme", "Solution", "Spline", "State", "System"),
    *("define", "load", "schemes"),
]
