"""same.py with cells of order 2, whose meshes take longer: one process and three."""
import same


def judge(run):
    same.judge(run, all_ranks=(3,))
