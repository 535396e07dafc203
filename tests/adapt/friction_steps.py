"""Load steps with friction on adaptive meshes: all steps on the same mesh, each as good as asked for. Bars hold the numbers of finer meshes.
Friction's tractions are like those of a mesh graded by hand. All ranks have the same numbers. Limits end it with exit code 3."""
import h5py

from judge import near, read_table, require, same

NUMBERS = ("normal_force", "tangential_force", "area", "max_pressure", "max_slip", "dissipation")


def as_list(value):
    return value if isinstance(value, list) else [value]


def judge(run):
    steps = run.summary["steps"]
    tolerance = float(run.arguments[run.arguments.index("-adapt") + 1])
    finer = run.again("-adapt", str(tolerance / 4), name="finer").summary["steps"]
    graded = run.again(*graded_by_hand(run), name="graded").summary["steps"]
    held = []
    for step, fine, hand in zip(steps, finer, graded):
        require(step["status"] == "solved" and step["certificate"], f"t = {step['t']} is not solved")
        require(step["estimate"]["energy_norm_relative"] <= tolerance and len(step["estimate"]["meshes"]) >= 3, f"{step['estimate']} is not what was asked for")
        pair, bars = step["pairs"]["joint"], step["bars"]["pairs"]["joint"]
        for name in NUMBERS:
            for value, bar, true in zip(as_list(pair[name]), as_list(bars[name]), as_list(fine["pairs"]["joint"][name])):
                held.append((abs(value - true) <= bar, step["t"], name, value, bar, true))
        bar = as_list(bars["tangential_force"])[0]
        near(f"tangential force at t = {step['t']}", as_list(pair["tangential_force"])[0], as_list(hand["pairs"]["joint"]["tangential_force"])[0], absolute=2 * bar)
        require(step["energy"]["balance"]["work"] is not None, "no balance of energy")
    require(all(one[0] for one in held), f"bars that do not hold: {[one[1:] for one in held if not one[0]]}")
    require(len({step["estimate"]["meshes"][-1]["cells"] for step in steps}) == 1, "steps have meshes of their own")
    judge_files(run, len(steps))
    judge_limit(run, steps)
    if run.ranks > 1:
        alone = run.again(ranks=1, name="alone").summary["steps"]
        same("meshes", [step["estimate"]["meshes"][-1]["unknowns"] for step in alone], [step["estimate"]["meshes"][-1]["unknowns"] for step in steps])
        for step, one in zip(steps, alone):
            near("the same on one rank", step["pairs"]["joint"]["tangential_force"], one["pairs"]["joint"]["tangential_force"], relative=1e-7, absolute=1e-9)


def graded_by_hand(run):
    return ["-adapt", "0.5", "-adapt_max_meshes", "1", "-upper_dm_plex_box_faces", "64,20", "-lower_dm_plex_box_faces", "64,20"]


def judge_files(run, num):
    table = read_table(run.folder / "result_steps.csv")
    same("rows", list(table["status"]), ["solved"] * num)
    require(table["bar.joint.normal_force"][0] > 0 and table["error"][0] > 0, "the table has no bars")
    with h5py.File(run.folder / "result.h5", "r") as file:
        same("steps in the file", len(file["steps"]), num)
    same("steps in the series", (run.folder / "result.xdmf").read_text().count("<Time "), num)


def judge_limit(run, steps):
    """The meshes before the last one, whose error was larger."""
    meshes = steps[0]["estimate"]["meshes"]
    other = type(run)(run.program, run.mpiexec, run.ranks, run.folder / "limit", run.arguments + ["-adapt_max_meshes", str(len(meshes) - 1)])
    same("exit", other.exit, 3)
    require("-adapt_max_meshes" in other.stderr and "at t = " in other.stderr, other.stderr)
    same("steps", len(other.summary["steps"]), len(steps))
    require("not_converged" in [step["status"] for step in other.summary["steps"]], "all steps are called solved")
    same("rows", list(read_table(other.folder / "result_steps.csv")["status"]), [step["status"] for step in other.summary["steps"]])
    for step in other.summary["steps"]:
        require(step["bars"]["pairs"]["joint"]["normal_force"] > 0, "no bars")
