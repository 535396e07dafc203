"""Calibrated estimate of the last mesh over the error in the energy norm against the exact displacement."""
from judge import read_table, require


def judge(run):
    effectivity = run.summary["estimate"]["meshes"][-1]["estimate"] / read_table(run.folder / "result_study.csv")["energy_error"][-1]
    require(0.8 <= effectivity <= 1.35, f"effectivity {effectivity}")
