"""An exact solution with an edge of contact inside: the true error is in the summary, too."""
import math

from judge import near, require


def judge(run):
    summary = run.summary
    strain = sum(summary["energy"]["strain"].values())
    true = math.sqrt(sum(summary["errors"][body]["energy"] ** 2 for body in ("upper", "lower")))
    estimate = summary["estimate"]
    require(0.7 <= estimate["energy_norm"] / true <= 1.4, f"estimated {estimate['energy_norm']}, true {true}")
    near("relative error", estimate["energy_norm_relative"], estimate["energy_norm"] / math.sqrt(2 * strain), relative=1e-6)
    near("force", summary["pairs"]["joint"]["normal_force"], 2e6 / 3, absolute=summary["bars"]["pairs"]["joint"]["normal_force"])
    near("largest pressure", summary["pairs"]["joint"]["max_pressure"], 1e6, absolute=summary["bars"]["pairs"]["joint"]["max_pressure"])
    near("end of contact", summary["pairs"]["joint"]["extent"]["upper"][0], 0, absolute=summary["bars"]["pairs"]["joint"]["extent"]["upper"][0])
    require(summary["bars"]["pairs"]["joint"]["extent"]["upper"][0] <= 1.9 / 128 * 1.001, "the end of contact is not known to one facet")
