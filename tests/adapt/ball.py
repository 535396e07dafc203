"""A rigid ball between the nodes of a solid: -adapt finds the contact, and Hertz' force and pressure lie within the bars."""
import math

from judge import near, require

MODULUS, RADIUS, DEPTH = 1000 / (1 - 0.3**2), 0.5, 0.005


def judge(run):
    pair, bars = run.pair("dent"), run.summary["bars"]["pairs"]["dent"]
    near("force", pair["normal_force"], 4 / 3 * MODULUS * math.sqrt(RADIUS) * DEPTH**1.5, absolute=bars["normal_force"])
    near("largest pressure", pair["max_pressure"], 2 * MODULUS / math.pi * math.sqrt(DEPTH / RADIUS), absolute=bars["max_pressure"])
    require(bars["normal_force"] < 0.15 * pair["normal_force"], f"the bar {bars['normal_force']} says nothing")
    require(run.summary["estimate"]["meshes"][0]["active"] <= 3, "the first mesh sees it: this asks for nothing")
