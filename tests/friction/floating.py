"""Blocks that friction alone holds, by multigrid: all nodes but one slip, and steps that let all slip know no end. Parts of steps find that node, as the dense system does."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from judge import Run, near, require  # noqa: E402
from random_scenes import arguments, law, scene  # noqa: E402

# Coulomb's law, 77 Tresca's
SEEDS = (4, 45, 77, 97, 98, 148)
STEPS = 16
OPENS = 294  # a rigid motion away from the floor, without any force: the certificate finds roundoff


def judge(run):
    for seed in SEEDS:
        words = arguments(law(scene(seed)[0], seed))
        both = [Run(run.program, run.mpiexec, 1, run.folder / f"{pc}{seed}", [*words, "-pc_type", pc, "-quiet"]) for pc in ("truncatedmg", "cholesky")]
        for done in both:
            require(done.exit == 0, f"seed {seed}: exit {done.exit}: {done.stderr}")
            solver = done.summary["solver"]
            require(solver["friction"]["sticking"] == 1, f"seed {seed}: {solver['friction']}")
            require(solver["iterations"] <= STEPS, f"seed {seed}: {solver['iterations']} steps")
        forces = [done.pair("joint")["tangential_force"] for done in both]
        near(f"seed {seed}: friction", forces[0], forces[1], absolute=1e-8)
    opens = Run(run.program, run.mpiexec, 1, run.folder / "opens", [*arguments(law(scene(OPENS)[0], OPENS)), "-pc_type", "truncatedmg", "-quiet"])
    require(opens.exit == 0, f"seed {OPENS}: exit {opens.exit}: {opens.stderr}")
    require(opens.summary["solver"]["friction"]["sticking"] == 0 and opens.pair("joint")["active_nodes"] == 0, f"seed {OPENS}: {opens.pair('joint')}")
