"""A rigid motion: displacements to 1e-10 of the largest, no energy, no force in the ties."""
import numpy as np

from judge import near


def judge(run):
    with run.fields() as file:
        points, u = file["points"][()], file["displacement"][()]
    turn = np.cross([-3e-3, 2e-3, -1e-3], np.pad(points, ((0, 0), (0, 3 - points.shape[1]))) - [2, 0.3, -0.4])
    exact = turn if run.summary["scene"]["dimension"] == 3 else 1e-3 * np.column_stack([0.3 - points[:, 1], points[:, 0] - 2])
    near("displacement", u[:, : exact.shape[1]].ravel(), exact.ravel(), relative=1e-10)
    for body, energy in run.summary["energy"]["strain"].items():
        near(f"strain energy of {body}", energy, 0, absolute=1e3 * 1e-20)  # Young's modulus, strains of 1e-10
    for name, pair in run.summary["pairs"].items():
        near(f"force of {name}", pair["force"], [0] * len(pair["force"]), absolute=1e-10)
    near("estimated error", run.summary["estimate"]["energy_norm"], 0, absolute=1e-9)  # 1e-2 without the arm's part of the jump
    judge_loaded(run)


def judge_loaded(run):
    """Under a load on top, too, what a tie takes from one body it hands to the other, force and moment."""
    traction = "1,2,-5" if run.summary["scene"]["dimension"] == 3 else "1,-5"
    loaded = run.again("-top_bc_traction", "top", "-top_bc_traction_top", traction, name="loaded")
    for name, pair in loaded.summary["pairs"].items():
        near(f"moment that {name} loses", pair["moment_imbalance"], 0, absolute=1e-12)
    near("balance of moments", loaded.summary["solver"]["balance"]["moment"], 0, absolute=1e-9)
