"""A full disk, a file without write permission, a closed pipe: exit code 4, or 1 if found at the start; one sentence; the earlier
result stays."""
import os
import pathlib
import resource
import signal
import stat
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


def require_special(run):
    """What is no file keeps its place: a pipe, what leads to one, and a stream of the process. Never tried with /dev itself."""
    pipe, link, stream, absent = (run.folder / name for name in ("pipe", "link.json", "stream", "absent"))
    os.mkfifo(pipe)
    link.symlink_to("pipe")
    stream.symlink_to("/proc/self/fd/1")
    for options in (["-summary", "pipe"], ["-summary", "link.json"], ["-summary", "stream"], ["-output", "link"]):
        code, _, stderr = finish(start(run, *options))
        require_said(code, stderr, 1, f"{options[0]}: {'link.json' if options[1] == 'link' else options[1]} is a device, a pipe or a stream")
    require(stat.S_ISFIFO(pipe.lstat().st_mode) and link.is_symlink() and stream.is_symlink(), "a file took the place of a pipe or a link")
    code, _, stderr = finish(start(run, "-summary", "absent"))
    same("exit code beside them", (code, stderr, absent.is_file()), (0, "", True))
    for path in (pipe, link, stream, absent):
        path.unlink()


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
    require_special(run)
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
