"""Exceptions, with the texts of the Rust errors."""

from __future__ import annotations

from typing import NamedTuple


class Diagnostic(NamedTuple):
    """One error of a definition: the fault, its remedy and its place."""

    message: str
    """The fault: one line, code in backticks."""
    help: str
    """The remedy."""
    source: str
    """The name of the text, such as that of its file."""
    line: int
    """The line, from 1 on."""
    column: int
    """The column of the first character at fault, from 1 on."""
    text: str
    """The line of the text."""


class DefinitionError(ValueError):
    """A text is no definition, or one with a feature that definitions at run time do not have.

    The text of the exception shows each error with its line, a caret below the characters at fault, and the remedy. The
    attributes ``message``, ``help``, ``source``, ``line``, ``column`` and ``text`` are those of the first error;
    ``diagnostics`` has all of them.
    """

    diagnostics: tuple[Diagnostic, ...]
    """All errors of the first stage that has any, at least one."""

    def __init__(self, diagnostics, shown: str):
        super().__init__(diagnostics, shown)
        self.diagnostics = tuple(Diagnostic(*fields) for fields in diagnostics)
        self.shown = shown
        first = self.diagnostics[0]
        self.message, self.help, self.source, self.line, self.column, self.text = first

    def __str__(self) -> str:
        return self.shown


class RunError(RuntimeError):
    """A step of a run failed: it left the domain of H, or its equations have no solution.

    The text names the step, the time and the piece. The run stands at its last good step.
    """

    solution = None
    """What `System.solve` computed before, a `Solution`."""
