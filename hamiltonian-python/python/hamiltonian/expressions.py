"""Expressions of SymPy in the language of definitions."""

from __future__ import annotations

import sympy
from sympy.core.function import AppliedUndef
from sympy.printing.precedence import PRECEDENCE, precedence
from sympy.printing.str import StrPrinter

#: Functions of SymPy by their names here.
FUNCTIONS = {
    **{name: name for name in "sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh".split()},
    **{name: name for name in "exp erf erfc sign floor".split()},
    "Abs": "abs",
    "log": "ln",
}
#: Functions that are quotients of others.
QUOTIENTS = {"sec": "cos", "csc": "sin", "cot": "tan", "sech": "cosh", "csch": "sinh", "coth": "tanh"}


def text_of(expression, coordinates=None, momenta=None, time=None, events=None, monitors=None, invariants=None) -> str:
    """The definition of H = expression in the language, see `hamiltonian.define`."""
    try:
        h = sympy.sympify(expression)
    except (sympy.SympifyError, TypeError, AttributeError):
        h = None
    if not isinstance(h, sympy.Expr) or h.is_Matrix:
        raise TypeError(f"a definition is a text or an expression of SymPy, found {type(expression).__name__}")
    if coordinates is None or momenta is None:
        raise TypeError("an expression of SymPy needs its `coordinates` and `momenta`, tuples of symbols")
    q, p = variables("coordinates", coordinates), variables("momenta", momenta)
    if len(q) != len(p):
        raise ValueError(f"there must be as many momenta as coordinates, found {len(p)} and {len(q)}")
    t = variables("time", time) if time is not None else []
    printer = Printer(q + p + t)
    sides = [", ".join(printer.doprint(symbol) for symbol in side) for side in (q, p, t) if side]
    statements = [f"H({'; '.join(sides)}) = {printer.doprint(h)}"]
    for kind, named in (("event", events), ("monitor", monitors), ("invariant", invariants)):
        for name, value in (named or {}).items():
            statements.append(f"{kind} {name} = {printer.doprint(sympy.sympify(value))}")
    return ";\n".join(statements)


def variables(name: str, value) -> list:
    """A symbol, or a sequence of them, or of functions of time as those of ``sympy.physics.mechanics``."""
    try:
        own = list(value)
    except TypeError:
        own = [value]
    for one in own:
        if not isinstance(one, (sympy.Symbol, AppliedUndef)):
            raise TypeError(f"`{name}` must be symbols of SymPy, found {one!r}")
    if not own:
        raise ValueError(f"`{name}` must not be empty")
    return own


class Printer(StrPrinter):
    """Prints an expression in the language of definitions; a ``ValueError`` names what the language does not have."""

    def __init__(self, variables):
        super().__init__()
        self._symbols = {}
        names = [self.doprint(one) for one in variables]
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"`{name}` is there twice among the coordinates, momenta and time")

    def _named(self, name: str, symbol):
        """The name, if it is one of the language and stands for this symbol alone."""
        if not name.isidentifier():
            raise ValueError(f"the symbol `{name}` needs a name of letters, digits and `_`")
        if self._symbols.setdefault(name, symbol) != symbol:
            raise ValueError(f"two symbols are named `{name}`, with different assumptions: use one symbol")
        return name

    def _print_Symbol(self, expr):
        return self._named(expr.name, expr)

    _print_Dummy = _print_Symbol

    def _print_Function(self, expr):
        name = type(expr).__name__
        if isinstance(expr, AppliedUndef):
            return self._named(name, expr)
        arguments = [self._print(argument) for argument in expr.args]
        if name in FUNCTIONS and (len(arguments) == 1 or name == "atan2"):
            return f"{FUNCTIONS[name]}({', '.join(arguments)})"
        if name in QUOTIENTS:
            return f"(1/{QUOTIENTS[name]}({arguments[0]}))"
        if name == "ceiling":
            return f"(-floor(-({arguments[0]})))"
        if name == "Mod":
            return f"(({arguments[0]}) % ({arguments[1]}))"
        if name == "Heaviside":
            x, half = arguments
            return f"(if {x} > 0 {{ 1 }} else if {x} < 0 {{ 0 }} else {{ {half} }})"
        raise ValueError(f"the function `{name}` is not in the language: rewrite it, for example with `rewrite`")

    _print_Abs = _print_Mod = _print_Heaviside = _print_log = _print_Function

    def _extreme(self, name, expr):
        first, *others = (self._print(argument) for argument in expr.args)
        for other in others:
            first = f"{name}({first}, {other})"
        return first

    def _print_Min(self, expr):
        return self._extreme("min", expr)

    def _print_Max(self, expr):
        return self._extreme("max", expr)

    def _print_Pow(self, expr, rational=False):
        base, exponent = expr.as_base_exp()
        if exponent == sympy.S.Half:
            return f"sqrt({self._print(base)})"
        if exponent.could_extract_minus_sign():
            inverse = self.parenthesize(base**-exponent, PRECEDENCE["Pow"], strict=False)
            return f"1/{inverse}"
        return f"{self._atom(base)}^{self._atom(exponent)}"

    def _atom(self, expr):
        """An operand of a power."""
        own = self._print(expr)
        is_atom = precedence(expr) >= PRECEDENCE["Atom"] and own.replace(".", "", 1).isidentifier() or own.isdigit()
        return own if is_atom else f"({own})"

    def _print_Float(self, expr):
        return repr(float(expr))

    def _print_Exp1(self, expr):
        return "exp(1)"

    def _print_NumberSymbol(self, expr):
        return repr(float(expr))

    _print_GoldenRatio = _print_EulerGamma = _print_Catalan = _print_TribonacciConstant = _print_NumberSymbol

    def _print_Pi(self, expr):
        return "pi"

    def _print_Piecewise(self, expr):
        *branches, (last, always) = expr.args
        if always is not sympy.true and always != True:  # noqa: E712
            raise ValueError("a `Piecewise` needs a last branch with the condition `True`")
        own = f"{{ {self._print(last)} }}"
        for value, condition in reversed(branches):
            own = f"if {self._print(condition)} {{ {self._print(value)} }} else {own if own[0] == '{' else f'{{ {own} }}'}"
        return f"({own})" if branches else self._print(last)

    def _print_Relational(self, expr):
        return f"({self._print(expr.lhs)}) {expr.rel_op} ({self._print(expr.rhs)})"

    def _joined(self, sign, expr):
        return "(" + f") {sign} (".join(self._print(argument) for argument in expr.args) + ")"

    def _print_And(self, expr):
        return self._joined("&&", expr)

    def _print_Or(self, expr):
        return self._joined("||", expr)

    def _print_Not(self, expr):
        return f"!({self._print(expr.args[0])})"

    def _print_Add(self, expr, order=None):
        terms = [self._print(term) for term in self._as_ordered_terms(expr, order=order)]
        return " + ".join(terms).replace("+ -", "- ")

    def _print_Mul(self, expr):
        above, below = [], []
        sign = ""
        for factor in expr.as_ordered_factors():
            if factor.is_Rational:
                if factor < 0:
                    sign, factor = "-", -factor
                above += [str(factor.p)] if factor.p != 1 else []
                below += [str(factor.q)] if factor.q != 1 else []
            elif factor.is_Pow and factor.exp.could_extract_minus_sign():
                below.append(self._factor(factor.base**-factor.exp))
            else:
                above.append(self._factor(factor))
        own = sign + ("*".join(above) or "1")
        if below:
            own += "/" + (below[0] if len(below) == 1 else f"({'*'.join(below)})")
        return own

    def _factor(self, expr):
        """A factor of a product or quotient."""
        own = self._print(expr)
        return f"({own})" if expr.is_Add or expr.is_Mul or own.startswith(("-", "1/")) else own

    def emptyPrinter(self, expr):
        raise ValueError(f"`{type(expr).__name__}` is not in the language of definitions: {expr!s}")

    def _refused(self, expr):
        raise ValueError(f"`{expr!s}` is not in the language of definitions")

    _print_ImaginaryUnit = _print_NaN = _print_Infinity = _print_NegativeInfinity = _print_ComplexInfinity = _refused
    _print_Sum = _print_Product = _print_Integral = _print_Derivative = _print_Indexed = _print_MatrixElement = _refused
    _print_Subs = _print_Limit = _refused
