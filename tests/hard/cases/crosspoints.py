from judge import near, same


def judge(run):
    table = run.table("joint")
    rows = sorted(zip(table["x"], table["pressure"], table["status"]))
    same("status of the ends", [rows[0][2], rows[-1][2]], [-1, -1])
    near("mirrored pressures", [p for _, p, _ in rows], [p for _, p, _ in reversed(rows)], relative=1e-10)
    supports = sum(reaction[1] for side, reaction in run.summary["reactions"].items() if side.startswith("upper"))
    near("supports of the upper block", supports, -run.pair("joint")["normal_force"], relative=1e-10)
