"""The cross-check by multigrid: the second solver uses the levels of the first one, and finds an error of the first one."""
from judge import Run, require, same

AGREE = 1e-9  # of displacements, relative to the largest: a tenth of what solvers may differ by
STEPS = 4  # on the finest level; from scratch there are more, the finer the mesh the more
MULTIGRID = "cg with truncatedmg"


def check_of(run):
    return run.summary["solver"]["cross_check"]


def floats(run):
    """Whether springs hold a body meanwhile: each of their sweeps takes a step, and mends what the one before has left."""
    return any(body["floating"] for body in run.summary["scene"]["bodies"].values())


def ended(run, name, code, *arguments):
    """A run that says something."""
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + list(arguments))
    same(f"exit code of {name}", other.exit, code)
    return other


def judge_agreement(run):
    """Both ways round, on levels that get finer."""
    for snes, other in (("pdas", "vinewtonrsls"), ("vinewtonrsls", "pdas")):
        for refine in (0, 1):
            finer = ("-dm_refine", str(int(run.arguments[run.arguments.index("-dm_refine") + 1]) + refine))
            check = check_of(run.again("-snes_type", snes, *finer, name=f"{snes}{refine}"))
            same("second solver", (check["type"], check["linear"]), (other, MULTIGRID))
            require(check["agree"] and check["active_difference"] == 0, f"{snes} and {other} disagree")
            require(check["displacement_difference"] <= AGREE, f"{snes} and {other} differ by {check['displacement_difference']:.2g}")
            require(floats(run) or check["iterations"] <= STEPS, f"{other} takes {check['iterations']} steps on the finest level")
            require(check["work_units"] > 0, "no work on levels")


def judge(run):
    judge_agreement(run)
    check = check_of(run.again("-cross_check_pc_type", "cholesky", name="factored"))
    require(check["linear"].startswith("Cholesky") and check["displacement_difference"] <= AGREE, f"by factorization: {check}")

    if not floats(run):
        wrong = ended(run, "wrong", 3, "-snes_rtol", "1e-3", "-ksp_rtol", "1e-3")
        require(check_of(wrong)["converged"] and not check_of(wrong)["agree"] and "disagree" in wrong.stderr, "a wrong solution is not seen")

    stopped = ("-cross_check_ksp_max_it", "1")
    own = ended(run, "gives_way", 0, *stopped)
    require("factorizing instead" in own.stderr and check_of(own)["linear"].startswith("Cholesky"), own.stderr)
    wanted = ended(run, "not_confirmed", 0, *stopped, "-cross_check_pc_type", "truncatedmg")
    wanted.require_warned()
    strict = ended(run, "strict", 3, *stopped, "-cross_check_pc_type", "truncatedmg", "-warnings", "error")
    require("not confirmed: vinewtonrsls found no solution" in strict.stderr, strict.stderr)
