"""A chamfer of the nonmortar side: its corner touches the table along the table's normal. Statics is exact, and small displacements have no limit there."""
from judge import near, same

SOLID = ["-block_dm_plex_box_faces", "15,2,10", "-block_dm_plex_box_lower", "-1,0,0", "-block_dm_plex_box_upper", "1,1,1",
         "-table_dm_plex_box_faces", "20,3,6", "-table_dm_plex_box_lower", "-1.0001,0,-1", "-table_dm_plex_box_upper", "1.0001,1,0",
         "-block_bc_normal", "left,front,back", "-table_bc_normal", "front,back", "-table_bc_displacement_bottom", "0,0,0"]


def check(name, run):
    force = run.pair("joint")["force"]
    near(f"force, {name}", force[-1], 2, relative=1e-8)
    near(f"normal force, {name}", run.pair("joint")["normal_force"], 2, relative=1e-8)
    near(f"force along the table, {name}", max(abs(f) for f in force[:-1]), 0, absolute=1e-8)
    same(f"warnings, {name}", [w["code"] for w in run.summary["warnings"]], [])


def judge(run):
    for slope in ("1", "1.5"):  # exactly 45 degrees, and more
        for order in ("1", "2"):
            check(f"{slope}, order {order}", run.again("-block_map", f"x, x>7/15 ? y+{slope}*(x-7/15)*(1-y) : y", "-order", order, name=f"plane{slope}_{order}"))
        solid = run.again("-block_map", f"x, y, x>7/15 ? z+{slope}*(x-7/15)*(1-z) : z", *SOLID, name=f"solid{slope}")
        check(f"{slope}, in space", solid)
