"""A pair with friction does not change how another pair, without it, is judged: at the end of the partner, 0.7. With the weight of the block
at 0.72, over its last node with a multiplier, the block tips. The sentence names the body that nothing holds, and no friction where there is none."""
from judge import Run, require, same

BEYOND = ["-block_dm_plex_box_lower", "0.22,0", "-block_dm_plex_box_upper", "1.22,1"]
CASES = {
    "tips": (BEYOND, "body block tips about (0.7, 0)", "nothing resists"),
    "slides": (["-brick_body_force", "0.31,-1"], "body brick slides along (1, 0)", "friction is too small to resist"),
}


def judge(run):
    for name, (more, *words) in CASES.items():
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + more)
        same(f"exit code of {name}", other.exit, 2)
        for word in words:
            require(word in other.stderr, f"{name}: {other.stderr}")
