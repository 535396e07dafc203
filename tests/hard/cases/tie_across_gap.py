"""Moments about the origin: of the load (1, -5) in the middle of the upper block's top, of the floor's and of the stop's force."""
from judge import near

TRIANGLES = ["-order", "2", "-a_dm_plex_simplex", "1", "-b_dm_plex_simplex", "1"]
ROLES = ["-t_nonmortar", "b:top", "-t_mortar", "a:bottom"]
CURVED = ["-a_map", "x, y+0.1*(1.2-y)*sin(3*x)", "-b_map", "x, y+0.07*(y+1)*cos(2*x)"]  # top and bottom, where forces are told, stay straight
SCENES = {
    "quadratic": ["-order", "2"],
    "triangles": TRIANGLES,
    "vertices": TRIANGLES + ["-t_multipliers", "vertices"],
    "mixed": ["-b_order", "2"],
    "roles": ROLES,
    "roles_quadratic": ROLES + ["-order", "2"],
    "overlap": ["-a_dm_plex_box_lower", "0,-0.1", "-a_dm_plex_box_upper", "1,0.9"],
    "curved": CURVED,
    "curved_quadratic": CURVED + ["-order", "2"],
    "curved_roles": CURVED + ROLES,
    "refined": ["-dm_refine", "2", "-pc_type", "truncatedmg", "-t_reach", "0.4"],
}


def judge_statics(run, height=1.2):
    moment = 0
    for name in ("floor", "stop"):
        pair = run.pair(name)
        moment += pair["centre_of_pressure"][0] * pair["force"][1] - pair["centre_of_pressure"][1] * pair["force"][0]
    near("moment of what holds the blocks", moment, 0.5 * 5 + height, relative=1e-9)
    near("forces of the pairs", [*run.pair("floor")["force"], *run.pair("stop")["force"]], [0, 5, -1, 0], absolute=1e-9)
    near("what the tie leaves", run.pair("t")["moment_imbalance"], 0, absolute=1e-12)


def judge(run):
    judge_statics(run)
    for name, options in run.some(SCENES.items()):
        judge_statics(run.again(*options, name=name), height=0.9 if name == "overlap" else 1.2)
