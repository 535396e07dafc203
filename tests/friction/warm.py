"""From a coarser mesh at most four Newton steps: in nested iteration, and on adapted meshes in every load step."""
from judge import require

MOST = 4


def judge(run):
    if "-adapt" not in run.arguments:
        require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} steps from the coarser mesh")
        return
    for step in run.summary["steps"]:
        steps = [mesh["iterations"] for mesh in step["estimate"]["meshes"]]
        require(len(steps) >= 3 and max(steps[1:]) <= MOST, f"t = {step['t']}: {steps} steps on the meshes")
