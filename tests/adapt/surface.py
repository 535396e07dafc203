"""Stresses at the free surfaces of two spherical shells, on three coarse meshes: Lame's lie within their bars, of which those of the radial stress, zero,
hardly fall from mesh to mesh."""
from judge import near, same

PRESSURE = 0.450005184  # interference 0.001
HOOP = {"bore": -1.5 * PRESSURE * 2**3 / (2**3 - 1), "rim": 1.5 * PRESSURE * 2**3 / (3.5**3 - 2**3)}


def judge(run):
    same("meshes", len(run.summary["estimate"]["meshes"]), 3)
    for name, hoop in HOOP.items():
        probe, bars = run.summary["probes"][name], run.summary["bars"]["probes"][name]
        known = [0 if place else hoop for place in probe["at"]] + [0, 0, 0]
        for k, stress in enumerate(probe["stress"]):
            near(f"{name}: stress {k}", stress, known[k], absolute=bars["stress"][k])
        near(f"{name}: von Mises' stress", probe["von_mises"], abs(hoop), absolute=bars["von_mises"])
