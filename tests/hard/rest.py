"""Nothing moves, and nothing presses."""
from judge import near, same


def judge(run):
    with run.fields() as file:
        near("displacement", abs(file["displacement"][()]).max(), 0)
    near("potential", run.summary["energy"]["potential"], 0)
    for name, pair in run.summary["pairs"].items():
        near(f"force of {name}", pair["normal_force"], 0)
    same("free motions", len(run.summary["solvability"]["free_motions"]), 6)
    for motion in run.summary["solvability"]["free_motions"]:
        near("work", sum(body["work"] for body in motion.values()), 0)
