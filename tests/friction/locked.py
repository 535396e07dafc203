"""A wedge that friction keeps in its groove without a load: by statics its flank takes no vertical force, and nobody says that nothing moves."""
from judge import near, require


def judge(run):
    pair = run.pair("flank")
    require(pair["normal_force"] > 1000, f"nothing presses: {pair['normal_force']}")
    near("vertical force", pair["force"][1], 0, absolute=1e-9 * pair["normal_force"])
    friction = sum(component**2 for component in pair["tangential_force"])**0.5
    near("friction over pressure", friction / pair["normal_force"], 0.2, relative=1e-9)
