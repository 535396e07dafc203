"""Cycles of a load that end where they began: each one moves the bar by the same distance, that of statics. Files of earlier runs continue within a cycle, also one that
continued another file. Slip turns round at once when a step begins, so that the defect of the energy is halved where steps are, and not quartered."""
from judge import near, require, same

CRAWL = 0.105  # of a cycle
WEAK, MOST = 33.75 * 3e-3, 15  # crawl of 160 cells with a tenth of the weight; Newton steps of a load step, with those of all passes
FINE = (20, 14, 14)  # the same with 320 cells, in three load steps; 54, 33 and 29 while nodes near the one whose slip ended stuck with it, then 18, 12 and 18
STRAIN = 1e-6  # slip less expansion: weight over stiffness, times the length


def places(run):
    return [step["probes"]["middle"]["displacement"][0] for step in run.summary["steps"]]


def defect(run, parts):
    """Of the second cycle."""
    return sum(step["energy"]["balance"]["defect"] for step in run.summary["steps"][2 * parts:4 * parts])


def judge(run):
    moved = places(run)
    near("crawl of each cycle", [moved[2 * k + 1] - (moved[2 * k - 1] if k else 0) for k in range(3)], [CRAWL] * 3, absolute=1e-5)
    near("steady from the second cycle on", moved[5] - moved[3], moved[3] - moved[1], absolute=STRAIN)
    halves = run.again("-load_steps", "0.5,1,1.5,2,2.5,3,3.5,4", name="halves")
    near("defect of steps and of their halves", defect(run, 1) / defect(halves, 2), 2, absolute=0.01)
    weak = run.again("-bar_body_force", "1e-6,-1e-5", "-bar_dm_plex_box_faces", "160,1", "-load_steps", "1,2,3,4", name="weak")
    near("crawl under a tenth of the weight", places(weak)[3] - places(weak)[1], WEAK, absolute=1e-6)
    require(max(step["iterations"] for step in weak.summary["steps"]) <= MOST, f"{[step['iterations'] for step in weak.summary['steps']]} Newton steps")
    fine = run.again("-bar_dm_plex_box_faces", "320,1", "-load_steps", "1,2,3", name="fine")
    near("crawl with 320 cells", places(fine)[2] - places(fine)[0], 33.125 * 3e-3, absolute=1e-5)
    require(all(step["iterations"] <= most for step, most in zip(fine.summary["steps"], FINE)), f"{[step['iterations'] for step in fine.summary['steps']]} Newton steps")
    # The same list, continued twice: times of earlier files count as its begin.
    part = run.again("-load_steps", "1,2", name="part", ranks=4 - run.ranks)
    more = run.again("-restart", str(part.folder / "result.h5"), "-load_steps", "1,2,3", name="more")
    rest = run.again("-restart", str(more.folder / "result.h5"), name="rest")
    same("times that are left", [step["t"] for step in rest.summary["steps"]], [4, 5, 6])
    require("without the first 3 of -load_steps" in rest.stdout, rest.stdout)
    near("the same places", places(rest), moved[3:], absolute=1e-9)
    # Another list may go back, and end at the time where the file ends.
    other = run.again("-restart", str(part.folder / "result.h5"), "-load_steps", "1,2,3,4", name="other")
    same("times of the begin omitted", [step["t"] for step in other.summary["steps"]], [3, 4])
    cycle = run.again("-restart", str(part.folder / "result.h5"), "-load_steps", "3,2", name="cycle")
    same("times of a cycle", [step["t"] for step in cycle.summary["steps"]], [3, 2])
    require("with all of -load_steps" in cycle.stdout, cycle.stdout)
    near("a cycle", places(cycle), moved[2:4], absolute=1e-9)
