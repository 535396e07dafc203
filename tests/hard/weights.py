"""A pile of blocks: every joint carries the weight of what is above it, under its centre of gravity."""
from judge import near, same

WEIGHTS = {"joint": [1, 0.91, 0.82, 0.73, 0.64], "j": [1, 0.92 * 0.93, 0.84 * 0.88, 0.75 * 0.82, 0.66 * 0.76]}
CENTRES = {"joint": [[0.5], [0.505], [0.51], [0.515], [0.52]], "j": [[0.5, 0.5], [0.51, 0.485], [0.52, 0.48], [0.525, 0.47], [0.53, 0.46]]}


def judge(run):
    prefix = "joint" if "joint1" in run.summary["pairs"] else "j"
    dim = run.summary["scene"]["dimension"]
    for k in range(5):
        above = WEIGHTS[prefix][k:]
        centre = [sum(w * c[axis] for w, c in zip(above, CENTRES[prefix][k:])) / sum(above) for axis in range(dim - 1)]
        joint = run.pair(f"{prefix}{k + 1}")
        near(f"force of joint {k + 1}", joint["force"], [0] * (dim - 1) + [sum(above)], absolute=1e-9)
        near(f"place of the force of joint {k + 1}", joint["centre_of_pressure"][:-1], centre, absolute=1e-9)
    same("verdict", run.summary["solvability"]["verdict"], "free_motion")
    same("free motions", len(run.summary["solvability"]["free_motions"]), 5 * (1 if dim == 2 else 3))
