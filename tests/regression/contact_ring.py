"""The claims of options/CONTACT_ZONE.md on rings: a thin round rim has the pressure of a line contact. A flat ring with a hole of half its radius
carries 98.1 % of what the disc carries. That is by an independent collocation of the half space (closedforms.py)."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "options" / "studies"))
from closedforms import line, ring_punch  # pylint: disable=wrong-import-position
from judge import near

MODULUS = 70000 / 0.91


def judge(run):
    rim = run.pair("dent")
    near("rim: largest pressure", rim["max_pressure"], line(rim["normal_force"] / 2 / math.pi, 1000, MODULUS)[1], relative=0.01)
    disc, ring = (run.again("-dent_obstacle_gap", gap, name=name).pair("dent")["normal_force"]
                  for name, gap in (("disc", "x<1 ? 0-0.0001-y : 0.01"), ("ring", "x<1 ? (x>0.5 ? 0-0.0001-y : 0.01) : 0.01")))
    near("collocation: a disc", ring_punch(0, 1, 60), 1, relative=1e-4)
    near("flat disc: force over depth", disc / 0.0001, 2 * MODULUS, relative=0.015)
    near("flat ring over flat disc", ring / disc, ring_punch(0.5, 1, 60), relative=5e-3)
