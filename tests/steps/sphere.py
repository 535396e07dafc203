"""Hertz' sphere: F = 4/3 E* R^(1/2) d^(3/2) at every step. Points of the bodies are near, the contact is a thirtieth of the sphere: 1 %."""
import numpy as np

from judge import NAME, near, read_table

MODULUS = 1 / ((1 - 0.3**2) / 210000 + (1 - 0.33**2) / 70000)
RADIUS, DEPTH = 10, 0.0088


def judge(run):
    table = read_table(run.folder / f"{NAME}_steps.csv")
    force, approach = np.array(table["joint.normal_force"]), DEPTH * np.array(table["t"])
    for d, f in zip(approach, force):
        near("approach", d, (9 * f**2 / (16 * MODULUS**2 * RADIUS)) ** (1 / 3), relative=0.01)
    near("exponent", np.polyfit(np.log(approach), np.log(force), 1)[0], 1.5, relative=0.01)
