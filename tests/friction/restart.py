"""A run with load steps continues from the file of an earlier one, on another number of ranks: the same numbers as without a break."""
from judge import near, require, same, same_table

SAME = 1e-9  # of the largest of each quantity


def judge(run):
    steps = run.summary["steps"]
    times = [step["t"] for step in steps]
    middle = len(times) // 2
    part = run.again("-load_steps", ",".join(map(str, times[:middle])), name="part", ranks=4 - run.ranks)
    rest = run.again("-restart", str(part.folder / "result.h5"), name="rest")
    found = rest.summary["steps"]
    same("times after the break", [step["t"] for step in found], times[middle:])
    require(f"goes on from t = {times[middle - 1]:.9g}" in rest.stdout, "the time of the break is not told")
    require(f"result.h5, without the first {middle} of -load_steps" in rest.stdout, "the steps that are omitted are not told")
    require(found[0]["energy"].get("balance", {}).get("work") is None, "the first step after a break knows its begin")
    for quantity in ("normal_force", "max_slip", "dissipation", "slip_share"):
        for pair in steps[0]["pairs"]:
            near(quantity, [step["pairs"][pair][quantity] for step in found], [step["pairs"][pair][quantity] for step in steps[middle:]], relative=SAME)
    last = [step["energy"].get("balance") for step in (found[-1], steps[-1])]
    for key in last[1] or []:
        near(f"balance.{key}", last[0][key], last[1][key], absolute=SAME * abs(last[1]["work"]))
    for pair in steps[0]["pairs"]:
        table = run.table(pair)
        columns = [name for name in table if name.startswith(("pressure", "tangential", "slip", "gap"))]
        same_table(rest.table(pair), table, {name: (SAME, 1e-12 if name == "gap" else 0) for name in columns})
    with rest.fields() as file:
        same("steps in the file", len(file["steps"]), len(times) - middle)
        require(all(step.attrs["solved"] == 1 for step in file["steps"].values()), "a step is not marked as solved")
