"""A column between smooth walls: its displacement is a parabola, which order 2 holds."""
from judge import near


def judge(run):
    near("floor", run.pair("floor")["normal_force"], 1, relative=1e-10)
    for wall in ("west", "east"):
        near(wall, run.pair(wall)["normal_force"], 0.3 / (2 * 0.7), relative=1e-9)
    near("lid", run.pair("lid")["normal_force"], 0, absolute=1e-12)
    near("potential", run.summary["energy"]["potential"], -(1.3 * 0.4) / (6 * 1e3 * 0.7), relative=1e-10)
