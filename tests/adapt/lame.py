"""Press fit of two rings: Lame's pressure, on circles that bisection keeps."""
from judge import near, require

PRESSURE = 0.192374956  # interference 0.001


def judge(run):
    pair, bars = run.pair("fit"), run.summary["bars"]["pairs"]["fit"]
    near("mean pressure", pair["mean_pressure"], PRESSURE, absolute=bars["mean_pressure"])
    near("largest pressure", pair["max_pressure"], PRESSURE, absolute=bars["max_pressure"])
    require(bars["mean_pressure"] < 0.01 * PRESSURE, f"the bar {bars['mean_pressure']} says nothing")
