"""Too little memory, at several depths of the run: exit code 4 and a sentence, and the earlier result as it was; no hang."""
import resource

from judge import require, same
from world import files, finish, parts, start

LIMITS = (300, 380, 420, 450, 480)  # megabytes of addresses; libraries alone take 150, BLAS sets 128 aside
ENOUGH = 2000
MEGABYTE = 1 << 20


def judge(run):
    before, short = files(run), 0
    for size in LIMITS + (ENOUGH,):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (size * MEGABYTE, size * MEGABYTE))  # pylint: disable=cell-var-from-loop
        for method in ((), ("-snes_pdas_reduce", "0")):
            code, _, stderr = finish(start(run, "-dm_refine", "1", *method, preexec_fn=limit, environment={"OPENBLAS_NUM_THREADS": "1"}))
            same("leftovers", parts(run), [])
            if code == 0:
                before = files(run)
                continue
            require(code == 4 and stderr.count("mortise: out of memory") == 1, f"exit code {code} with {size} MB: {stderr}")
            require(files(run) == before, "the earlier result has changed")
            require(size != ENOUGH, "what is enough is not")
            short += 1
    require(short, "every run had enough memory")
