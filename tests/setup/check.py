"""-check: tables of a scene without a solution. Volumes, areas, loads and moments by hand; the picture is drawn, and nothing is solved."""
import math
import re
import subprocess

from judge import Run, near, require, same

PLATES = {  # two unit squares, y from 0 to 1 and from -1 to 0; tractions (3, -4) MPa on the left, (-3, -7) MPa on the right
    "upper": (1, [0, 0], [1, 1], [3e6, -4e6], 0 * -4e6 - 0.5 * 3e6),
    "lower": (1, [0, -1], [1, 0], [-3e6, -7e6], 1 * -7e6 - -0.5 * -3e6),
}


def checked(run, options, name, *codes, ranks=None):
    case = Run(run.program, run.mpiexec, ranks or run.ranks, run.folder / name, [*options, "-check"])
    same(f"{name}: exit code", case.exit, 0)
    case.require_warned(codes)
    case.require_clean()
    same(f"{name}: status", case.summary["status"], "checked")
    same(f"{name}: time of the solve", case.summary["timing"]["solve"], 0)
    require("checked, nothing was solved" in case.stdout, case.stdout)
    same(f"{name}: files", sorted(path.name for path in case.folder.iterdir()), ["result.h5", "result.json", "result.xdmf"])
    return case


def judge(run):
    scenes = run.arguments[1].rsplit("/", 1)[0]
    plates = checked(run, run.arguments, "plates")
    check = plates.summary["check"]
    for body, (volume, lower, upper, force, moment) in PLATES.items():
        found = check["bodies"][body]
        near(f"{body}: volume", found["volume"], volume, relative=1e-12)
        near(f"{body}: box", found["lower"] + found["upper"], lower + upper, absolute=1e-12)
        near(f"{body}: force", found["load"]["force"], force, relative=1e-12)
        near(f"{body}: moment", found["load"]["moment"], moment, relative=1e-12)
        same(f"{body}: pieces, rigid motions", (found["pieces"], found["rigid_motions"]), (1, 0))
        near(f"{body}: shape of squares", [found["worst_shape"]["value"], found["largest_aspect_ratio"]["value"]], [1, 1], relative=1e-9)
    same("sides", list(check["sides"]), ["upper:top", "upper:left", "upper:bottom", "lower:bottom", "lower:right", "lower:top"])
    near("normal", check["sides"]["lower:right"]["normal"], [1, 0], absolute=1e-12)
    near("middle", check["sides"]["lower:right"]["centre"], [1, -0.5], absolute=1e-12)
    same("roles", check["sides"]["upper:left"]["roles"], ["traction"])
    joint = check["pairs"]["joint"]
    same("nodes of the pair", (joint["nodes"], joint["facing"], joint["multipliers"]), (65, 65, 65))
    near("overlap", joint["initial_overlap"], 0, absolute=1e-12)
    several = checked(run, run.arguments, "several", ranks=3).summary["check"]
    for body in PLATES:  # all cells are alike: the first by coordinates is named, on any number of ranks
        for extreme in ("worst_shape", "largest_aspect_ratio"):
            places = [each["bodies"][body][extreme]["at"] for each in (check, several)]
            near(f"{body}: place of {extreme}", places[1], places[0], absolute=1e-12)
    for extreme in ("least_gap", "largest_gap"):
        for each in (check, several):
            near(f"place of {extreme}", each["pairs"]["joint"][extreme]["at"], [0, 0], absolute=1e-12)

    fields = plates.fields()
    bits, points = fields["sides"][()].ravel().astype(int), fields["points"][()]
    for number, inside in enumerate([points[:, 1] == 1, (points[:, 0] == 0) & (points[:, 1] >= 0)]):
        marked = points[(bits >> number) & 1 == 1]
        same(f"nodes of side {number}", len(marked), 65)
        require(inside[(bits >> number) & 1 == 1].all(), f"nodes of side {number} lie elsewhere")
    if run.ranks == 1:
        done = subprocess.run([f"{run.program.rsplit('/', 1)[0]}/mortise-plot", "result"], cwd=plates.folder, capture_output=True, text=True, check=False)
        same("mortise-plot", (done.returncode, done.stderr, (plates.folder / "result.png").is_file()), (0, "", True))

    rings = checked(run, ["-options_file", f"{scenes}/thermal_fit.opts"], "rings").stdout  # cos(pi/2) is no zero
    require(not re.search(r"e-1[4-9]", rings), f"rounding is printed:\n{rings}")
    overlap = checked(run, [*run.arguments, "-joint_gap_offset", "0-0.001"], "overlap").summary["check"]["pairs"]["joint"]
    near("overlap of a press fit", overlap["initial_overlap"], 0.001, relative=1e-9)
    stack = checked(run, ["-options_file", f"{scenes}/stack.opts"], "stack").summary
    same("motions of a stack", [body["rigid_motions"] for body in stack["check"]["bodies"].values()], [0, 3, 3, 3, 3, 3])
    near("weight", stack["check"]["bodies"]["fifth"]["load"]["force"], [0, -0.64], relative=1e-12, absolute=1e-12)
    same("verdict", stack["solvability"]["verdict"], "free_motion")
    pushed = checked(run, ["-options_file", f"{scenes}/stack.opts", "-fifth_bc_traction", "left", "-fifth_bc_traction_left", "0.01,0"], "pushed",
                     "unbalanced_loads").summary
    require("body fifth slides along (1, 0)" in pushed["warnings"][0]["text"], pushed["warnings"])
    ball = checked(run, ["-options_file", f"{scenes}/hertz3d.opts"], "ball").summary["check"]
    near("block", ball["bodies"]["block"]["volume"], 27, relative=1e-12)
    near("top of the block", [ball["sides"]["block:top"]["area"], *ball["sides"]["block:top"]["normal"]], [9, 0, 0, 1], absolute=1e-9)
    ring = checked(run, ["-options_file", str(run.arguments[1]).replace("options/two_plates.opts", "tests/setup/ring.opts")], "ring").summary["check"]
    near("ring", [ring["bodies"]["block"]["volume"], ring["bodies"]["block"]["load"]["force"][1], ring["sides"]["block:bottom"]["area"]],
         [8 * math.pi, -8 * math.pi, 8 * math.pi], relative=1e-12)
    study = checked(run, [*run.arguments, "-study", "uniform", "-study_levels", "3"], "study")
    same("cells of a study", study.summary["check"]["bodies"]["upper"]["cells"], 4096)
