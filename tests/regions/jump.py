"""Multigrid copes with moduli that jump a thousandfold: hardly more linear iterations than in a body of one material, the same answer
as a factorization."""
from judge import near, require

ALIKE = ["-strip_soft_young", "5", "-strip_stiff_layer_young", "5"]


def judge(run):
    alike = run.again(*ALIKE, name="alike")
    needed, without = (sum_of(r) for r in (run, alike))
    require(needed <= 2 * without + 5, f"{needed} linear iterations with the jump, {without} without")
    factored = run.again("-pc_type", "cholesky", name="factored")
    near("force", run.pair("dent")["force"], factored.pair("dent")["force"], relative=1e-6)


def sum_of(run):
    return run.summary["solver"]["linear_iterations"]
