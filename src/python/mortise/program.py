"""The program: where it is, and one run of it."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import tempfile
import threading
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .errors import BY_EXIT_CODE, MortiseError, MortiseWarning, ProgramError, RunTimeoutError
from .results import Results, Summary, read_summary
from .scene import arguments_of

# Without mpiexec, Open MPI starts several times faster without its daemon; and processes that start together do not share its folder.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0"}
POLL = 0.2  # seconds between two looks whether a run is to be ended
GRACE = 10.0  # seconds that a run has to remove its unfinished files
MOST_LINES = 20  # of the messages of a failure without a sentence of the program


def find_program() -> str:
    """The path of the program: $MORTISE; bin of the installation that this package is part of; mortise of the PATH; the newest of the build
    folders of the source that this package is part of. Raises ProgramError where there is none."""
    named = os.environ.get("MORTISE")
    if named:
        found = shutil.which(named)
        if not found:
            raise ProgramError(f"MORTISE is {named}, which is no program")
        return found
    package = pathlib.Path(__file__).resolve().parent
    beside = package.parents[3] / "bin" / "mortise"  # <prefix>/share/mortise/python/mortise
    tree = package.parents[2] / "build"  # <source>/src/python/mortise
    built = [path for pattern in ("mortise", "*/mortise") for path in tree.glob(pattern) if path.is_file() and os.access(path, os.X_OK)]
    newest = max(built, key=lambda path: path.stat().st_mtime, default="")
    for found in (shutil.which(str(beside)), shutil.which("mortise"), str(newest)):
        if found:
            return found
    raise ProgramError("the program mortise is neither beside this package nor in the PATH; give its path as MORTISE")


class Run(Results):
    """One run of the program and its results.

    command: as it was called; exit_code: 0 solved, 1 wrong scene, 2 no solution, 3 not to tolerance, 4 failed, negative: ended by a signal
    stdout, stderr: what it printed; seconds: from its start to its end"""

    def __init__(self, command: list[str], exit_code: int, stdout: str, stderr: str, seconds: float, prefix: str | None, summary: Summary | None):
        super().__init__(prefix, summary)
        self.command, self.exit_code, self.stdout, self.stderr, self.seconds = command, exit_code, stdout, stderr, seconds

    @property
    def sentence(self) -> str:
        """Why the run is not solved, as the program says it; "" if it is."""
        if self.exit_code == 0:
            return ""
        said = [line[len("mortise: "):] for line in self.stderr.splitlines() if line.startswith("mortise: ") and not line.startswith("mortise: warning: ")]
        told = [line for line in self.stderr.splitlines() if line.strip(" -")]  # Open MPI has lines of dashes
        return "\n".join(said or told[:MOST_LINES] or [f"exit code {self.exit_code} without a message"])

    def error(self) -> MortiseError | None:
        """The exception that tells of an exit code other than 0, else None."""
        if self.exit_code == 0:
            return None
        kind = BY_EXIT_CODE.get(self.exit_code, ProgramError)
        if self.exit_code == 1 and "mortise: " not in self.stderr:  # that of mpiexec
            kind = ProgramError
        return kind(self.sentence, self.exit_code, self)


def end(process: subprocess.Popen[str]) -> None:
    """Ends a run, with time to remove its unfinished files; mpiexec ends its ranks."""
    process.terminate()
    try:
        process.communicate(timeout=GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()


@dataclass
class Limits:
    """What bounds a run: seconds; an event that ends it when set; threads of its BLAS, None for the program's own choice."""

    timeout: float | None = None
    stop: threading.Event | None = None
    threads: int | None = None


def environment_of(ranks: int, limits: Limits) -> dict[str, str]:
    """Variables of a run; those that the user has set win."""
    threads = {name: str(limits.threads) for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")} if limits.threads else {}
    return {**({} if ranks > 1 else ALONE), **threads, **os.environ}


def execute(command: list[str], environment: Mapping[str, str], limits: Limits) -> tuple[int, str, str]:
    """Exit code, stdout and stderr of a command."""
    last = time.monotonic() + limits.timeout if limits.timeout is not None else None
    try:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
    except OSError as error:
        raise ProgramError(f"{command[0]} cannot be started ({error.strerror})") from None
    try:
        while True:
            left = POLL if last is None else min(POLL, last - time.monotonic())
            try:
                stdout, stderr = process.communicate(timeout=max(left, 0))
                return process.returncode, stdout, stderr
            except subprocess.TimeoutExpired:
                if last is not None and time.monotonic() >= last:
                    raise RunTimeoutError(f"the run was ended after its timeout of {limits.timeout:g} seconds") from None
                if limits.stop is not None and limits.stop.is_set():
                    raise ProgramError("the run was ended because the loop was") from None
    finally:
        if process.poll() is None:
            end(process)


def tell_warnings(run: Run, level: int) -> None:
    for warning in run.warnings:
        if warning.get("accepted"):  # the scene expects it: -warnings_accept
            continue
        place = warning.get("body") or warning.get("pair")
        words = "; ".join(filter(None, (warning["text"], warning.get("advice"))))
        warnings.warn(f"{warning['code']}{f' ({place})' if place else ''}: {words}", MortiseWarning, stacklevel=level + 1)


def stamp(path: str) -> tuple[int, int] | None:
    """Tells a file from an earlier one of the same name."""
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def run_quietly(scene: str | os.PathLike[str] | Mapping[str, Any], overrides: Mapping[str, Any] | None, output: str | os.PathLike[str] | None,
                ranks: int, program: str | None, limits: Limits) -> Run:
    """One run, whatever its exit code. See run()."""
    if ranks < 1:
        raise ValueError(f"ranks={ranks}: a run needs at least one")
    options = dict(scene) if isinstance(scene, Mapping) else {"options_file": os.fspath(scene)}
    options.update(overrides or {})
    prefix = options.pop("output", None) if output is None else os.fspath(output)
    with tempfile.TemporaryDirectory(prefix="mortise") as folder:
        to = {"output": prefix} if prefix else {"summary": f"{folder}/summary.json"}
        launcher = [os.environ.get("MPIEXEC", "mpiexec"), "-n", str(ranks)] if ranks > 1 else []
        command = [*launcher, program or find_program(), *arguments_of({**options, **to, "quiet": True})]
        base = prefix or f"{folder}/summary"
        before, begin = stamp(f"{base}.json"), time.monotonic()
        code, stdout, stderr = execute(command, environment_of(ranks, limits), limits)
        seconds = time.monotonic() - begin
        summary = read_summary(base) if stamp(f"{base}.json") != before else None  # a wrong scene leaves that of an earlier run
    if summary and not prefix:
        prefix = (summary.get("options") or {}).get("output")  # of the options file
    return Run(command, code, stdout, stderr, seconds, prefix, summary)


def run(scene: str | os.PathLike[str] | Mapping[str, Any], overrides: Mapping[str, Any] | None = None, *, output: str | os.PathLike[str] | None = None,
        ranks: int = 1, timeout: float | None = None, program: str | None = None, check: bool = True) -> Run:
    """Solves a scene.

    scene: an options file, or the options as a dictionary (see arguments_of()); overrides: options that win over it
    output: prefix of the files, as -output; its folder is made. Without it there is a summary, but no tables and fields
    ranks: MPI processes, started by $MPIEXEC or mpiexec; timeout: seconds, then the run is ended
    program: path of the program, else find_program()
    check: raise SceneError, NoSolutionError, NotConvergedError or ProgramError where the exit code is not 0; they have the Run as `run`

    Returns the Run. Each entry of its warnings is a Python warning of class MortiseWarning, too. Raises RunTimeoutError."""
    done = run_quietly(scene, overrides, output, ranks, program, Limits(timeout))
    tell_warnings(done, 2)
    error = done.error() if check else None
    if error:
        raise error
    return done
