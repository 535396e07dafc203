"""The number detects unstable pairings, here by pairing.py. With one multiplier for each facet, (-1)^k on the facets is nearly
orthogonal to all displacements, and beta falls with h. With a multiplier mesh twice as fine as the displacements', some multipliers do
nothing at all. The program's pairing, and continuous multipliers on the mesh of the nonmortar side, keep theirs."""
from flatness import numbers
from judge import near, require
import pairing

LEVELS = 4


def judge(run):
    cells = [4 * 2**level for level in range(LEVELS)]
    program = numbers(run, "joint", LEVELS)
    constant, nodal, finer, dual = ([pairing.number(kind, n, n, k and k * n) for n in cells]
                                    for kind, k in (("constant", None), ("nodal", None), ("nodal", 2), ("dual", None)))
    for coarse, fine in zip(constant, constant[1:]):
        require(1.9 * fine < coarse, f"constant multipliers: {constant} do not fall with h")
    near("multipliers of a finer mesh", finer, [0.0] * LEVELS, absolute=1e-6)
    for name, betas in (("program", program), ("nodal", nodal), ("dual", dual)):
        require(max(betas) < 1.05 * min(betas), f"{name}: {betas} fall")
    for sums, integrals in zip(program, dual):  # the norm of eq. 11.9 by sums or by integrals, on segments
        require(1 <= sums / integrals <= 3**0.5, f"norms: {sums} and {integrals}")
