"""Without an exact solution the finest run stands for it, and values are extrapolated.

Reference values: an independent high-order solution (potential -5918.26337(9), force 1836995.08(2), strain energies 2339.57274 and
3578.69063)."""
from judge import near, require, same
from studies import block, inside, judge_files, judge_same, one, rows, words


def judge(run):
    judge_files(run, orders=(1, 2), levels=4)
    same("reference", block(run)["reference"], "order 2, level 3")
    table = rows(run)
    finest = one(table, 2, 3)
    require(finest["energy_error_to_finest"] != finest["energy_error_to_finest"], "the reference has an error")
    for order in (1, 2):
        errors = [one(table, order, level)["energy_error_to_finest_relative"] for level in range(3)]
        require(errors[0] > 1.6 * errors[1] > 2.5 * errors[2] > 0, f"errors of order {order} do not fall: {errors}")
    # ||u - v||^2 in the energy norm is twice the difference of potentials if v is the better solution in the same cone
    lost = 2 * (one(table, 2, 2)["potential"] - finest["potential"])
    near("energy norm from potentials", one(table, 2, 2)["energy_error_to_finest"] ** 2, lost, relative=0.02)
    inside(run, "potential", -5918.26337)
    inside(run, "joint_normal_force", 1836995.08)
    inside(run, "upper_strain_energy", 2339.57274)
    inside(run, "lower_strain_energy", 3578.69063)
    require("differences from order 2, level 3, which stands for the exact solution" in words(run), "the chart is silent on the reference")
    require("joint: normal force" in run.stdout and " +- " in run.stdout, "the terminal does not tell the extrapolated force")
    require("\r" not in run.stdout and "\033" not in run.stdout, "control characters where there is no terminal")

    judge_same(run.again(), run, relative=1e-13)  # ranks add up what comes as it comes, and some BLAS kernels as memory is aligned
    # a run of a study begins at the coarser solution, this one at rest
    alone = run.again("-study_levels", "1", "-study_orders", "2", "-dm_refine", "3", "-snes_pdas_start", "empty", name="alone")
    cold = rows(alone)[0]
    for name in ("potential", "joint_normal_force", "middle_displacement_x", "middle_von_mises", "unknowns", "active"):
        near(name, finest[name], cold[name], relative=1e-9)
    require(finest["iterations"] < cold["iterations"], f"{finest['iterations']} steps, {cold['iterations']} from rest: the start is no help")
