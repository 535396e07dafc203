"""Too little memory, at several depths of the run: exit code 4 and a sentence, and the earlier result as it was; no hang. Adaptive meshes end before:
exit code 3 with results and bars of the last mesh."""
import json
import resource

from judge import require, same
from world import files, finish, parts, start

LIMITS = (300, 380, 420, 450, 480)  # megabytes of addresses; libraries alone take 150, BLAS sets 128 aside
ENOUGH = 2000
ADAPTIVE = {480: 9, 560: 14}  # meshes at least; free addresses of the heap count, or there are 12 with 560
COARSE = ("-adapt", "1e-8", "-upper_dm_plex_box_faces", "2,2", "-lower_dm_plex_box_faces", "2,2")
MEGABYTE = 1 << 20


def limit_of(size):
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (size * MEGABYTE, size * MEGABYTE))


def judge(run):
    before, short = files(run), 0
    for size in LIMITS + (ENOUGH,):
        limit = limit_of(size)
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
    for size, meshes in ADAPTIVE.items():
        code, _, stderr = finish(start(run, *COARSE, preexec_fn=limit_of(size), environment={"OPENBLAS_NUM_THREADS": "1"}))
        require(code == 3 and "the next mesh would need about" in stderr and "and there are only" in stderr, f"exit code {code} with {size} MB: {stderr}")
        summary = json.loads((run.folder / "result.json").read_text())
        require(len(summary["estimate"]["meshes"]) >= meshes and summary["bars"]["pairs"]["joint"]["normal_force"] > 0, f"{len(summary['estimate']['meshes'])} meshes, or no bars, with {size} MB")
