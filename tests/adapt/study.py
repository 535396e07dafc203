"""A study on adaptive meshes: those of -adapt, and far better than uniform ones with as many unknowns."""
from judge import near, read_table, require, same

POTENTIAL = -5918.26337  # independent high-order reference


def judge(run):
    table = read_table(run.folder / "result_study.csv")
    same("kind", run.summary["study"]["kind"], "adaptive")
    same("meshes", len(table["unknowns"]), 12)
    near("potential with 6156 unknowns", table["potential"][-1], POTENTIAL, relative=6e-5)  # uniform: 8e-4 with 16900
    require(all(a > b for a, b in zip(table["energy_error_to_finest"], table["energy_error_to_finest"][1:-1])), "errors do not fall")
    adapted = run.again("-study_levels", "8", name="shorter")
    same("unknowns", read_table(adapted.folder / "result_study.csv")["unknowns"], table["unknowns"][:8])
