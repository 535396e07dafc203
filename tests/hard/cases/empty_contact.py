"""The pair carries nothing, and both bodies hang and stand as each would alone: energies of the bodies in scenes of their own."""
from judge import Run, near, same


def judge(run):
    near("force", run.pair("joint")["normal_force"], 0, absolute=1e-13)
    same("nodes in contact", run.pair("joint")["active_nodes"], 0)
    for body in ("upper", "lower"):
        alone = Run(run.program, run.mpiexec, run.ranks, run.folder / body, run.arguments + ["-bodies", body, "-pairs", "wall", "-wall_nonmortar", f"{body}:left",
                    "-wall_obstacle", "plane", "-wall_obstacle_point", "-9,0", "-wall_obstacle_normal", "1,0", "-cross_check", "0", "-options_allow_unused"])
        same(f"exit code of {body} alone", alone.exit, 0)
        near(f"energy of {body}", run.summary["energy"]["strain"][body], alone.summary["energy"]["strain"][body], relative=1e-11, absolute=1e-30)
