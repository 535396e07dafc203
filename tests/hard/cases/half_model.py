import pathlib

from judge import Run, near

ROUNDING = 1e-10
WHOLE = pathlib.Path(__file__).parent.parent / "dent.opts"


def judge(run):
    whole = Run(run.program, run.mpiexec, run.ranks, run.folder / "whole", ["-options_file", str(WHOLE)])
    whole.require_solved()
    near("twice the force", 2 * run.pair("joint")["normal_force"], whole.pair("joint")["normal_force"], relative=ROUNDING)
    near("twice the energy", 2 * run.summary["energy"]["potential"], whole.summary["energy"]["potential"], relative=ROUNDING)
    table, all_of_it = run.table("joint"), whole.table("joint")
    mine = [p for _, p in sorted(zip(table["x"], table["pressure"]))]
    theirs = [p for x, p in sorted(zip(all_of_it["x"], all_of_it["pressure"])) if x >= 0]
    near("pressures", mine, theirs, relative=ROUNDING)
