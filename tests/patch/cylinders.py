"""Cylinder on cylinder: u_r and u_z linear, pressure 3 on a disc of area pi, the whole ring's force; a rigid motion costs nothing."""
import math

from judge import near, require

PRESSURE = 3


def uniform(run, body_tolerance=1e-12):
    pair = run.pair("joint")
    near("force", pair["force"], [0, math.pi * PRESSURE], absolute=1e-11)
    near("normal force", pair["normal_force"], math.pi * PRESSURE, relative=1e-12)
    near("area", pair["area"], math.pi, relative=1e-12)
    table = run.table("joint")
    near("pressure, on the axis as well", table["pressure"], [PRESSURE] * len(table["pressure"]), relative=1e-11)
    near("error of the displacement", run.summary["errors_total"]["l2_relative"], 0, absolute=body_tolerance)
    with run.fields() as file:
        stress = file["stress"][()]  # 3 x 3, row by row
    near("sigma along the axis", stress[:, 4], [-PRESSURE] * len(stress), relative=1e-11)
    for place in (0, 1, 8):
        near("other stresses", stress[:, place], [0.0] * len(stress), absolute=1e-11 * PRESSURE)
    strain_energy = [math.pi * PRESSURE**2 / 2 / young for young in (1000, 2000)]
    near("energies", [run.summary["energy"]["strain"][body] for body in ("upper", "lower")], strain_energy, relative=1e-12)
    near("reaction", run.summary["reactions"]["lower:bottom"], [0, math.pi * PRESSURE], absolute=1e-11)


def judge(run):
    uniform(run)
    uniform(run.again("-order", "2", name="order2"))
    for orders in run.some([["-order", "1"], ["-order", "2"], ["-upper_order", "2"], ["-lower_order", "2"]]):
        uniform(run.again(*orders, "-upper_dm_plex_simplex", "1", "-lower_dm_plex_simplex", "1", "-lower_dm_plex_box_faces", "7,3", name="triangles"))
    swapped = ["-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom"]
    near("swapped", run.again("-order", "2", *swapped, name="swapped").summary["errors_total"]["l2_relative"], 0, absolute=1e-12)
    uniform(run.again("-order", "2", "-joint_multipliers", "vertices", name="vertices"))
    uniform(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"), body_tolerance=1e-9)
    skewed = ["-upper_map", "x, y+0.2*(y-1)*(2-y)*sin(3*x)", "-lower_map", "x, y+0.2*y*(1-y)*x"]
    uniform(run.again("-order", "2", *skewed, name="skewed"))
    lifted = run.again("-upper_bc_displacement", "right", "-upper_bc_displacement_right", "free,0.5", "-upper_bc_traction_top", "0,0",
                       "-upper_exact_displacement", "0,0.5", "-lower_exact_displacement", "0,0", name="lifted")
    require(lifted.pair("joint")["active_nodes"] == 0, "a lifted body is in contact")
    near("a rigid motion", lifted.summary["errors_total"]["l2_relative"], 0, absolute=1e-12)
    near("its energy", lifted.summary["energy"]["strain"]["upper"], 0, absolute=1e-12 * 1000)  # roundoff of K u, u
