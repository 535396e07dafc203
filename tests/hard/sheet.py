"""Springs that hold a body meanwhile get weaker where the body resists a motion hardly more than they do."""
from judge import require, same

SWEEPS = 12  # 9; 28 and a certified error of 3e-8 where springs stay as they are
BOUND = 1e-9


def judge(run):
    solver = run.summary["solver"]
    require(solver["sweeps"] <= SWEEPS, f"{solver['sweeps']} sweeps")
    require(solver["energy_bound"]["relative"] <= BOUND, f"error {solver['energy_bound']}")
    force = run.summary["pairs"]["support"]["force"][1]
    require(abs(force + 2) <= 1e-7 * 2, f"force {force} for -2")  # 2 on a length of 1
    require(solver["cross_check"]["agree"], str(solver["cross_check"]))
    other = run.again("-pc_type", "truncatedmg", "-dm_refine", "1", "-cross_check_pc_type", "cholesky", name="multigrid").summary["solver"]
    require(other["cross_check"]["agree"] and other["sweeps"] <= SWEEPS, f"by multigrid: {other['sweeps']} sweeps, {other['cross_check']}")
    same("solver", other["linear"], "cg with truncatedmg")
