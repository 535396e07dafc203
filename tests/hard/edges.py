"""A block whose partner ends within a facet: it tips about the end of the partner, not about a node."""
from judge import Run, near, require, same


def pressed_at(x, end, *options):
    """A load of 1 on the upper block right above x, over a lower block that ends at `end`."""
    slope = 12 * (x - 0.5)
    return ["-upper_body_force", "0,0", "-lower_dm_plex_box_upper", f"{end!r},0", "-upper_bc_traction_top", f"0, 0-({1 - slope / 2!r})-({slope!r})*x", *options]


def run_at(run, name, *arguments):
    case = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + pressed_at(*arguments))
    case.require_clean()
    return case


def judge_refused(run, name, x, end, *options):
    """The load is beyond the end, if only by less than a facet: its arm is the work."""
    case = run_at(run, name, x, end, *options)
    same(f"exit code of {name}", case.exit, 2)
    solvability = case.summary["solvability"]
    near(f"{name}: what it turns about", solvability["motion"]["upper"]["centre"], [end, 0], absolute=1e-9)
    near(f"{name}: work", solvability["work"], x - end, absolute=1e-9)
    same(f"{name}: on this mesh", solvability["on_this_mesh"], False)
    require("body upper tips about" in case.stderr and "on this mesh" not in case.stderr, f"{name}: {case.stderr!r}")


def judge(run):
    for name, options in {"linear": [], "quadratic": ["-order", "2"], "swapped": ["-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom"]}.items():
        judge_refused(run, f"{name}_near", 0.42, 0.4, *options)  # the next node is at 0.4375
        if run.ranks == 1:
            judge_refused(run, f"{name}_far", 0.5, 0.4, *options)
    judge_verge(run)
    if run.ranks == 1:
        judge_beside(run)


def judge_beside(run):
    """On the partner, and between its end and a node that there is: solved as any other load."""
    held = run_at(run, "held", 0.39, 0.4)
    held.require_solved()
    near("force", held.pair("joint")["force"], [0, 1], absolute=1e-9)
    run_at(run, "fine", 0.3755, 0.376, "-upper_dm_plex_box_faces", "125,16").require_solved()  # a node at 0.376


def judge_verge(run):
    """Right over the end, and between the last node that can press and the end."""
    verge = run_at(run, "verge", 0.4, 0.4)
    same("exit code on the verge", verge.exit, 0)
    require("tips about (0.4, 0)" in verge.summary["solvability"]["sentence"] and verge.summary["solvability"]["verdict"] == "marginal", "no warning at the end")
    # the last node that can press is at 0.375: the next one is covered on a sliver
    coarse = run_at(run, "coarse", 0.3755, 0.376)
    same("exit code of a load between node and end", coarse.exit, 2)
    require("no solution on this mesh: body upper tips about (0.375" in coarse.stderr and "refine" in coarse.stderr, f"coarse: {coarse.stderr!r}")
    same("on this mesh", coarse.summary["solvability"]["on_this_mesh"], True)
