from judge import near, require


def judge(run):
    table = run.table("joint")
    require(not any(status for x, status in zip(table["x"], table["status"]) if x <= 0.25), "a node of the first set is in contact")
    mirrored = run.again("-upper_bc_displacement_top", "0, 0.01*(x-0.5)", "-joint_gap", "max(0, 0.002*(0.75-x))", name="mirrored").table("joint")
    by_place = sorted(zip(mirrored["x"], mirrored["pressure"]), reverse=True)
    near("mirrored pressures", [p for _, p in sorted(zip(table["x"], table["pressure"]))], [p for _, p in by_place], relative=1e-10)
