"""Nearly incompressible plates: quadrilaterals that are kept have the error of triangles with less than a third of the unknowns, and either
order has the same force. Triangles of order 1 are refused."""
from judge import Run, near, require, same


def judge(run):
    cut = Run(run.program, run.mpiexec, run.ranks, run.folder / "cut", run.arguments + ["-adapt_cells", "simplices", "-adapt_max_unknowns", "20000"])
    same("exit", cut.exit, 3)  # by the limit
    require("nearly incompressible, and -adapt_cells kept takes far fewer unknowns" in cut.stdout, "nothing tells of -adapt_cells")
    mine, other = run.summary["estimate"], cut.summary["estimate"]
    worst = other["meshes"][-1]
    enough = min(mesh["unknowns"] for mesh in mine["meshes"] if mesh["estimate"] <= worst["estimate"])
    require(3 * enough <= worst["unknowns"], f"{enough} unknowns have the error of {worst['unknowns']} in triangles")
    linear = run.again("-order", "1", "-adapt", "0.05", name="linear")
    near("force", run.pair("joint")["normal_force"], linear.pair("joint")["normal_force"],
         absolute=sum(one.summary["bars"]["pairs"]["joint"]["normal_force"] for one in (run, linear)))
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "refused", run.arguments + ["-order", "1", "-adapt_cells", "simplices"])
    same("exit", refused.exit, 1)
    require("use quadrilaterals and -adapt_cells kept" in refused.stderr, "the sentence does not tell of -adapt_cells")
