"""Patches in space: nodes in contact of the table are grouped anew on the grid that the mesh is there."""
import math

from judge import near, require, same

STEP = 4 / 48


def patches_of(table):
    """Groups of rows in contact whose nodes share a facet of the grid."""
    rows = {(round(table["x"][row] / STEP), round(table["y"][row] / STEP)): row for row, status in enumerate(table["status"]) if status == 1}
    groups = []
    while rows:
        start = next(iter(rows))
        group, front = [rows.pop(start)], [start]
        while front:
            i, j = front.pop()
            for near_by in [(i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]:
                if near_by in rows:
                    group.append(rows.pop(near_by))
                    front.append(near_by)
        groups.append(group)
    return sorted(groups, key=lambda group: -sum(table["force"][row] for row in group))


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    patches, groups = pair["patches"], patches_of(table)
    same("patches", [len(patches), len(groups)], [2, 2])
    near("the one that is pressed more comes first", [patch["centre"][0] for patch in patches], [1, -1], absolute=0.02)
    turned = [math.cos(math.pi / 6), 0.5, 0], [-0.5, math.cos(math.pi / 6), 0]
    for patch, group in zip(patches, groups):
        force = [table["force"][row] for row in group]
        same("nodes", patch["nodes"], len(group))
        near("normal force", patch["normal_force"], sum(force), relative=1e-12)
        near("area", patch["area"], sum(f / table["pressure"][row] for f, row in zip(force, group)), relative=1e-9)
        for axis, expected in zip(patch["axes"], turned):
            near("principal axis, its largest component positive", axis, expected, absolute=0.05)
        near("axes across each other", sum(a * b for a, b in zip(*patch["axes"])), 0, absolute=1e-12)
        for axis, length in zip(patch["axes"], patch["extent"]):
            along = [sum(a * table[x][row] for a, x in zip(axis, "xyz")) for row in group]
            # each node stands for half of the facets around it: at most half of the diagonal of one beyond the last one
            require(0 <= length - (max(along) - min(along)) <= math.sqrt(2) * STEP, f"extent {length} for nodes over {max(along) - min(along)}")
        require(1.4 < patch["extent"][0] / patch["extent"][1] < 2.2, f"the ellipse is {patch['extent']} wide")
        across = STEP * sum(abs(a) for a in patch["axes"][1][:2])  # of a square facet
        near("facets across", patch["facets"], patch["extent"][1] / across, relative=0.02)
    near("sum of the forces; the solver iterates to 1e-8, and open nodes pull by what is left", sum(patch["normal_force"] for patch in patches), pair["normal_force"], relative=1e-8)
    for k, l in ((0, 1), (1, 0)):  # moments about the y and the x axis
        sign = -1 if k == 0 else 1
        moment = sum(patch["moment"][l] + sign * patch["centre"][k] * patch["force"][2] - sign * patch["centre"][2] * patch["force"][k] for patch in patches)
        near("moment about the origin", moment, sign * pair["centre_of_pressure"][k] * pair["force"][2], relative=1e-6, absolute=1e-6 * pair["normal_force"])
