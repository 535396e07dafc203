"""Press fit of two spherical shells, in space and around an axis: Lame's pressure and displacements lie within their bars."""
from judge import near, require

PRESSURE = 0.450005184  # interference 0.001
MOVED = {"bore": -1.92859365e-4, "rim": 3.79359209e-4}


def judge(run):
    pair, bars = run.pair("fit"), run.summary["bars"]["pairs"]["fit"]
    near("mean pressure", pair["mean_pressure"], PRESSURE, absolute=bars["mean_pressure"])
    require(bars["mean_pressure"] < 0.1 * PRESSURE, f"the bar {bars['mean_pressure']} says nothing")
    for name, moved in MOVED.items():
        probe, bar = run.summary["probes"][name], run.summary["bars"]["probes"][name]["displacement"]
        for k, place in enumerate(probe["at"]):
            known = moved if place else 0
            near(f"{name}: displacement {k}", probe["displacement"][k], known, absolute=bar[k])
            require(bar[k] < 0.1 * abs(moved), f"{name}: the bar {bar[k]} says nothing")
