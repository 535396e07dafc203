"""Loads that nothing balances: exit code 2, one sentence, the motion and the work of the loads on it, and no field of a solution.

The first and the last of the block are cases of the independent reference: r = (0, 1), F(r) = 0.5; r = (1, 0), F(r) = 0.1."""
from judge import Run, near, require, same

UPPER = {"translation": [0, 0], "rotation": 0, "centre": None, "work": None}
CASES = {  # options, words, motions of bodies, work of the loads
    "lifted": (["-upper_bc_traction_top", "0,1.5"], "body upper lifts off along (0, 1)", {"upper": ([0, 1], 0, [0.5, 0.5])}, 0.5),
    "lifted_at_a_corner": (["-upper_bc_traction_top", "0,3*x"], "body upper lifts off along (0, 1)", {"upper": ([0, 1], 0, [0.5, 0.5])}, 0.5),
    "tipped": (["-lower_dm_plex_box_upper", "0.375,0", "-upper_bc_traction_top", "0,0"], "body upper tips about (0.375, 0), turning clockwise",
               {"upper": ([0, 0], -1, [0.375, 0])}, 0.125),
    "turned": (["-upper_bc_traction_top", "0,30*x-15"], "body upper tips about (0, 0), turning anticlockwise", {"upper": ([0, 0], 1, [0, 0])}, 2.0),
    "without_contact": (["-joint_nonmortar", "upper:right", "-joint_mortar", "lower:right", "-joint_reach", "0.01", "-joint_allow_empty"],
                        "body upper, which no contact touches, moves along (0, -1)", {"upper": ([0, -1], 0, [0.5, 0.5])}, 3.0),
    "both": (["-lower_bc_displacement_bottom", "0,free"], "body upper moves along (0, -1); lower moves along (0, -1)",
             {"upper": ([0, -1], 0, [0.5, 0.5]), "lower": ([0, -1], 0, [0.5, -0.5])}, 3.0),
    "pushed": (["-lower_dm_plex_box_upper", "0.7,0", "-upper_bc_traction", "left", "-upper_bc_traction_left", "0.1,0"],
               "body upper slides along (1, 0)", {"upper": ([1, 0], 0, [0.5, 0.5])}, 0.1),
}

ON_RANKS = ["tipped", "without_contact", "both"]  # of these, where ranks can matter: edges, bodies alone, bodies together


def judge_case(run, name, options, words, motions, work):
    if name == "pushed":  # no load on top
        options = options + ["-options_allow_unused"]
    case = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + options)
    lines = [line for line in case.stderr.splitlines() if line.startswith("mortise")]
    same(f"exit code of {name}", case.exit, 2)
    same(f"status of {name}", case.summary["status"], "no_solution")
    refusals = [line for line in lines if line.startswith("mortise: no solution: ")]
    require(len(refusals) == 1 and words in refusals[0] and "nothing resists" in refusals[0], f"{name}: {case.stderr!r}")
    case.require_clean()
    solvability = case.summary["solvability"]
    same(f"verdict of {name}", solvability["verdict"], "no_solution")
    same(f"bodies of {name}", sorted(solvability["motion"]), sorted(motions))
    for body, (translation, rotation, centre) in motions.items():
        found = solvability["motion"][body]
        near(f"translation of {body}, {name}", found["translation"], translation, absolute=1e-9)
        near(f"rotation of {body}, {name}", found["rotation"], rotation, absolute=1e-9)
        near(f"centre of {body}, {name}", found["centre"], centre, absolute=1e-9)
    near(f"work, {name}", solvability["work"], work, relative=1e-9)
    near(f"work of bodies, {name}", sum(body["work"] for body in solvability["motion"].values()), work, relative=1e-9)
    require(case.summary["energy"]["potential"] is None and case.pair("joint")["normal_force"] is None, "figures of no solution")
    same(f"files of {name}", sorted(path.name for path in case.folder.iterdir() if path.is_file()), ["result.h5", "result.json", "result.xdmf"])


def judge(run):
    for name in CASES if run.ranks == 1 else ON_RANKS:
        judge_case(run, name, *CASES[name])
