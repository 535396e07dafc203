"""Whatever the cells, a uniform state is in both."""
from uniform import judge_uniform


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-7)  # roundoff of moduli times aspects over 1e-5, the smallest weight
    # middles of edges are not in the middle after this map: no rule is exact on both meshes, and what is left falls fast as cells become smaller
    for level, accuracy in enumerate((1e-4, 1e-6)):
        judge_uniform(run.again("-order", "2", "-dm_refine", str(level), name=f"quadratic{level}"), ["joint"], accuracy=accuracy)
