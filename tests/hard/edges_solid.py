"""A block in space over the end of another, which is within a facet: it tips about that end."""
from judge import Run, near, same

SHIFTED = ["-b3_dm_plex_box_lower", "0.7,0.04,2", "-b3_dm_plex_box_upper", "1.54,0.92,3"]


def judge(run):
    case = Run(run.program, run.mpiexec, run.ranks, run.folder / "shifted", run.arguments + SHIFTED)
    same("exit code", case.exit, 2)
    case.require_clean()
    motion = case.summary["solvability"]["motion"]
    same("bodies", sorted(motion), ["b4", "b5"])
    near("what b4 turns about", motion["b4"]["centre"][::2], [0.7, 3], absolute=1e-9)
    near("axis", motion["b4"]["rotation"], [0, -1, 0], absolute=1e-9)
