"""Bolt and sleeve as two springs: stiffness shares before the joint opens, the whole load after it."""
from judge import Run, near, require

BOLT, SLEEVE, F = 1e5 * 1 / 50, 1e5 * 3 / 50, 1000
YOKE = 3e-4  # what a yoke of 1e5 times the modulus of the bars bends by


def judge(run):
    tightened = run.again("-yoke_bc_force_top", "0,0", name="tightened")
    for step, load in [(tightened.summary, 0)] + [(s, 500 * s["t"]) for s in run.again("-load_steps", "0,0.5,1,1.5,2,2.5,3", name="steps").summary["steps"]]:
        force = step["pretension"]["bolt"]["force"]
        closed = load < F * (BOLT + SLEEVE) / SLEEVE
        near("bolt", force, F + load * BOLT / (BOLT + SLEEVE) if closed else load, relative=YOKE)
        near("sleeve", step["pairs"]["joint"]["normal_force"], F - load * SLEEVE / (BOLT + SLEEVE) if closed else 0, absolute=YOKE * F)
        near("section", step["reactions"]["bolt:bottom"][1] + step["reactions"]["bolt:left"][1], -force, relative=1e-9)
        if load == 0:
            near("pretension", force, F, relative=1e-9)
            near("strain", step["pretension"]["bolt"]["strain"], -F / 50 * (1 / BOLT + 1 / SLEEVE), relative=YOKE)
    # tightened while the load acts; not to be had where the load is larger
    near("loaded", run.summary["pretension"]["bolt"]["force"], F, relative=1e-9)
    opened = Run(run.program, run.mpiexec, run.ranks, run.folder / "opened", [*run.arguments, "-yoke_bc_force_top", "0,1500"])
    require(opened.exit == 3 and "-bolt_pretension" in opened.stderr and "it carries 1500" in opened.stderr, opened.describe())
    # a formula of t is met in every step
    for step in run.again("-load_steps", "0.5,1", "-bolt_pretension", "1000+400*t", "-yoke_bc_force_top", "0,100", name="formula").summary["steps"]:
        near("formula", step["pretension"]["bolt"]["force"], 1000 + 400 * step["t"], relative=1e-9)
