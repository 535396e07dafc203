"""Nearly incompressible plates: the potential of an independent solution (regression/incompressible.py) lies within
all bars, though that of triangles comes from below; quadrilaterals that are kept have their error with less than a third of the unknowns.
Triangles of order 1 are refused; at nu = 0.45 they are too stiff on coarse meshes, where the estimate rises, and -adapt goes on."""
from judge import Run, near, require, same

POTENTIAL, FORCE = {"0.4999": -4587.4452, "0.45": -5021.690}, 2277068.6  # uncertain by 5e-3 and 5
UNCERTAIN = 5e-3


def limits(what, summary, poisson="0.4999"):
    potential, bars = summary["estimate"]["potential"], summary["bars"]
    near(f"{what}: limit of the potential", potential["value"], POTENTIAL[poisson], absolute=potential["bar"] + UNCERTAIN)
    near(f"{what}: potential", summary["energy"]["potential"], POTENTIAL[poisson], absolute=bars["energy"]["potential"])
    if poisson == "0.4999":
        near(f"{what}: force", summary["pairs"]["joint"]["normal_force"], FORCE, absolute=bars["pairs"]["joint"]["normal_force"])


def judge(run):
    cut = Run(run.program, run.mpiexec, run.ranks, run.folder / "cut", run.arguments + ["-adapt_cells", "simplices", "-adapt_max_unknowns", "20000"])
    same("exit", cut.exit, 3)  # by the limit
    require("nearly incompressible, and -adapt_cells kept takes far fewer unknowns" in cut.stdout, "nothing tells of -adapt_cells")
    mine, other = run.summary["estimate"], cut.summary["estimate"]
    worst = other["meshes"][-1]
    enough = min(mesh["unknowns"] for mesh in mine["meshes"] if mesh["estimate"] <= worst["estimate"])
    require(3 * enough <= worst["unknowns"], f"{enough} unknowns have the error of {worst['unknowns']} in triangles")
    linear = run.again("-order", "1", "-adapt", "0.05", name="linear")
    for what, one in (("kept", run), ("triangles", cut), ("order 1", linear)):
        limits(what, one.summary)
    require(cut.summary["energy"]["potential"] < POTENTIAL["0.4999"], "the potential of triangles comes from above")
    stiff = run.again("-upper_poisson", "0.45", "-lower_poisson", "0.45", "-order", "1", "-adapt", "0.1", "-adapt_cells", "simplices", name="stiff")
    limits("triangles of order 1", stiff.summary, "0.45")
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "refused", run.arguments + ["-order", "1", "-adapt_cells", "simplices"])
    same("exit", refused.exit, 1)
    require("use quadrilaterals and -adapt_cells kept" in refused.stderr, "the sentence does not tell of -adapt_cells")
