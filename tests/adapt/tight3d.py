"""Nearly incompressible shells in space: Lame's force lies within its bar with hexahedra that are kept, of both orders; tetrahedra are refused, and the
sentence tells what to do."""
import math

from judge import Run, near, require, same

FORCE = 0.522021 * 4 * math.pi * 2**2 / 24  # of the pressure for an interference of 0.001 and Poisson's ratio 0.4999, on a twenty-fourth


def judge(run):
    for what, one in (("order 2", run), ("order 1", run.again("-order", "1", "-adapt", "0.12", name="linear"))):
        bar = one.summary["bars"]["pairs"]["fit"]["normal_force"]
        near(f"{what}: force", one.pair("fit")["normal_force"], FORCE, absolute=bar)
        require(bar < 0.1 * FORCE, f"{what}: the bar {bar} says nothing")
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "refused", run.arguments + ["-adapt_cells", "simplices"])
    same("exit", refused.exit, 1)
    require("use hexahedra and -adapt_cells kept" in refused.stderr, f"the sentence does not tell of -adapt_cells: {refused.stderr}")
