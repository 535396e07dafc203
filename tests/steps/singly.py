"""Every load step equals a run at its time alone, which begins from nothing; the table tells what the summary tells."""
from judge import NAME, near, read_table, require, same

EXACT = 1e-9  # of the largest value of a kind: what a solution is known to is less


def judge(run):
    steps = run.summary["steps"]
    judge_table(run, steps)
    judge_top(run, steps[-1])
    for step in steps:
        same("status", (step["status"], step["certificate"]), ("solved", True))
    for place, step in enumerate(steps):
        alone = run.again("-load_steps", f"{step['t']:.17f}", name=f"alone{place}")
        judge_same(step, alone.summary["steps"][0])


def judge_same(step, alone):
    near("time", step["t"], alone["t"])
    near("potential", step["energy"]["potential"], alone["energy"]["potential"], relative=EXACT)
    largest = max(abs(x) for force in [*alone["reactions"].values(), *(pair["force"] for pair in alone["pairs"].values()), [1e-300]] for x in force)
    for name, pair in alone["pairs"].items():
        mine = step["pairs"][name]
        near(f"force of {name}", mine["force"], pair["force"], absolute=EXACT * largest)
        near(f"pressure of {name}", mine["max_pressure"], pair["max_pressure"], relative=EXACT)
        near(f"area of {name}", mine["area"], pair["area"], relative=EXACT)
        same(f"active nodes of {name}", mine["active_nodes"], pair["active_nodes"])
    for name, force in alone["reactions"].items():
        near(f"reaction at {name}", step["reactions"][name], force, absolute=EXACT * largest)
    for name, probe in alone["probes"].items():
        near(f"displacement of {name}", step["probes"][name]["displacement"], probe["displacement"], relative=EXACT)


def judge_top(run, last):
    """The top level of the summary is the last step."""
    for key in ("pairs", "reactions", "probes", "energy", "status"):
        same(key, run.summary[key], last[key])
    same("iterations", run.summary["solver"]["iterations"], last["iterations"])


def judge_table(run, steps):
    table = read_table(run.folder / f"{NAME}_steps.csv")
    same("t", table["t"], [step["t"] for step in steps])
    same("status", table["status"], [step["status"] for step in steps])
    for name in steps[0]["pairs"]:
        for key in ("normal_force", "area", "max_pressure"):
            same(f"{name}.{key}", table[f"{name}.{key}"], [step["pairs"][name][key] for step in steps])
        same(f"{name}.force_y", table[f"{name}.force_y"], [step["pairs"][name]["force"][1] for step in steps])
    for name in steps[0]["probes"]:
        same(f"{name} x", table[f"{name}.displacement_x"], [step["probes"][name]["displacement"][0] for step in steps])
    for name in steps[0]["reactions"]:
        same(f"{name} y", table[f"{name}.reaction_y"], [step["reactions"][name][1] for step in steps])
    require("potential" in table, "the table has no energy")
