"""Three meshes, of the last of which two cells are in contact, on an area that is known to 0.62 of itself. So the mean pressure has no error that
is proportional to that of the area: it may be 2.7 times as large. Hertz' mean pressure, 2/3 of the largest, lies within the bar (force 206.513)."""
from judge import near, require, same


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    same("meshes", len(run.summary["estimate"]["meshes"]), 3)
    require(0.5 < bars["area"] / pair["area"] < 1, f"the area {pair['area']} +- {bars['area']} is not of a coarse contact")
    near("mean pressure", pair["mean_pressure"], 2 / 3 * 1111.33, absolute=bars["mean_pressure"])
