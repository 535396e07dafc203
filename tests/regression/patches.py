"""Patches of contact: those of the summary are the runs of nodes in contact of the table, whose sums are taken anew here."""
from judge import near, require, same


def runs_of(table):
    """Lists of rows of the table that follow each other in contact."""
    runs, before = [], False
    for row, status in enumerate(table["status"]):
        inside = status == 1
        if inside:
            if not before:
                runs.append([])
            runs[-1].append(row)
        before = inside
    return runs


def check(run, order):
    pair, table = run.pair("joint"), run.table("joint")
    patches = pair["patches"]
    runs = sorted(runs_of(table), key=lambda rows: -sum(table["force"][row] for row in rows))
    same("patches", len(patches), 3)
    same("runs of nodes in contact", len(runs), 3)
    near("the middles of the waves, where the load is largest first", [patch["centre"][0] for patch in patches], [2.5, 1.5, 0.5], absolute=0.02)
    for patch, rows in zip(patches, runs):
        force, x = [table["force"][row] for row in rows], [table["x"][row] for row in rows]
        near("normal force", patch["normal_force"], sum(force), relative=1e-12)
        near("force", patch["force"], [0, sum(force)], relative=1e-12, absolute=1e-12)
        near("area", patch["area"], sum(f / table["pressure"][row] for f, row in zip(force, rows)), relative=1e-9)
        near("mean pressure", patch["mean_pressure"], patch["normal_force"] / patch["area"], relative=1e-13)
        near("largest pressure", patch["max_pressure"], max(table["pressure"][row] for row in rows), relative=1e-13)
        same("nodes", patch["nodes"], len(rows))
        step = 3 / 96 / order  # between nodes; the first and the last one stand for half of it more on either side
        near("extent", patch["extent"], [x[-1] - x[0] + step], absolute=0.5 * step if order == 2 else 1e-3 * step)
        near("axis, along a wave that is 0.04 high", patch["axes"][0], [1, 0], absolute=2e-2)
        near("facets across", patch["facets"], len(rows) / order, absolute=0.25 if order == 2 else 1e-12)
    near("sum of the forces", sum(patch["normal_force"] for patch in patches), pair["normal_force"], relative=1e-10)
    near("sum of the areas", sum(patch["area"] for patch in patches), pair["area"], relative=1e-12)
    moment = sum(patch["moment"][0] + patch["centre"][0] * patch["force"][1] - patch["centre"][1] * patch["force"][0] for patch in patches)
    near("moment of all about the origin", moment, pair["centre_of_pressure"][0] * pair["force"][1], relative=1e-9)
    require(all(f"patch {i} of 3: normal force" in run.stdout for i in (1, 2, 3)), "the terminal does not tell them")


def judge(run):
    check(run, 1)
    check(run.again("-order", "2"), 2)
    open_scene = run.again("-joint_obstacle_point", "0,-0.1", name="open")
    same("patches where nothing touches", open_scene.pair("joint")["patches"], [])
    alone = run.again("-block_bc_displacement_top", "0,-0.001", "-block_map", "x, y + 0.02*(1-y)*(1-cos(2*_pi*x/3))^2", name="ends")
    same("patches at both ends", len(alone.pair("joint")["patches"]), 2)
    near("their forces, equal by symmetry: the left one comes first", [patch["centre"][0] < 1.5 for patch in alone.pair("joint")["patches"]], [True, False])
