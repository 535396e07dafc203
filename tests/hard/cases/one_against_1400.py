"""Weight and lever arm; and a second solver that is not given enough iterations."""
from judge import near, require

FEW = 10  # iterations of the second solver, which needs more


def judge(run):
    near("force", run.pair("joint")["force"], [0, -1.5], absolute=1e-9)
    near("place", run.pair("joint")["centre_of_pressure"][0], 5 / 9, absolute=1e-8)
    require(run.summary["solver"]["cross_check"]["iterations"] > FEW, "no case for more iterations than those few")
    short = run.again("-cross_check_snes_max_it", str(FEW), name="short", warns=["free_motion", "not_confirmed"])
    require(short.summary["status"] == "solved" and not short.summary["solver"]["cross_check"]["converged"], str(short.summary["solver"]))
    require(f"in {FEW} iterations (-cross_check_snes_max_it)" in short.stderr, short.stderr)
