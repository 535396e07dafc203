"""Meshes that -convert has made: the answer is that of the Gmsh file, in the plane with regions and in space of second order. A file that does not hold
together is a mistake with a sentence."""
import pathlib
import shutil

import h5py

from judge import Run, judge_mistake, near, require, same, same_table

MESHES = pathlib.Path(__file__).resolve().parents[2] / "options/meshes"


def convert(run, name):
    """Converts a mesh of the scenes. Returns the path of the new one."""
    made = Run(run.program, run.mpiexec, run.ranks, run.folder / f"convert_{name}", ["-convert", str(MESHES / f"{name}.msh"), f"{name}.h5"])
    same("exit code", made.exit, 0)
    made.require_clean()
    require("named physical groups" in made.stdout, f"-convert says {made.stdout!r}")
    return made.folder / f"{name}.h5"


def judge(run):
    scene = pathlib.Path(run.arguments[-1]).stem
    mesh = convert(run, scene)
    bodies = [part[1:].removesuffix("_dm_plex_filename") for part in pathlib.Path(run.arguments[-1]).read_text().split() if part.endswith("_dm_plex_filename")]
    files = [word for body in bodies for word in (f"-{body}_dm_plex_filename", str(mesh))]
    expected = run.again(ranks=1, name="gmsh")
    found = run.again(*files, name="converted")
    near("potential", found.summary["energy"]["potential"], expected.summary["energy"]["potential"], relative=1e-9)
    for name, pair in expected.summary["pairs"].items():
        for what in ("force", "normal_force", "area", "max_pressure"):
            near(f"{what} of {name}", found.pair(name)[what], pair[what], relative=1e-9)
        same(f"active nodes of {name}", found.pair(name)["active_nodes"], pair["active_nodes"])
        same_table(found.table(name), expected.table(name), {"pressure": (1e-9, 0), "status": (0, 0)})
    for name, body in expected.summary["scene"]["bodies"].items():
        for what in ("cells", "nodes", "dofs"):
            same(f"{what} of {name}", found.summary["scene"]["bodies"][name][what], body[what])
    judge_broken(run, mesh, files)


def judge_broken(run, mesh, files):
    """Copies of a file, each with one thing wrong."""
    kind = max(h5py.File(mesh)["elements"], key=int)

    def point(file):
        file[f"elements/{kind}/nodes"][7, 1] = len(file["points"])

    def group(file):
        file[f"elements/{kind}/groups"][7] = -3

    def coordinate(file):
        file["points"][5, 1] = float("nan")

    def rows(file):
        del file[f"elements/{kind}/groups"]

    def version(file):
        file.attrs["mortise_mesh"] = 7

    def columns(file):
        del file["points"]
        file["points"] = [[0.0, 1.0]]

    said = {point: "refers to point", group: "refers to set -3 of groups", coordinate: "a coordinate is not finite",
            rows: f"it has no rows /elements/{kind}/groups", version: "version 7; 1 is accepted", columns: "/points has the shape 1 x 2"}
    for change, sentence in run.some(said.items()):
        broken = run.folder / f"{change.__name__}.h5"
        shutil.copy(mesh, broken)
        with h5py.File(broken, "r+") as file:
            change(file)
        judge_mistake(Run(run.program, run.mpiexec, run.ranks, run.folder / change.__name__, run.arguments + [w if w != str(mesh) else str(broken) for w in files]),
                      ["_dm_plex_filename", broken.name, sentence])
