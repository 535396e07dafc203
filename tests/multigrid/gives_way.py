"""Multigrid that does not converge ends with advice where the user wanted it, and gives way to a factorisation where nobody did."""
from judge import Run, require

LARGE = ("-upper_dm_plex_box_faces", "16,16,16", "-lower_dm_plex_box_faces", "12,12,12")  # more than factorisations are the default for


def stopped(run, name, *arguments):
    """Without iterations enough; what it says is wanted here."""
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + ["-ksp_max_it", "1", *arguments])
    other.require_clean()
    return other


def judge(run):
    wanted = stopped(run, "wanted", "-pc_type", "truncatedmg", "-dm_refine", "1")
    require(wanted.exit == 3 and "try -pc_type cholesky" in wanted.stderr, f"exit {wanted.exit}, {wanted.stderr}")
    own = stopped(run, "own", *LARGE)
    require(own.exit == 0 and "factorising instead" in own.stderr, f"exit {own.exit}, {own.stderr}")
    linear = own.summary["solver"]["linear"]
    require(linear.startswith("Cholesky"), f"solved by {linear}")
