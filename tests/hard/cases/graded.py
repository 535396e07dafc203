"""Whatever the cells, a uniform state is in both."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-7)  # roundoff of moduli times aspects over 1e-5, the smallest weight
    # middles of edges are not in the middle after this map: no rule is exact on both meshes, and what is left falls fast as cells become smaller
    for level, accuracy in enumerate((1e-4, 1e-6)):
        judge_uniform(run.again("-order", "2", "-dm_refine", str(level), name=f"quadratic{level}"), ["joint"], accuracy=accuracy)
