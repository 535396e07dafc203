"""One linear system takes few iterations on the meshes of a file: edges are halved twice at once there, and cells may be long."""
from judge import Run, require, same

MOST = 12  # asked; 13 with five smoothing steps from 0.04; 24, 26 and 71 where every second level was omitted, on meshes that grew by other marks


def judge(run):
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / "meshes", run.arguments)
    same("exit", other.exit, 3)  # the number of meshes ends it
    iterations = other.summary["solver"]["linear_reference"]["iterations"]
    require(0 < iterations <= MOST, f"{iterations} iterations of one system")
