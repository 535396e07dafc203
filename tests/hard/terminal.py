"""The progress table is for somebody who looks on: there on a terminal, and in no file, also where mpiexec stands between."""
import os
import pty
import subprocess

from judge import ALONE, TIMEOUT, require

HEAD = "iteration   active  changed"


def on_terminal(run):
    """What the run's command says on a terminal of its own."""
    ours, theirs = pty.openpty()
    environment = os.environ | ({} if run.ranks > 1 else ALONE)
    with subprocess.Popen(run.command, cwd=run.folder, env=environment, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs) as process:
        os.close(theirs)
        said = b""
        try:
            while part := os.read(ours, 65536):
                said += part
        except OSError:  # Linux says so when nobody has the terminal open any more
            pass
        require(process.wait(TIMEOUT) == 0, f"exit code {process.returncode} on a terminal")
    os.close(ours)
    return said.decode()


def judge(run):
    require(HEAD not in run.stdout, "a table of progress where nobody looks on")
    require(HEAD in on_terminal(run), "no table of progress on a terminal")
