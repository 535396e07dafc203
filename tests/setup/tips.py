"""A tall brick that friction holds where it stands is said to tip; slide, where friction is too small. Forces and moments are by hand. The
brick of weight 4 tips about its edge, half its width from its middle, from a push of 4 0.5 / 4 = 0.5 at its top. It slides from a push of 4
mu."""
from judge import Run, require, same

# Push, coefficient: words, work of the loads on the motion.
CASES = {
    (0.6, 0.3): ("body block tips about (1, 0), turning clockwise: the loads do +0.4 of work on it per radian and nothing resists"),
    (1.5, 0.6): ("body block tips about (1, 0), turning clockwise: the loads do +4 of work on it per radian and nothing resists"),
    (0.6, 0.1): ("body block slides along (1, 0): the loads do +0.6 of work on it per unit of length and friction is too small to resist"),
    (2.5, 0.6): ("body block slides along (1, 0): the loads do +2.5 of work on it per unit of length and friction is too small to resist"),
}


def judge(run):
    for (push, friction), words in run.some(CASES.items()):
        options = ["-block_bc_force_top", f"{push},0", "-floor_friction", f"{friction}"]
        case = Run(run.program, run.mpiexec, run.ranks, run.folder / f"push{push}_{friction}", run.arguments + options)
        case.require_clean()
        same("exit code", case.exit, 2)
        require(words in case.stderr, case.stderr)
