"""What scaling.py runs: scenes and their sizes, and one run of the program with what it cost."""
import collections
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
OPTIONS = os.path.join(HERE, "..", "..", "options")
LIMIT = 900  # seconds that a run may take
SOLVER = ["-pc_type", "truncatedmg"]

Size = collections.namedtuple("Size", "name options unknowns")  # unknowns: about
Scene = collections.namedtuple("Scene", "words file sizes slope_from dim levels", defaults=[True])  # levels: whether the mesh has some


def boxes(upper, lower, refine):
    """Cells of the coarse boxes, and how often they are refined."""
    def text(cells):
        return ",".join(str(c) for c in cells)
    return ["-upper_dm_plex_box_faces", text(upper), "-lower_dm_plex_box_faces", text(lower), "-dm_refine", str(refine)]


def brick(upper, lower, refine, dim):
    """Two boxes with so many cells along every edge of the coarsest mesh."""
    n, m = upper * 2**refine, lower * 2**refine
    return Size(f"{n}:{m}", boxes((upper,) * dim, (lower,) * dim, refine), dim * ((n + 1) ** dim + (m + 1) ** dim))


def grains(upper, lower):
    """Tetrahedra in two boxes with odd numbers of cells along every edge, which leave no coarser mesh, as those of a file do."""
    return brick(upper, lower, 0, 3)._replace(options=boxes((upper,) * 3, (lower,) * 3, 0) + ["-upper_dm_plex_simplex", "1", "-lower_dm_plex_simplex", "1"])


def refined(counts, more=()):
    """A scene as it is, refined so many times: unknowns about counts."""
    return [Size(f"refined {r}", ["-dm_refine", str(r), *more], count) for r, count in counts.items()]


def option(file):
    return os.path.join(OPTIONS, file)


SCENES = {
    "plates": Scene("two plates, 9 : 7", option("two_plates.opts"), [brick(9, 7, r, 2) for r in (3, 4, 5, 6)], 6e4, 2),
    "squares": Scene("two plates, 1 : 1", option("two_plates.opts"), [brick(8, 8, r, 2) for r in (5, 6)], 6e4, 2),
    "blocks": Scene("two blocks, curved gap", os.path.join(HERE, "blocks.opts"),
                    [brick(5, 4, 1, 3), brick(5, 4, 2, 3), brick(5, 4, 3, 3), brick(15, 12, 2, 3)], 4e4, 3),
    "tets": Scene("two blocks of tetrahedra, one mesh", os.path.join(HERE, "blocks.opts"), [grains(17, 13), grains(25, 19), grains(35, 27)], 2e4, 3, False),
    "rail": Scene("wheel on rail, Gmsh, order 1", option("wheel_on_rail.opts"), refined({1: 1.2e4}, ["-order", "1"]), 1e4, 3),
    "hertz2d": Scene("hertz2d", option("hertz2d.opts"), refined({1: 5e4, 2: 2e5, 3: 8e5}), 4e4, 2),
    "hertz3d": Scene("hertz3d, order 1", option("hertz3d.opts"), refined({1: 3.2e4, 2: 2.3e5}, ["-order", "1"]), 3e4, 3),
}

# What one rank is compared with two on, and the sizes at which numbers of iterations are compared.
SPEED = [("plates", "576:448"), ("blocks", "40:32")]
EQUAL = [("plates", "72:56"), ("blocks", "20:16"), ("tets", "17:13"), ("hertz3d", "refined 1")]
# Where the second solver is asked, too.
CROSS = [("plates", "288:224"), ("plates", "576:448"), ("squares", "512:512"), ("blocks", "20:16"), ("blocks", "40:32"), ("blocks", "60:48"),
         ("tets", "17:13"), ("hertz2d", "refined 3"), ("hertz3d", "refined 1")]
# Tetrahedra as a mesh generator makes them: order and size of cells of ball.geo, unknowns (about), and whether factorizing is bearable.
BALL = [(1, 0.53, 2e4, True), (1, 0.34, 6e4, True), (1, 0.22, 2e5, False), (2, 0.7, 7e4, True)]
# A smooth exact solution, for error against cost.
EXACT = (option("manufactured_full.opts"), boxes((4, 4), (6, 6), 0))


def mesh_ball(folder, order, size):
    """Has Gmsh mesh ball.geo; returns the scene and the options that name the files, or None where there is no Gmsh."""
    gmsh, options = shutil.which("gmsh"), ["-order", str(order)]
    if not gmsh:
        return None
    for number, body in enumerate(("ball", "block"), 1):
        file = os.path.join(folder, f"{body}.msh")
        subprocess.run([gmsh, "-3", "-v", "1", "-order", str(order), "-format", "msh41", "-setnumber", "body", str(number), "-setnumber", "size", str(size),
                        os.path.join(HERE, "ball.geo"), "-o", file], check=True, stdout=subprocess.DEVNULL)
        options += [f"-{body}_dm_plex_filename", file]
    return os.path.join(HERE, "ball.opts"), options


def size_of(scene, name):
    return next(size for size in SCENES[scene].sizes if size.name == name)


def unknowns(summary):
    return sum(body["dofs"] for body in summary["scene"]["bodies"].values())


def knows(program, name):
    """Whether the program has an option."""
    return name in subprocess.run([program, "-help"], capture_output=True, text=True, check=False).stdout.split()


def run_once(program, file, options, ranks=1):
    """Runs the program once, with one thread for each process and no output files; returns (CPU seconds, MB, summary) or None."""
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        launcher = ["mpiexec", "-n", str(ranks)] if ranks > 1 else []
        command = launcher + [program, "-options_file", file, "-quiet", "-summary", summary] + options
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
        alarm = threading.Timer(LIMIT, process.terminate)
        alarm.start()
        _, status, usage = os.wait4(process.pid, 0)
        alarm.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            print(f"{' '.join(command)} ended with status {process.returncode}", file=sys.stderr)
            return None
        with open(summary, encoding="utf-8") as text:
            found = json.load(text)
        megabytes = usage.ru_maxrss / 1024 if ranks == 1 else found["memory"]["peak_bytes"] / 2**20
        return usage.ru_utime + usage.ru_stime, megabytes, found
