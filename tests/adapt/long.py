"""More adaptive meshes than times that every cell could be refined."""
from judge import read_table, same


def judge(run):
    same("states", read_table(run.folder / "result_study.csv")["status"], ["solved"] * 14)
