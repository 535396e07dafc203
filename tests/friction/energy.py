"""The GRECO block under loads that grow. Every step is like the first, so that n steps of length 1/n have defects of 1/n^2 each. What friction takes
is (1 + 1/n) times what it takes in infinitely many. The work is that of whole steps."""
from judge import near, read_table


def judge(run):
    limit = None
    for num in (1, 2, 4):
        steps = run.again("-load_steps", str(num), name=f"steps{num}").summary["steps"]
        parts = [step["energy"]["balance"] for step in steps]
        total = {key: sum(part[key] for part in parts) for key in parts[0]}
        near("stored", total["stored"], sum(steps[-1]["energy"]["strain"].values()), relative=1e-12)
        near("dissipation", [part["dissipation"] for part in parts], [step["pairs"]["floor"]["dissipation"] for step in steps], relative=1e-12)
        near("work of constant and growing loads", (total["stored"] - steps[-1]["energy"]["potential"]) / 2, total["work"], relative=1e-9)
        limit = limit or total["work"] - total["stored"]
        near("dissipation of n steps", total["dissipation"], limit * (1 + 1 / num), relative=1e-8)
        near("defects", [part["defect"] for part in parts], [-limit / num**2] * num, relative=1e-8)
    table = read_table(run.folder / "steps4" / "result_steps.csv")
    near("columns", table["balance.defect"], [part["defect"] for part in parts], relative=1e-15)
