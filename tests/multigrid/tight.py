"""Nearly incompressible bodies: patches of nodes, and prolongation that keeps the volume. Iterations do not grow with the mesh, nor depend on
the number of ranks."""
from judge import LONG, require

MOST = {0.49: 15, 0.4999: 30}  # iterations of CG for one active set; 37 and 353 node by node
RANKS = (1, 2, 4, 8) if LONG else (1, 3)


def per_set(run):
    solver = run.summary["solver"]
    return solver["linear_iterations"] / solver["iterations"]


def judge(run):
    for poisson, most in MOST.items():
        ratios = [f"-{body}_poisson={poisson}".split("=") for body in ("upper", "lower")]
        arguments = [word for pair in ratios for word in pair]
        counts = []
        for ranks in RANKS:
            counts.append(per_set(run.again(*arguments, ranks=ranks, name=f"poisson{poisson}_ranks{ranks}")))
        counts.append(per_set(run.again(*arguments, "-dm_refine", "2", name=f"poisson{poisson}_finer")))
        require(max(counts) <= most, f"{counts} iterations a set at {poisson}")
        require(max(counts[:-1]) - min(counts[:-1]) <= 1, f"{counts} iterations a set on {RANKS} ranks at {poisson}")
