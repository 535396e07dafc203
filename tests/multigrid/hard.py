"""Hard cases with a solution, all in the long run, by multigrid at any size, with both solvers. Expected is the right answer, or a sentence
with advice. Tests of tests/hard compare figures; this one asks for the verdicts of both solvers and for the certificate."""
import pathlib
import sys

from judge import LONG, Run, require

HARD = pathlib.Path(__file__).parents[1] / "hard"
sys.path.insert(0, str(HARD))
from cases import AGREE, read_head  # pylint: disable=wrong-import-position

# Cells of 1 : 1000 in space, 1400 cells of 1 : 1400 beside one, and multipliers on the side that is a million times stiffer: rounding spoils the cycles.
# With PETSc 3.26 the ring's do end, and the second solver finds other digits.
NOT_SOLVED = {"one_against_1400", "shrink_fit_stiff_ring", "slab_needles", "stiffness_1e6_solid"}
# A bulk modulus 5000 times the shear modulus: residuals leave displacements known to seven digits (eq. 11.4).
ROUNDED = {"incompressible_in_a_box", "incompressible_pin"}
EVERY = 6  # so many cases, one is asked outside the long run, beside these
SLOW = {"one_against_1400"}  # takes as long as all others: in the long run alone
ADVICE = "not solved: the linear solver did not converge: try -pc_type cholesky"
DISAGREE = "pdas and vinewtonrsls disagree"


def scene_of(head):
    """The options of the scene that a case changes."""
    if "scene" not in head:
        return []
    places = [folder / f"{head['scene']}.opts" for folder in (HARD, HARD.parents[1] / "options")]
    return ["-options_file", str(next(place for place in places if place.exists()))]


def judge_case(run, path):
    """What is wrong with a case, or None."""
    head = read_head(path)
    if head["exit"] != "0":
        return None
    arguments = [*scene_of(head), "-options_file", str(path), "-pc_type", "truncatedmg", "-cross_check"]
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / path.stem, arguments)
    if other.exit == 3 and path.stem in NOT_SOLVED:
        return None if ADVICE in other.stderr or DISAGREE in other.stderr else other.stderr
    if other.exit != 0:
        return f"exit code {other.exit}: {other.stderr}"
    check = other.summary["solver"]["cross_check"]
    near = check["displacement_difference"] <= AGREE or path.stem in ROUNDED
    return None if check["agree"] and near else str(check)


def judge(run):
    paths = sorted((HARD / "cases").glob("*.opts"))
    chosen = paths if LONG else [path for number, path in enumerate(paths) if path.stem not in SLOW and (number % EVERY == 0 or path.stem in NOT_SOLVED | ROUNDED)]
    wrong = {path.stem: judge_case(run, path) for path in chosen}
    wrong = {name: what for name, what in wrong.items() if what}
    require(not wrong, "\n".join(f"{name}: {what}" for name, what in wrong.items()))
