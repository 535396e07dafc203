"""All contact nodes touch, and none resists the motion that is free: said with their number, as a warning."""
from judge import require, same


def judge(run):
    summary = run.summary
    same("active nodes", (summary["pairs"]["floor"]["active_nodes"], summary["scene"]["pairs"]["floor"]["candidates"]), (9, 9))
    codes = [warning["code"] for warning in summary["warnings"]]
    same("warnings", codes, ["free_motion"])
    sentence = "body block slides along (1, 0), which none of its 9 contact nodes resists"
    require(sentence in summary["warnings"][0]["text"], f"the warning is {summary['warnings'][0]['text']}")
    require(f"free motion: {sentence}" in run.stdout, f"the terminal says {run.stdout}")
    require("no contact touches" not in run.stdout + run.stderr, "contact nodes that touch are denied")
    apart = run.again("-floor_obstacle_point", "0,-0.5", "-floor_reach", "1", name="apart", warns=["free_motion", "open_contact"])
    require("none of its 9 contact nodes" in apart.stdout, apart.stdout)
    strict = run.again("-warnings", "tell", "-block_bc_displacement", "top,left", "-block_bc_displacement_left", "0,free", name="held", warns=[])
    same("free motions", strict.summary["solvability"]["free_motions"], [])
