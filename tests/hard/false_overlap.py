"""The mean gap beside a bend of a formula within a facet is below all gaps there: the summary has its size and place. A bend between facets has none."""
from judge import Run, near, require, same

FACET, SLOPE, BEND = 0.2, 0.5, 1 / 3  # the bend is a third into the facet from 0.4 to 0.6


def antiderivative(t):
    """Of psi (t - BEND). psi = 2 - 3 t is the dual function of the node at t = 0; int psi = 1/2 on each of its two facets."""
    return -(t**3) + (2 + 3 * BEND) / 2 * t**2 - 2 * BEND * t


def judge(run):
    overlap = -SLOPE * FACET * (antiderivative(1) - antiderivative(BEND))  # all gaps there are at least 0
    near("overlap", run.pair("joint")["false_overlap"], overlap, relative=1e-9)
    near("its place", run.pair("joint")["false_overlap_at"], [0.4, 0], absolute=1e-12)
    told = f"is unreliable near (0.4, 0): the gap jumps or bends within a facet, and its mean acts as an additional overlap of {overlap:.3g}"
    (warning,) = [w for w in run.summary["warnings"] if w["code"] == "gap_jump"]  # beside it, that contact is one facet wide
    require(told in warning["text"] and warning["pair"] == "joint" and "align facets with that place" in warning["advice"], str(warning))
    near("its place in the warning", warning["at"], [0.4, 0], absolute=1e-12)
    strict = Run(run.program, run.mpiexec, run.ranks, run.folder / "strict", run.arguments + ["-warnings", "error", "-quiet"])
    same("exit code with -warnings error", (strict.exit, strict.summary["status"]), (3, "solved"))
    require(f"mortise: -warnings error: {len(run.summary['warnings'])} warnings" in strict.stderr and "is unreliable" in strict.stderr, strict.stderr)
    other = run.again("-block_dm_plex_box_faces", "15,5", name="nodes")
    require(other.pair("joint")["false_overlap"] < 1e-12 and "false_overlap_at" not in other.pair("joint"), str(other.pair("joint")))
    near("force", other.pair("joint")["normal_force"], 2, relative=1e-9)
