"""Exceptions: the program's sentence and its exit code."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .program import Run


class MortiseError(Exception):
    """Base of all exceptions of this package.

    sentence: what is wrong, as the program says it, without "mortise: "
    exit_code: of the program, None where it did not run to its end
    run: the Run, None where there is none; with exit codes 2 and 3 it has a summary and files"""

    def __init__(self, sentence: str, exit_code: int | None = None, run: Run | None = None):
        super().__init__(sentence)
        self.sentence, self.exit_code, self.run = sentence, exit_code, run


class SceneError(MortiseError):
    """Exit code 1: the scene is wrong; the sentence names the option, its value and what is accepted."""


class NoSolutionError(MortiseError):
    """Exit code 2: the loads move a body that nothing holds; `run.summary.solvability` has the motion."""


class NotConvergedError(MortiseError):
    """Exit code 3: not solved to tolerance, or a warning with `-warnings error`."""


class ProgramError(MortiseError):
    """The program is missing, cannot be started, failed (exit code 4) or was ended by a signal (exit code negative)."""


class RunTimeoutError(MortiseError):
    """The run took longer than its timeout and was ended."""


class ResultError(MortiseError):
    """A file of results is missing or cannot be read."""


class MortiseWarning(UserWarning):
    """An entry of the list `warnings` of the summary."""


BY_EXIT_CODE = {1: SceneError, 2: NoSolutionError, 3: NotConvergedError}
