"""Press fit of two spherical shells in space."""
from judge import near, require

PRESSURE = 0.450005184  # interference 0.001


def judge(run):
    pair, bars = run.pair("fit"), run.summary["bars"]["pairs"]["fit"]
    near("mean pressure", pair["mean_pressure"], PRESSURE, absolute=bars["mean_pressure"])
    require(bars["mean_pressure"] < 0.1 * PRESSURE, f"the bar {bars['mean_pressure']} says nothing")
