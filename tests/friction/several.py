"""Several solutions: proximal steps before Newton's steps lead to and fro between them, and the steps alone find one. 16 steps before proximal steps that do not descend
were taken back. With 50 or more steps stall. The dense system, which pivots, takes the place of multigrid: 17 and 23 steps while coefficients grew first. With
800 edges they still grow, on a coarser mesh; without that the steps alone cycle (exit code 3 after 74 steps on 32 edges)."""
from judge import require, same

MOST = 8  # Newton steps
STALLS = ("50", "1e5")  # coefficients
GROWS, LARGE, MANY = "50", "800,40", 12  # coefficient, cells with more than 1500 unknowns on the side, Newton steps


def judge_end(run, most, replaced=False):
    solver = run.summary["solver"]
    require(solver["friction"]["rho"] > 1 and not solver["friction"]["unique"], f"{solver['friction']}")
    require(max(solver["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{solver['friction']}")
    require(solver["iterations"] <= most, f"{solver['iterations']} Newton steps")
    same("whether the dense system took its place", solver["gave_way"], replaced)


def judge(run):
    judge_end(run, MOST)
    for coefficient in STALLS:
        judge_end(run.again("-floor_friction", coefficient, name=f"stalls{coefficient}"), MOST, True)
    judge_end(run.again("-floor_friction", GROWS, "-block_dm_plex_box_faces", LARGE, name="grows"), MANY)
