#!/usr/bin/env python3
"""package.py -- the Python package: what it makes of scenes and files, runs and their exceptions, sweeps, and its installation.

    package.py <test> --program <mortise> --prefix <installed> --version <x.y.z> --scratch <folder>

options/patch2d.opts is the patch test: uniform pressure 1e6 on a side of length 1, so that every field is known without the program."""
import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import warnings

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "src/python"), str(TOP / "tests")]

import numpy as np  # noqa: E402

import mortise  # noqa: E402
from judge import Failure, near, require, same  # noqa: E402

PATCH, OVERHANG, TWO_PLATES = (TOP / f"options/{name}.opts" for name in ("patch2d", "overhang", "two_plates"))
PRESSURE = 1e6  # of patch2d, see its head
SHIFT = PRESSURE * ((1 - 0.3**2) / 1e9 + (1 - 0.25**2) / 2e9)  # of its top
TIGHT = 1e-8


def refused(kind, function, *arguments, **options):
    """The exception of this kind that a call raises."""
    try:
        function(*arguments, **options)
    except kind as error:
        require(type(error) is kind, f"{type(error).__name__} instead of {kind.__name__}")
        return error
    raise Failure(f"no {kind.__name__}")


# --- without the program ----------------------------------------------------------------------------------------------


def test_scene():
    scene = {"-title": "Two blocks", "order": 2, "monitor": False, "stop": None,
             "bodies": {"a": {"young": 2e5, "dm_plex_box_faces": (4, 3), "bc_traction": {"top": (0, -1.5), "left side": "y, 0"}},
                        "b": {"bc_normal": "left,top", "regions": {"steel": {"young": np.float64(0.1)}}}},
             "pairs": {"joint": {"nonmortar": "a:bottom", "obstacle": {"normal": np.array([0, 1])}}}, "probes": {"tip": {"at": [0.1, 1]}}}
    same("arguments", " ".join(mortise.arguments_of(scene)), " ".join((
        "-title Two blocks -order 2 -monitor 0 -bodies a,b -a_young 200000.0 -a_dm_plex_box_faces 4,3 -a_bc_traction top,left side",
        "-a_bc_traction_top 0,-1.5 -a_bc_traction_left_side y, 0 -b_bc_normal left,top -b_regions steel -b_steel_young 0.1",
        "-pairs joint -joint_nonmortar a:bottom -joint_obstacle_normal 0,1 -probes tip -probe_tip_at 0.1,1")))
    same("digits", mortise.arguments_of({"x": 0.1 + 0.2})[1], "0.30000000000000004")
    require("0-sin(x)" in str(refused(ValueError, mortise.arguments_of, {"a_map": "-sin(x), y"})), "the mistake has no advice")


def test_summary(folder):
    (folder / "one.json").write_text('{"pairs": {"a": {"force": [1.5, null]}}, "reactions": {"a:top": [3]}, "warnings": []}')
    summary = mortise.load(folder / "one.h5").summary
    same("by attributes", summary.pairs.a.force, [1.5, None])
    same("by path", (summary.value("pairs.a.force.0"), summary.value("reactions.a:top.0")), (1.5, 3))
    require("there is a" in str(refused(KeyError, summary.value, "pairs.b.force")), "the pairs are not listed")
    require("2 items" in str(refused(KeyError, summary.value, "pairs.a.force.2")), "the items are not counted")
    require("single value" in str(refused(KeyError, summary.value, "pairs.a.force.0.x")), "a number has parts")
    require("there are pairs" in str(refused(AttributeError, getattr, summary, "pair")), "the keys are not listed")
    require("no_such.json" in str(refused(mortise.ResultError, mortise.load, folder / "no_such")), "the file is not named")


def test_tables(folder):
    (folder / "one_a.csv").write_text("# a comment\nx,y,pressure,gap,status\n0,1,2.5,nan,1\n")
    table = mortise.Results(str(folder / "one")).table("a")
    same("row", (table["x"].dtype.kind, table["status"].dtype.kind, table[0]["pressure"], len(table)), ("f", "i", 2.5, 1))
    rows = mortise.Rows([{"n": 1, "force": 0.1 + 0.2, "status": "solved, it says"}, {"n": 2, "force": None, "status": "failed"}])
    rows.write(folder / "rows.csv")
    again = mortise.read_table(folder / "rows.csv")
    same("written and read", (again["force"][0], again["status"].tolist()), (0.1 + 0.2, ["solved, it says", "failed"]))
    require(np.isnan(again["force"][1]) and np.isnan(rows.column("force")[1]), "None is a number")
    (folder / "empty_a.csv").write_text("x,y,pressure,gap,status\n")
    same("rows of none", len(mortise.Results(str(folder / "empty")).table("a")), 0)
    (folder / "torn_a.csv").write_text("x,y,pressure,gap,status\n0,1\n")
    refused(mortise.ResultError, mortise.Results(str(folder / "torn")).table, "a")
    same("grid", mortise.grid(order=(1, 2), level=(0, 1))[1:3], [{"order": 1, "level": 1}, {"order": 2, "level": 0}])
    same("grid with a text", mortise.grid(model="plane_stress", order=(1, 2))[1], {"model": "plane_stress", "order": 2})


def test_plain(arguments):
    test_scene()
    test_summary(arguments.scratch)
    test_tables(arguments.scratch)
    cells = mortise.results.read_cells(np.array([4, 0, 1, 2, 4, 2, 1, 3, 5, 3, 4, 5, 6]))  # two triangles and a quadrilateral
    same("blocks", [block.tolist() for block in cells], [[[0, 1, 2], [2, 1, 3]], [[3, 4, 5, 6]]])


# --- with it ----------------------------------------------------------------------------------------------------------


def judge_patch(run):
    """Every number of the patch test that is known in advance."""
    require(run.solved and run.exit_code == 0 and not run.warnings and run.sentence == "", f"not solved: {run.stderr}")
    near("force", run.summary.pairs.joint.force, [0, PRESSURE], absolute=TIGHT * PRESSURE)
    table, fields = run.table("joint"), run.fields()
    near("pressure", table["pressure"], [PRESSURE] * len(table), relative=TIGHT)
    same("bodies", sorted((name, *body.cells) for name, body in fields.items()), [("lower", "quad"), ("upper", "triangle")])
    for body in fields.values():
        stress = np.zeros((len(body.points), 3, 3))
        stress[:, 1, 1] = -PRESSURE
        near(f"stress of {body.name}", body.stress[:, :2, :2].ravel(), stress[:, :2, :2].ravel(), absolute=TIGHT * PRESSURE)
        same(f"cells of {body.name}", np.unique(np.concatenate([block.ravel() for block in body.cells.values()])).tolist(), list(range(len(body.points))))
    upper = fields["upper"]
    near("corners", [*upper.points.min(axis=0), *upper.points.max(axis=0)], [0, 0, 0, 1, 1, 0])
    top, bottom = upper.points[:, 1] == 1, upper.points[:, 1] == 0
    near("shift of the top", upper.displacement[top, 1], [-SHIFT] * top.sum(), relative=TIGHT)
    near("pressure at the nodes", upper.pressure[bottom], [PRESSURE] * bottom.sum(), relative=TIGHT)
    require(bottom.sum() == len(table) and (upper.status[bottom] == 1).all() and (upper.status[~bottom] == -1).all(), "status")
    surface = run.surface("joint")
    near("normals", surface["normal"].ravel(), [0, -1, 0] * len(surface["points"]), absolute=1e-14)


def judge_without_h5py(run):
    """A sentence, and no trace of an import."""
    known, sys.modules["h5py"] = sys.modules.get("h5py"), None
    try:
        require("pip install h5py" in str(refused(mortise.ResultError, run.fields)), "the sentence")
    finally:
        sys.modules["h5py"] = known


def test_runs(arguments):
    prefix = arguments.scratch / "folder/patch"
    judge_patch(mortise.run(PATCH, output=prefix))
    judge_without_h5py(mortise.load(prefix))
    judge_patch(mortise.run(PATCH, output=prefix, ranks=2))
    same("read later", mortise.load(prefix).summary.mortise.ranks, 2)
    options = mortise.load(prefix).summary.options
    scene = {name: value for name, value in options.items() if name not in ("options_file", "output", "quiet")}
    judge_patch(mortise.run({**scene, "output": prefix}))
    half = mortise.run(PATCH, {"upper_bc_displacement_top": ("free", -SHIFT / 2)})
    near("half the shift", half.summary.pairs.joint.normal_force, PRESSURE / 2, relative=TIGHT)
    require("no files" in str(refused(mortise.ResultError, half.table, "joint")), "a table without a file")
    steps = mortise.run(PATCH, {"load_steps": (0.5, 1)}, output=prefix).steps()
    near("force of load steps", steps["joint.normal_force"], PRESSURE * steps["t"], relative=TIGHT)
    same("load steps", (steps["t"].tolist(), steps["status"].tolist()), ([0.5, 1], ["solved"] * 2))
    line = mortise.run(PATCH, {"paths": {"line": {"from": (0.5, 0.25), "to": (0.5, 2.25), "points": 5, "body": "upper"}}}, output=prefix).paths()
    near("stress along a path", line["yy"][:2], [-PRESSURE] * 2, relative=TIGHT)
    require(line["path"][0] == "line" and np.isnan(line["yy"][2:]).all(), f"the path {line}")
    (arguments.scratch / "own.opts").write_text(f"{PATCH.read_text()}\n-output {prefix}_own\n")
    judge_patch(mortise.run(arguments.scratch / "own.opts"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        large = mortise.run(PATCH, {"upper_young": 1e5, "lower_young": 1e5, "upper_bc_displacement_top": "free,-0.5"})
    same("warnings", [(str(w.message).split(":")[0].split(" ")[0], w.category) for w in caught], [("model_limit", mortise.MortiseWarning)])
    same("place of the warning", caught[0].filename, __file__)
    same("warnings of the run", [w.code for w in large.warnings], ["model_limit"])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        meant = mortise.run(PATCH, {"upper_young": 1e5, "lower_young": 1e5, "upper_bc_displacement_top": "free,-0.5", "warnings_accept": "model_limit"})
    same("accepted warnings", (len(caught), [w.accepted for w in meant.warnings]), (0, [True]))


def test_failures(arguments):
    wrong = refused(mortise.SceneError, mortise.run, PATCH, {"upper_yuong": 1}, output=arguments.scratch / "wrong")
    same("a wrong scene", (wrong.exit_code, wrong.sentence), (1, "-upper_yuong 1: there is no such option; did you mean -upper_young?"))
    loads = {"block_bc_traction": "left", "block_bc_traction_left": (0.1, 0)}
    none = refused(mortise.NoSolutionError, mortise.run, OVERHANG, loads, output=arguments.scratch / "none")
    same("no solution", (none.exit_code, none.run.summary.status), (2, "no_solution"))
    require("slides along (1, 0)" in none.sentence, none.sentence)
    motion = none.run.fields()["block"].motion
    near("motion", motion.ravel(), (motion[:1, :1] * [1, 0, 0] * np.ones((len(motion), 1))).ravel(), absolute=1e-12)
    require(motion[0, 0] > 0 and none.run.fields()["table"].displacement is None, "the motion")
    again = mortise.run(OVERHANG, {**loads, "block_yuong": 1}, output=arguments.scratch / "none", check=False)
    same("summary of a wrong scene beside that of an earlier run", (again.exit_code, again.summary), (1, None))
    stuck = refused(mortise.NotConvergedError, mortise.run, PATCH, {"ksp_type": "cg", "pc_type": "jacobi", "ksp_max_it": 1})
    same("not to tolerance", (stuck.exit_code, stuck.run.summary.status), (3, "not_converged"))
    require("certificate fails" in stuck.sentence, stuck.sentence)
    begin = time.monotonic()
    slow = refused(mortise.RunTimeoutError, mortise.run, TWO_PLATES, {"dm_refine": 4}, output=arguments.scratch / "slow", ranks=2, timeout=1)
    require("1 seconds" in slow.sentence and time.monotonic() - begin < 60, slow.sentence)
    same("files of what was ended", sorted(path.name for path in arguments.scratch.glob("slow*")), [])
    require("ranks=0" in str(refused(ValueError, mortise.run, PATCH, ranks=0)), "no ranks")
    require("cannot be started" in refused(mortise.ProgramError, mortise.run, PATCH, program=str(arguments.scratch / "no_such")).sentence, "no program")
    (arguments.scratch / "broken").write_text("#!/bin/sh\necho PETSC ERROR: out of memory >&2\nexit 4\n")
    (arguments.scratch / "broken").chmod(0o755)
    broken = refused(mortise.ProgramError, mortise.run, PATCH, program=str(arguments.scratch / "broken"))
    same("a program that fails", (broken.exit_code, broken.sentence), (4, "PETSC ERROR: out of memory"))
    os.environ["MORTISE"] = str(arguments.scratch / "no_such")
    require("no_such" in refused(mortise.ProgramError, mortise.find_program).sentence, "no program")


def test_interrupt(arguments):
    """Ctrl-C ends the runs of a sweep that are under way, and no other begins."""
    program, script, begun = (arguments.scratch / name for name in ("program", "script.py", "begun"))
    program.write_text(f"#!/bin/sh\necho $$ >> {begun}\nexec sleep 1000\n")
    program.chmod(0o755)
    script.write_text(f"import mortise\nmortise.sweep({{}}, [{{'order': 1}}] * 9, {{}}, workers=2, program={str(program)!r})\n")
    # jobs in the background of a shell ignore Ctrl-C, and so would their children
    with subprocess.Popen([sys.executable, "-B", script], env={**os.environ, "PYTHONPATH": str(TOP / "src/python")}, stderr=subprocess.PIPE, text=True,
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)) as loop:
        while not begun.exists() or begun.read_text().count("\n") < 2:
            require(loop.poll() is None, "the loop has ended by itself")
            time.sleep(0.05)
        loop.send_signal(signal.SIGINT)
        require("KeyboardInterrupt" in loop.communicate(timeout=60)[1] and loop.returncode != 0, "the loop was not interrupted")
    pids = list(map(int, begun.read_text().split()))
    same("runs that began", len(pids), 2)
    for pid in pids:
        refused(ProcessLookupError, os.kill, pid, 0)


def test_sweep(arguments):
    shifts = [0.25, 0.5, 1, 2]
    points = [{"upper_bc_displacement_top": ("free", -share * SHIFT), "upper": {"young": 1e9}} for share in shifts] + [
        {"upper_bc_displacement_top": "free,0", "upper": {"young": -1}}]
    columns = {"force": "pairs.joint.normal_force", "y": "pairs.joint.force.1", "largest": lambda run: run.table("joint")["pressure"].max()}
    rows = mortise.sweep(PATCH, points, columns, output=arguments.scratch / "patch", workers=2)
    for name in ("force", "y", "largest"):
        near(name, rows.column(name)[:4], [share * PRESSURE for share in shifts], relative=TIGHT)
    same("options of the rows", (rows[2]["upper_bc_displacement_top"], rows[4]["upper_young"]), (f"free,{-SHIFT!r}", "-1"))
    same("status", [row["status"] for row in rows], ["solved"] * 4 + ["wrong"])
    same("the wrong one", [(row["exit_code"], row["force"], row["message"]) for row in rows.failed],
         [(1, None, "-upper_young -1: Young's modulus must be above 0")])
    same("files", sorted(path.name for path in arguments.scratch.glob("*.json")), [f"patch_{i}.json" for i in range(1, 5)])
    slow = mortise.sweep(TWO_PLATES, [{"dm_refine": 4}], {}, timeout=1)
    same("a run that is too slow", (slow[0]["status"], slow[0]["exit_code"], slow[0]["message"]), ("failed", None, "the run was ended after its timeout of 1 seconds"))
    begin = time.monotonic()
    error = refused(KeyError, mortise.sweep, PATCH, [{"order": 1}, *[{"order": 2, }] * 3], {"force": "pairs.joint.normal"}, workers=1)
    require("normal_force" in str(error) and time.monotonic() - begin < 60, f"keys are not listed: {error}")
    require("two meanings" in str(refused(ValueError, mortise.sweep, PATCH, [{"order": 1}], {"order": "status"})), "a column twice")
    refused(ValueError, mortise.sweep, PATCH, [{"order": 1}, {}], {})


# --- installed --------------------------------------------------------------------------------------------------------

SCRIPT = """import mortise
print(mortise.__version__, mortise.__file__, mortise.find_program())
print(mortise.run({scene!r}, output={output!r}).summary.pairs.joint.normal_force)
"""


def judge_script(arguments, python, program, environment):
    """A script that imports the package from its installation alone. Returns the package's file."""
    script = arguments.scratch / "script.py"
    script.write_text(SCRIPT.format(scene=str(PATCH), output=str(arguments.scratch / "result")))
    done = subprocess.run([python, "-B", script], env=environment, cwd=arguments.scratch, capture_output=True, text=True, check=False)
    require(done.returncode == 0, done.stderr)
    (version, file, found), (force,) = (line.split(" ") for line in done.stdout.splitlines())
    same("version", version, arguments.version)
    same("program", pathlib.Path(found).resolve(), pathlib.Path(program).resolve())
    near("force", float(force), PRESSURE, relative=TIGHT)
    return file


def test_installed(arguments):
    """The prefix has a package whose program is that of the prefix, and companions that use that package."""
    environment = {name: value for name, value in os.environ.items() if name not in ("MORTISE", "PYTHONPATH")}
    package = arguments.prefix / "share/mortise/python"
    file = judge_script(arguments, sys.executable, arguments.prefix / "bin/mortise", {**environment, "PYTHONPATH": str(package)})
    require(file.startswith(str(package)), f"the package is {file}")
    for companion, ending in (("mortise-plot", ".png"), ("mortise-report", ".html")):
        call = [arguments.prefix / "bin" / companion, arguments.scratch / "result"]
        done = subprocess.run(call, env=environment, capture_output=True, text=True, check=False)
        same(f"what {companion} says", (done.returncode, done.stderr), (0, ""))
        require((arguments.scratch / f"result{ending}").stat().st_size > 0, f"no {ending}")
    alone = arguments.scratch / "bin"
    alone.mkdir()
    for companion in ("mortise-plot", "mortise-report"):
        shutil.copy(arguments.prefix / "bin" / companion, alone)
        done = subprocess.run([alone / companion, "result"], env=environment, capture_output=True, text=True, check=False)
        require(done.returncode == 1 and "mortise is missing (pip install" in done.stderr and done.stderr.count("\n") == 1, f"{companion}: {done.stderr}")
    left = [path.name for path in arguments.prefix.rglob("__pycache__")]
    same("compiled files in the prefix", left, [])


def test_pip(arguments):
    """pip installs the package from the tree, without a network."""
    source, virtual = arguments.scratch / "python", arguments.scratch / "venv"
    shutil.copytree(TOP / "src/python", source, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", virtual], check=True, capture_output=True)
    call = [virtual / "bin/python", "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", "--disable-pip-version-check", source]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    require(done.returncode == 0, done.stderr)
    environment = {name: value for name, value in os.environ.items() if name not in ("MORTISE", "PYTHONPATH")}
    environment["PATH"] = f"{pathlib.Path(arguments.program).parent}{os.pathsep}{os.environ['PATH']}"
    file = judge_script(arguments, virtual / "bin/python", arguments.program, environment)
    require(file.startswith(str(virtual)), f"the package is {file}")
    require((pathlib.Path(file).parent / "py.typed").is_file(), "the package has no types")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what")
    for name in ("program", "version"):
        parser.add_argument(f"--{name}")
    for name in ("prefix", "scratch"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    arguments = parser.parse_args()
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    arguments.scratch.mkdir(parents=True)
    try:
        globals()[f"test_{arguments.what}"](arguments)
    except Failure as failure:
        sys.exit(str(failure))


if __name__ == "__main__":
    main()
