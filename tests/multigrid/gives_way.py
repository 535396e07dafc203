"""Multigrid that does not converge: advice if the user chose it, else a factorization replaces it."""
from judge import Run, require

LARGE = ("-upper_dm_plex_box_faces", "19,19,19", "-lower_dm_plex_box_faces", "16,16,16")  # more than factorizations are the default for


def stopped(run, name, *arguments):
    """Without iterations enough; what it says is wanted here."""
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + ["-ksp_max_it", "1", *arguments])
    other.require_clean()
    return other


def require_factorized(run):
    linear = run.summary["solver"]["linear"]
    require(run.exit == 0 and linear.startswith("Cholesky"), f"exit {run.exit}, solved by {linear}, {run.stderr}")


def judge(run):
    wanted = stopped(run, "wanted", "-pc_type", "truncatedmg", "-dm_refine", "1")
    require(wanted.exit == 3 and "try -pc_type cholesky" in wanted.stderr, f"exit {wanted.exit}, {wanted.stderr}")
    own = stopped(run, "own", *LARGE, "-measure_linear")
    require("factorizing instead" in own.stderr, own.stderr)
    require_factorized(own)
    reference = own.summary["solver"]["linear_reference"]  # of the factorization: levels had nothing to do
    require(reference["work_units"] is None and reference["contact_ratio"] > 0, f"one linear solve: {reference}")
    require_factorized(stopped(run, "stop", "-stop", "discretisation", "-dm_refine", "2"))  # which then has nothing to stop
