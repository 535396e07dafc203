"""Load steps have the number of their matrices, which multigrid does not assemble; so has one solution by a factorization."""
from flatness import number
from judge import near
import pairing


def judge(run):
    expected = pairing.number("dual", 8, 6, lumped=True)
    near("load steps", number(run, "joint"), expected, relative=1e-9)
    near("factored", number(run.again("-pc_type", "cholesky"), "joint"), expected, relative=1e-9)
