"""No room on the disk, a file that nobody may write, nobody who reads: exit code 4 (or 1, where it is known before) and one
sentence, and the earlier result as it was."""
import pathlib
import resource
import signal
import subprocess

from judge import require, same
from world import files, finish, parts, start

KILOBYTE = 1024


def require_untouched(run, before):
    same("leftovers", parts(run), [])
    require(files(run) == before, "the earlier result has changed")


def require_said(code, stderr, expected, text):
    same("exit code", code, expected)
    told = [line for line in stderr.splitlines() if line.startswith("mortise: ")]
    require(len(told) == 1 and text in told[0] and "PETSC ERROR" not in stderr, f"not one sentence with '{text}': {stderr}")


def judge(run):
    before = files(run)
    for size in (1, 4, 64, 400):  # kilobytes of the largest file: as if the disk were full there
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size * KILOBYTE, size * KILOBYTE))  # pylint: disable=cell-var-from-loop
        code, _, stderr = finish(start(run, preexec_fn=limit))
        require_said(code, stderr, 4, "cannot write result")
        require_untouched(run, before)
    (run.folder / "result.xdmf").unlink()
    (run.folder / "result.xdmf").mkdir()
    code, _, stderr = finish(start(run))
    require_said(code, stderr, 1, "result.xdmf")
    (run.folder / "result.xdmf").rmdir()
    (run.folder / "result.xdmf").write_bytes(before["result.xdmf"])
    require_untouched(run, before)
    if pathlib.Path("/dev/full").exists():
        with open("/dev/full", "w", encoding="utf-8") as full:
            code, _, stderr = finish(start(run, "-summary", "-", stdout=full))
        require_said(code, stderr, 4, "cannot write what is printed")
    closed = ["/bin/sh", "-c", 'exec "$@" >&- 2>&-', "sh", *run.command, "-title", "closed"]
    same("exit code without streams", subprocess.run(closed, cwd=run.folder, check=False).returncode, 0)
    same("title", run.summary["scene"]["title"], "closed")
    same("title of the fields", run.fields().attrs["title"], "closed")
    reader = start(run, "-scene_view")  # into a pipe that is closed after its first line
    reader.stdout.readline()
    reader.stdout.close()
    reader.stderr.close()
    require(reader.wait() in (0, -signal.SIGPIPE), f"exit code {reader.returncode} at a closed pipe")
    same("leftovers", parts(run), [])
