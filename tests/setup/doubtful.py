"""Scenes that are solved but hardly meant. Units of two bodies, gaps that only move a body, an angle of
friction, a body far from its support: each is a warning."""
from judge import near, require, same

# Options; code of the warning, what it is about, words.
DOUBTFUL = {
    "modulus": ("-lid_young 2e9", "mixed_units", "pair", "the moduli of lid and table, the bodies of joint, differ by a factor of 1.0e+06"),
    "weight": ("-table_body_force 0,-1e-9", "mixed_units", "pair", "the body forces of lid and table, the bodies of joint, differ by a factor of 1.0e+09"),
    "sinks": ("-joint_gap_offset 0.1", "idle_gap", "pair", "-joint_gap_offset 0.1 strains nothing: a body is free to move by it, and its mesh then overlaps"),
    "floats": ("-joint_gap_offset -0.1", "idle_gap", "pair", "-joint_gap_offset -0.1 strains nothing: a body is free to move by it, and its mesh then floats above"),
    "gap": ("-joint_gap 0.1", "idle_gap", "pair", "-joint_gap 0.1 strains nothing"),
    "far": ("-joint_reach 10 -lid_dm_plex_box_lower -0.5,5 -lid_dm_plex_box_upper 0.5,6", "far_motion", "body", "3.54 times its own diagonal"),
}
# Near them, and meant: steel on rubber, weights of different materials, a guided lid that interference strains, a gap as wide as the lid.
MEANT = {
    "rubber": "-table_young 5e7",
    "weights": "-table_body_force 0,-8",
    "profile": "-joint_gap 1e-4*x^2",
    "pressed": "-joint_gap_offset -0.001 -lid_bc_displacement top -lid_bc_displacement_top 0,0",
    "near": "-joint_reach 10 -lid_dm_plex_box_lower -0.5,1 -lid_dm_plex_box_upper 0.5,2",
}


def judge_accepted(run):
    """-warnings_accept: no line, no exit code 3, an entry that is marked; other codes as before."""
    for name, more in run.some({"accepted": [], "strict": ["-warnings", "error"], "steps": ["-load_steps", "2", "-warnings", "error"]}.items()):
        case = run.again("-lid_young", "2e9", "-warnings_accept", "mixed_units,gap_jump", *more, name=name, warns=["mixed_units"])
        same(f"{name}: marked", [(warning["code"], warning.get("accepted")) for warning in case.summary["warnings"]], [("mixed_units", True)])
        require("[mixed_units]" not in case.stderr, f"{name}: {case.stderr}")
    other = run.again("-lid_young", "2e9", "-warnings_accept", "gap_jump", name="other", warns=["mixed_units"])
    require("accepted" not in other.summary["warnings"][0] and "[mixed_units]" in other.stderr, other.stderr)


def judge(run):
    for name, (options, code, about, words) in run.some(DOUBTFUL.items()):
        case = run.again(*options.split(), name=name, warns=[code])
        warning = case.summary["warnings"][0]
        same(f"{name}: about", warning[about], {"pair": "joint", "body": "lid"}[about])
        require(words in warning["text"], f"{name}: {warning['text']}")
        # the table gives way by 5e-4, and roundoff of that times the stiffness of a lid of 2e9 is 2e-10 for each of its couplings
        near(f"{name}: force", case.pair("joint")["force"], [0, 1], absolute=1e-8 if name == "modulus" else 1e-9)
    for name, options in run.some(MEANT.items()):
        run.again(*options.split(), name=name, warns=[])
    angle = run.again("-joint_friction", "30", name="angle", warns=["large_friction"])
    require("-joint_friction 30 is a coefficient larger than materials have" in angle.stderr, angle.stderr)
    judge_accepted(run)
    checked = run.again("-check", "-joint_gap_offset", "0.1", name="check", warns=["idle_gap"])
    same("status", checked.summary["status"], "checked")
