"""Errors against the exact solution fall as they must; the files tell the same.

Orders: theory for smooth solutions, energy h^k, L2 h^(k+1); force: the integral of the exact pressure sin(2 pi x)/50 + 1/25."""
from judge import near, require, same
from studies import block, inside, judge_files, one, rows, words


def judge(run):
    judge_files(run, orders=(1, 2), levels=3)
    same("reference", block(run)["reference"], "exact")
    table = rows(run)
    for order, energy, l2 in ((1, 0.02, 0.05), (2, 0.03, 0.1)):
        finest = one(table, order, 2)
        near(f"rate of order {order} in energy", finest["energy_error_rate"], order, absolute=energy)
        near(f"rate of order {order} in L2", finest["l2_error_rate"], order + 1, absolute=l2)
        near("h", finest["h"], 2**0.5 / 4 / 2**2, relative=1e-12)
    for column in ("joint_pressure_l2_error", "joint_pressure_weighted_error_relative", "upper_strain_energy", "joint_force_y"):
        require(all(row[column] > 0 for row in table), f"{column} is not positive")
    same("unknowns", one(table, 2, 2)["unknowns"], 2 * (33**2 + 49**2))
    inside(run, "joint_normal_force", 0.04)
    require("errors against the exact solution" in words(run), "the chart does not tell what errors are against")
