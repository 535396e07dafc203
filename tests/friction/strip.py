"""A strip that is pulled and pushed between two plates: Masing's loop of a bar whose friction per length is given. Energy of all steps, and the loop with Tresca's law,
by which both ways of the loop are equal. By multigrid the end of stick moved by 15 nodes a step: 43 steps, with a start without friction, which alone holds the strip."""
from judge import near, require

MOST = 12  # Newton steps of a load step by multigrid, with those of all passes

FORCE, SHEAR, HEIGHT, YOUNG = 150, 3, 1, 70e3
K = YOUNG * HEIGHT * SHEAR
LENGTH = FORCE / SHEAR


def loop(run, name, more):
    """[in] more - than the error of the strip's height over the length that slides"""
    steps = run.summary["steps"]
    for number, (step, way, took) in enumerate(zip(steps, (0, 1, -1, 1), (0, 1 / 6, 1 / 3, 1 / 3)), 1):
        near(f"{name}: end at step {number}", step["probes"]["end"]["displacement"][0], way * FORCE**2 / (2 * K), absolute=more * FORCE**2 / (2 * K))
        near(f"{name}: friction took at step {number}", step["pairs"]["plate"]["dissipation"], took * FORCE**3 / K, relative=more)
        near(f"{name}: friction", step["pairs"]["plate"]["tangential_force"][0], -FORCE * step["t"], absolute=1e-7 * FORCE)


def judge(run):
    loop(run, "Coulomb", 8e-3)
    bound = run.again("-plate_friction", "0", "-plate_friction_bound", str(SHEAR), name="tresca")
    loop(bound, "Tresca", 2.5e-3)
    ends = [step["probes"]["end"]["displacement"][0] for step in bound.summary["steps"]]
    near("the loop is closed", [ends[3], ends[2]], [ends[1], -ends[1]], relative=1e-3)
    iterated = run.again("-pc_type", "truncatedmg", name="multigrid").summary["steps"]
    require(max(step["iterations"] for step in iterated) <= MOST, f"{[step['iterations'] for step in iterated]} Newton steps")
    near("ends by multigrid", [step["probes"]["end"]["displacement"][0] for step in iterated], [step["probes"]["end"]["displacement"][0] for step in run.summary["steps"]], relative=1e-6, absolute=1e-9)
    share = bound.summary["steps"][1]["pairs"]["plate"]["slip_share"]
    require(abs(share * 100 - LENGTH) < 1.5 * HEIGHT, f"{share * 100} mm slide")
