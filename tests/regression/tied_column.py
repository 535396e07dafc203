"""Beams: with a rigid piece between a and b from the tip, L^3 becomes L^3 - (b^3 - a^3)."""
from judge import near


def bends(gap):
    length, half = 20 + gap, 10
    bending = 4 * (length**3 - (half + gap) ** 3 + half**3)  # H / (3 E I) of H = 1e-3, E = 1e3, I = 1/12, in 1e-6
    return 1e-6 * (bending + 1.2 * 2 * 1.3 * 2 * half)


def judge(run):
    tip = run.probe("tip")["displacement"][0]
    near("deflection without a gap", tip, bends(0), relative=2e-3)
    for gap in (1, 0.5, 1e-3, 1e-5):  # up to four facets, beyond the reach that the program would choose
        moved = ["-upper_dm_plex_box_lower", f"0,{10 + gap!r}", "-upper_dm_plex_box_upper", f"1,{20 + gap!r}", "-probe_tip_at", f"0.5,{20 + gap!r}"]
        other = run.again(*moved, "-joint_reach", "2", name=f"gap{gap:g}")
        gained = other.probe("tip")["displacement"][0] / tip - 1
        near(f"what a gap of {gap:g} adds to the deflection", gained, bends(gap) / bends(0) - 1, relative=1e-3)
        near("moment that the tie loses", other.pair("joint")["moment_imbalance"], 0, absolute=1e-12)
