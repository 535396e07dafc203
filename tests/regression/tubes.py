"""X5: Lame's thick rings in plane strain. Pressure, force of the whole ring, energies, and the orders of convergence."""
import math

from judge import near, require

FIT, FORCE = 0.192374956278419, 2.417454997515755  # 2 pi R p
ENERGIES = [0.0010149534156528198, 0.00019377408310505798]  # of outer and inner ring


def judge(run):
    for order, tolerance in (("1", 2e-3), ("2", 1e-5)):
        coarse = run.again("-order", order, name=f"coarse{order}")
        fine = run.again("-order", order, "-dm_refine", "1", name=f"fine{order}")
        near("pressure", coarse.pair("fit")["max_pressure"], FIT, relative=tolerance)
        near("force", coarse.pair("fit")["normal_force"], FORCE, relative=tolerance)
        near("area", coarse.pair("fit")["area"], 2 * math.pi * 2, relative=1e-12)
        energy = coarse.summary["energy"]["strain"]
        near("energies", [energy["outer"], energy["inner"]], ENERGIES, relative=2 * tolerance)
        for norm, least in (("energy", int(order) - 0.1), ("l2", int(order) + 0.9)):
            rate = math.log2(coarse.summary["errors_total"][norm] / fine.summary["errors_total"][norm])
            require(rate > least, f"the error in {norm} of order {order} falls with h^{rate:.2f} only")
