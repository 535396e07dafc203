"""Triangles of order 2 at Poisson's ratio 0.49, whose change of volume counts at every point: smoothing over stars takes more steps."""
from judge import require

MOST = 15  # with three steps from 0.07 they take 27, and 31 on the finer mesh


def judge(run):
    counts = []
    for refine in ("1", "2"):
        again = run.again("-measure_linear", "1", "-dm_refine", refine, name=f"refine{refine}")
        counts.append(again.summary["solver"]["linear_reference"]["iterations"])
    require(max(counts) <= MOST, f"{counts} iterations")
