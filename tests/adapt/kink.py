"""A block under a flat obstacle with steep flanks, whose edges lie between nodes: the limit of the potential on each of six meshes. Pressures at the
last nodes in contact extend over facets that open beyond the edge. Times these gaps, they were a part of L as large as the potential, and its limit
was missed by up to 34 bars. What is left are coarse meshes whose potential rises and falls with the place of the last node: up to 1.7 bars."""
from judge import Run, require, same

# gap, numbers of meshes, number of the truth
CASES = ("-0.0002+0.6*max(0,abs(x-0.1)-1)", range(7, 13), 16), ("-0.0005+0.3*max(0,abs(x-0.13)-0.37)", range(6, 12), 14)
BARS = 2


def judge(run):
    for case, (gap, coarse, fine) in enumerate(CASES):
        limits = {}
        for number in (*coarse, fine):
            words = ["-joint_obstacle_gap", gap, "-adapt", "1e-7", "-adapt_max_meshes", str(number)]
            solved = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{case}_{number}", run.arguments + words)
            same("exit", solved.exit, 3)  # by the limit
            limits[number] = solved.summary["estimate"]["potential"]
        truth = limits.pop(fine)
        for number, limit in limits.items():
            require(truth["bar"] < limit["bar"] / 10, f"{gap}: the truth has a bar of {truth['bar']}")
            require(abs(limit["value"] - truth["value"]) < BARS * limit["bar"], f"{gap}, mesh {number}: {limit['value']} +- {limit['bar']} is {truth['value']}")
