"""Hertz' line contact at every step (Johnson, Contact mechanics, chapter 4): half width, largest pressure, and the approach, of which a
constant depends on the bodies: d / F = c - ln(F) / (pi E*)."""
import math

import numpy as np

from judge import NAME, near, read_table, require, same

MODULUS = 1 / ((1 - 0.3**2) / 210000 + (1 - 0.33**2) / 70000)
RADIUS, DEPTH, ELEMENT = 10, 0.05, 0.035


def judge(run):
    table = read_table(run.folder / f"{NAME}_steps.csv")
    same("steps", len(table["t"]), 20)
    force, width = np.array(table["joint.normal_force"]), np.array(table["joint.area"]) / 2
    peak, approach = np.array(table["joint.max_pressure"]), DEPTH * np.array(table["t"])
    near("half width", width, np.sqrt(4 * force * RADIUS / (math.pi * MODULUS)), absolute=ELEMENT)
    for p, f in zip(peak, force):
        near("largest pressure", p, math.sqrt(f * MODULUS / (math.pi * RADIUS)), relative=0.01)
    slope = np.polyfit(np.log(force), approach / force, 1)[0]
    near("slope of d/F over ln F", slope, -1 / (math.pi * MODULUS), relative=0.01)
    near("reaction", table["disc:top.reaction_y"], -force, relative=1e-9)
    require(all(n <= 4 for n in table["iterations"][1:]), f"later steps take {table['iterations']} iterations")
