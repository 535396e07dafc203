"""R3: two half discs, against the independent reference with the gap along the line of centres, which is the direction of contact (eq. 4.3)."""
from judge import near, require

FORCE = {0.004: 0.098345, 0.01: 0.277113, 0.02: 0.614093}
PEAK = {0.004: 1.834, 0.01: 3.080, 0.02: 4.588}


def judge(run):
    for depth, force in FORCE.items():
        again = run.again("-upper_bc_displacement_upper_top", f"0,{-depth}", name=f"depth{depth}")
        near(f"force at {depth}", again.pair("joint")["normal_force"], force, relative=1e-2)
        near(f"peak pressure at {depth}", again.pair("joint")["max_pressure"], PEAK[depth], relative=2e-2)
    swapped = run.again("-joint_nonmortar", "lower:lower_arc", "-joint_mortar", "upper:upper_arc", name="swapped")
    near("force with roles swapped", swapped.pair("joint")["normal_force"], run.pair("joint")["normal_force"], relative=1e-3)
    near("peak pressure with roles swapped", swapped.pair("joint")["max_pressure"], run.pair("joint")["max_pressure"], relative=1e-3)
    # facets of the file are straight; refinement puts new nodes on the curves (peaks of polygons: 3.26)
    refined = run.again("-dm_refine", "1", name="refined")
    near("peak pressure, refined", refined.pair("joint")["max_pressure"], PEAK[0.01], relative=5e-3)
    # order 2 on the polygons of the file: middles of edges do not touch first, so vertices alone carry the pressure
    quadratic = run.again("-order", "2", "-joint_multipliers", "vertices", "-upper_polygonal", "-lower_polygonal", "-scene_view", name="quadratic")
    near("force with order 2", quadratic.pair("joint")["normal_force"], FORCE[0.01], relative=1e-3)
    near("peak pressure with order 2", quadratic.pair("joint")["max_pressure"], PEAK[0.01], relative=5e-3)
    for body in ("upper", "lower"):
        require(f"curved edges of {body}: its mesh file has none" in quadratic.stdout, f"the view does not say that {body} is a polygon")
