"""Press fit of two rings: Lame's pressure, on circles that bisection keeps."""
from judge import near, require

PRESSURE, BORE = 0.192374956, -1.6031246356535e-4  # interference 0.001
LARGEST = 1.5e-4  # of the bar of a displacement: 2e-4 of it while curved cells of order 2 had twice the floor


def judge(run):
    pair, bars = run.pair("fit"), run.summary["bars"]["pairs"]["fit"]
    near("mean pressure", pair["mean_pressure"], PRESSURE, absolute=bars["mean_pressure"])
    near("largest pressure", pair["max_pressure"], PRESSURE, absolute=bars["max_pressure"])
    require(bars["mean_pressure"] < 0.01 * PRESSURE, f"the bar {bars['mean_pressure']} says nothing")
    bar = run.summary["bars"]["probes"]["bore"]["displacement"][0]
    near("the bore", run.summary["probes"]["bore"]["displacement"][0], BORE, absolute=bar)
    if "kept" in run.arguments:
        require(bar < LARGEST * abs(BORE), f"the bar {bar} of the bore is too large")
