"""13.W on graded cells: full order, where equal cells have 1.5 at the most (the displacement goes like r^1.5)."""
import math

from judge import near, require

RATES = {"1": 0.97, "2": 1.85}


def judge(run):
    for order, least in RATES.items():
        runs = [run.again("-order", order, "-dm_refine", str(level), name=f"order{order}_{level}") for level in (0, 1)]
        errors = [one.summary["errors_total"]["energy_relative"] for one in runs]
        rate = math.log2(errors[0] / errors[1])
        require(rate >= least, f"order {order}: the energy norm of the error falls with h^{rate:.2f}, less than {least}")
        near(f"force of order {order}", runs[1].pair("joint")["normal_force"], 2e6 / 3, relative=1e-3)
