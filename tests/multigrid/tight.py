"""Nearly incompressible bodies: patches of nodes, and prolongation that keeps the volume. Iterations do not grow with the mesh, nor depend on
the number of ranks."""
from judge import LONG, require

MOST = {0.49: 15, 0.4999: 20}  # of the last active set; patches with nothing but what mortar nodes move take 28, and 35 on the finer mesh
RANKS = (1, 2, 4, 8) if LONG else (1, 3)


def iterations(run):
    return run.summary["solver"]["linear_reference"]["iterations"]


def judge(run):
    for poisson, most in MOST.items():
        ratios = [f"-{body}_poisson={poisson}".split("=") for body in ("upper", "lower")]
        arguments = [word for pair in ratios for word in pair] + ["-measure_linear", "1"]
        counts = []
        for ranks in RANKS:
            counts.append(iterations(run.again(*arguments, ranks=ranks, name=f"poisson{poisson}_ranks{ranks}")))
        counts.append(iterations(run.again(*arguments, "-dm_refine", "2", name=f"poisson{poisson}_finer")))
        require(max(counts) <= most, f"{counts} iterations at {poisson}")
        require(max(counts[:-1]) - min(counts[:-1]) <= 1, f"{counts} iterations on {RANKS} ranks at {poisson}")
