"""Bent boxes of cells that are long and thin: Hertz' largest pressure at the force found lies within the bars (Johnson, Contact mechanics)."""
from judge import near, require


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    if run.summary["scene"]["model"] == "axisymmetric":
        text = f"normal force {pair['normal_force']:.6g} +- {bars['normal_force']:.2g}, mean pressure"
        require(text in run.stdout, f"the terminal does not say '{text}'")
        hertz, slope = 1111.33 * (pair["normal_force"] / 206.513) ** (1 / 3), 1 / 3
    else:
        hertz, slope = 1392.53 * (pair["normal_force"] / 519.75) ** 0.5, 1 / 2
    near("largest pressure", pair["max_pressure"], hertz, absolute=bars["max_pressure"] + slope * hertz * bars["normal_force"] / pair["normal_force"])
    require(bars["max_pressure"] < 0.01 * hertz, f"the bar {bars['max_pressure']} says nothing")
