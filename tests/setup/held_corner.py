"""A bar whose clamped end is a corner of its nonmortar side. That node has no multiplier, and its row goes to its neighbour. Gap, overlap and slip
there are those of the geometry all the same. Scenes have a uniform gap, a uniform overlap, and a partner that is drawn along by a given
displacement."""
from judge import near, require, same

GAP, APART = 0.1, ["-bar_dm_plex_box_lower", "0,0.1"]


def judge(run):
    for order in ("1", "2"):
        checked = run.again("-order", order, *APART, "-check", name=f"check{order}", warns=[]).summary["check"]["pairs"]["joint"]
        near("gaps before", [checked["least_gap"]["value"], checked["largest_gap"]["value"]], [GAP, GAP], relative=1e-12)
        gaps = [gap for gap in run.again("-order", order, *APART, name=f"open{order}", warns=["open_contact"]).table("joint")["gap"] if gap == gap]
        near("gaps after a slide", gaps, [GAP] * len(gaps), relative=1e-12)
        pressed = run.again("-order", order, name=f"pressed{order}", warns=[])
        same("overlap beyond that of the sides", pressed.pair("joint")["false_overlap"], 0)
        drawn = run.again("-order", order, "-joint_gap", "-1e-6", "-joint_friction", "0.01", name=f"drawn{order}", warns=["model_limit"])
        slips = [slip for slip, status in zip(drawn.table("joint")["slip_x"], drawn.table("joint")["status"]) if status == 3]
        require(len(slips) > 3, f"slips {slips}")
        near("slips, but for the strain of a small interference", slips, [-0.002] * len(slips), relative=1e-3)
        near("largest slip", drawn.pair("joint")["max_slip"], max(-slip for slip in slips), relative=1e-12)
