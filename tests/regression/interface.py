"""What the result files promise: every key, null for what is not known, and the same numbers in every file.

Nothing here compares with figures that the program produced before: files are compared with each other, with closed
formulas, and with the laws of mechanics.
"""
import base64
import json
import math
import struct
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from judge import Run, near, require, same, same_table

TOP = ["mortise", "status", "options", "scene", "solvability", "solver", "energy", "pairs", "reactions", "probes", "timing", "memory"]
KEYS = {
    "mortise": ["version", "petsc", "ranks", "options_file"],
    "scene": ["title", "model", "dimension", "bodies", "pairs"],
    "solvability": ["verdict", "motion", "work", "free_motions"],
    "solver": ["type", "iterations", "active", "changed", "linear_iterations", "kkt", "balance", "energy_bound"],
    "energy": ["strain", "potential"],
    "timing": ["setup", "mortar", "assembly", "condense", "solve", "output", "total", "linear_reference"],
    "memory": ["peak_bytes", "largest_rank_bytes"],
}
BODY = ["cells", "nodes", "dofs", "order", "floating"]
SCENE_PAIR = ["nonmortar", "mortar", "candidates"]
PAIR = ["force", "normal_force", "area", "max_pressure", "max_pressure_at", "min_gap", "active_nodes", "extent", "centre_of_pressure"]
PROBE = ["at", "displacement", "stress", "von_mises", "principal"]
COLUMNS = ["x", "y", "pressure", "gap", "status", "force", "arc_length"]
POINT_SHAPES = {"displacement": 3, "stress": 9, "von_mises": 1, "principal": 3, "pressure": 1, "gap": 1, "status": 1, "error_estimate": 1}
ROUNDING = 1e-11


def has(what, table, keys):
    missing = [key for key in keys if key not in table]
    require(not missing, f"{what} lacks {', '.join(missing)}")


def judge_keys(summary):
    """Every key that there is to be, and what of the scene is counted."""
    has("the summary", summary, TOP)
    for part, keys in KEYS.items():
        has(part, summary[part], keys)
    bodies = summary["scene"]["bodies"]
    same("bodies", list(bodies), ["block", "base", "cap"])
    for name, body in bodies.items():
        has(name, body, BODY)
    same("cells", [body["cells"] for body in bodies.values()], [6, 16, 2])
    same("nodes", [body["nodes"] for body in bodies.values()], [12, 15, 6])
    same("dofs", [body["dofs"] for body in bodies.values()], [24, 30, 12])
    same("floating", [body["floating"] for body in bodies.values()], [True, False, False])
    for name, pair in summary["scene"]["pairs"].items():
        has(name, pair, SCENE_PAIR)
    same("sides", [(p["nonmortar"], p["mortar"]) for p in summary["scene"]["pairs"].values()],
         [("block:bottom", "base:top"), ("block:top", "cap:bottom"), ("cap:right", "plane")])
    for name, pair in summary["pairs"].items():
        has(name, pair, PAIR)
    for name, probe in summary["probes"].items():
        has(name, probe, PROBE)
    same("reactions", sorted(summary["reactions"]), ["base:bottom", "cap:top"])
    same("strain energies", list(summary["energy"]["strain"]), ["block", "base", "cap"])
    same("an option", summary["options"]["output_format"], "xdmf,vtu")
    require("options_file" not in summary["options"], "options are told one by one, not by their file")
    same("title", summary["scene"]["title"], "Cap & block <on> a base")
    same("linear_reference", summary["timing"]["linear_reference"], None)
    require(summary["memory"]["peak_bytes"] >= summary["memory"]["largest_rank_bytes"] > 1e6, "a run takes more than a megabyte")
    require(summary["timing"]["total"] >= summary["timing"]["solve"] > 0, "times do not add up")


def judge_mechanics(summary):
    """Supports, loads, obstacle: all forces add up to zero; what a pair passes on is what its supports take."""
    pairs, reactions = summary["pairs"], summary["reactions"]
    size = max(abs(f) for force in reactions.values() for f in force)
    load = np.array([0.0, -3 * 1.0 * 0.5])  # traction times length times thickness
    wall, joint, glue = (np.array(pairs[name]["force"]) for name in ("wall", "joint", "glue"))
    near("sum of forces", reactions["cap:top"] + wall + load + reactions["base:bottom"], [0, 0], absolute=ROUNDING * size)
    near("forces on the cap", reactions["cap:top"] + wall - glue, [0, 0], absolute=ROUNDING * size)
    near("forces on the block", joint + glue, [0, 0], absolute=ROUNDING * size)
    near("force without friction", joint[0], 0, absolute=ROUNDING * size)
    near("force of the wall", wall, [-pairs["wall"]["normal_force"], 0], absolute=ROUNDING * size)
    near("force of the joint", joint, [0, pairs["joint"]["normal_force"]], absolute=ROUNDING * size)
    require(pairs["joint"]["area"] <= 0.9 * 0.5 * (1 + ROUNDING), "contact where there is nothing to touch")
    near("area of the tie", pairs["glue"]["area"], 0.5, relative=ROUNDING)
    for name, value in {**summary["solver"]["kkt"], **summary["solver"]["balance"]}.items():
        require(value is not None and 0 <= value < 1e-11, f"{name} of the certificate is {value}")
    # 2 W = f.u + R.u + contact forces times the gaps they close (Clapeyron), and potential = W - f.u
    strain = sum(summary["energy"]["strain"].values())
    outer = reactions["cap:top"][0] * 0.02 - reactions["cap:top"][1] * 0.03 + wall[0] * 0.005
    near("potential", summary["energy"]["potential"], outer - strain, relative=ROUNDING)


def judge_tables(run, summary):
    """The CSV tables against the summary."""
    for name, pair in summary["pairs"].items():
        table = run.table(name)
        same(f"columns of {name}", list(table), COLUMNS)
        size = abs(pair["normal_force"])
        near(f"forces of {name}", sum(table["force"]), pair["normal_force"], absolute=ROUNDING * size)
        carried = [s for s in table["status"] if s >= 0]
        same(f"candidates of {name}", len(carried), summary["scene"]["pairs"][name]["candidates"])
        same(f"active nodes of {name}", sum(s >= 1 for s in carried), pair["active_nodes"])
        near(f"gap of {name}", min(g for g in table["gap"] if not math.isnan(g)), pair["min_gap"], absolute=1e-15)
        steps = np.hypot(np.diff(table["x"]), np.diff(table["y"]))
        near(f"arc of {name}", np.diff(table["arc_length"]), steps, relative=ROUNDING)
        same(f"start of {name}", table["arc_length"][0], 0.0)
        pressed = [p for p, s in zip(table["pressure"], table["status"]) if s >= 1]
        near(f"largest pressure of {name}", max(pressed), pair["max_pressure"], relative=1e-15)
    joint = run.table("joint")
    same("nodes of the joint", len(joint["x"]), 4)
    covered = [p for p, s, x in zip(joint["pressure"], joint["status"], joint["x"]) if s >= 1 and x > 0.5]  # the base begins at 0.1
    near("largest pressure away from the end of the base", summary["pairs"]["joint"]["max_pressure_covered"], max(covered, default=0), relative=1e-15)
    same("joint is walked from its first end", joint["x"], sorted(joint["x"]))


def judge_fields(run, summary):
    """The HDF5 file: shapes, held nodes, von Mises, and the tables once more."""
    with run.fields() as file:
        same("title", file.attrs["title"], summary["scene"]["title"])
        fields = {name: file[name][()] for name in file}
    points, nodes = fields["points"], sum(body["nodes"] for body in summary["scene"]["bodies"].values())
    same("points", points.shape, (nodes, 3))
    for name, components in POINT_SHAPES.items():
        same(name, fields[name].shape, (nodes,) if components == 1 else (nodes, components))
    same("cells of each body", np.bincount(fields["body"]).tolist(), [6, 16, 2])
    top = points[:, 1] == 1.5
    near("given displacement", fields["displacement"][top].ravel(), [0.02, -0.03, 0] * int(top.sum()), relative=ROUNDING)
    s = fields["stress"].reshape(-1, 3, 3)
    near("symmetry of the stress", (s - s.transpose(0, 2, 1)).ravel(), np.zeros(9 * nodes), absolute=0)
    deviator = s - np.trace(s, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
    near("von Mises", fields["von_mises"], np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2))), relative=1e-13)
    size = np.abs(s).max()
    near("principal stresses", fields["principal"].ravel(), np.linalg.eigvalsh(s)[:, ::-1].ravel(), absolute=1e-14 * size)
    for probe in summary["probes"].values():
        xx, yy, zz, yz, xz, xy = probe["stress"]
        tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        near("principal stresses of a probe", probe["principal"], np.linalg.eigvalsh(tensor)[::-1], absolute=1e-14 * size)
    for name, nu in (("block", 0.3), ("base", 0.25)):
        own = np.unique(np.concatenate([c for c, b in zip(cells_of(fields), fields["body"]) if list(summary["scene"]["bodies"])[b] == name]))
        near(f"zz of {name} in plane strain", s[own, 2, 2], nu * (s[own, 0, 0] + s[own, 1, 1]), relative=1e-13)
    held = fields["status"] >= 0
    table = {"x": points[held, 0], "y": points[held, 1], **{k: fields[k][held] for k in ("pressure", "gap", "status")}}
    merged = {column: [] for column in table}
    for name in summary["pairs"]:
        rows = run.table(name)
        for row, status in enumerate(rows["status"]):
            if status >= 0:
                for column in merged:
                    merged[column].append(rows[column][row])
    same_table(table, merged, {"pressure": (1e-15, 0), "gap": (0, 1e-17), "status": (0, 0)})
    return fields


def cells_of(fields):
    """Cells as lists of points: a mixed list of XDMF type numbers and points, or a plain table."""
    if fields["cells"].ndim == 2:
        return list(fields["cells"])
    cells, at = [], 0
    while at < len(fields["cells"]):
        size = {4: 3, 5: 4}[int(fields["cells"][at])]
        cells.append(fields["cells"][at + 1:at + 1 + size])
        at += size + 1
    return cells


def judge_xdmf(run, fields):
    """Every data item is a dataset of the file beside it, of the shape it says."""
    tree = xml.parse(run.folder / "result.xdmf").getroot()
    grids = tree.findall(".//Grid")
    same("grids", [grid.get("Name") for grid in grids], ["Cap & block <on> a base"] * 2)
    for grid in grids:
        items = [item for child in grid if child.tag != "Information" for item in child.findall("DataItem")]
        same("quantities", len(items), 2 + len(POINT_SHAPES) + 1)
        for item in items:
            name, dataset = item.text.split(":/")
            same("file beside the XDMF file", name, "result.h5")
            same(f"shape of {dataset}", tuple(int(n) for n in item.get("Dimensions").split()), fields[dataset].shape)
    same("type of cells", grids[0].find("Topology").get("TopologyType"), "Mixed")
    same("cells", int(grids[0].find("Topology").get("NumberOfElements")), len(fields["body"]))


def vtu_arrays(path):
    """The arrays of a VTU file by their names, but for the names of bodies."""
    formats = {"Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
    arrays = {}
    for item in xml.parse(path).getroot().findall(".//Piece//DataArray"):
        data = base64.b64decode(item.text)
        same(f"bytes of {item.get('Name')}", struct.unpack("<Q", data[:8])[0], len(data) - 8)
        arrays[item.get("Name")] = np.frombuffer(data[8:], dtype=formats[item.get("type")])
    return arrays


def judge_vtu(run, fields):
    """The VTU file holds the same arrays."""
    arrays = vtu_arrays(run.folder / "result.vtu")
    for name in ["points", "body", *POINT_SHAPES]:
        require(np.array_equal(arrays[name], fields[name].ravel(), equal_nan=True), f"{name} differs between VTU and HDF5")
    require(np.array_equal(arrays["connectivity"], np.concatenate(cells_of(fields))), "cells differ between VTU and HDF5")
    same("cells", len(arrays["types"]), len(fields["body"]))


def judge_surfaces(run, summary, fields):
    """The nonmortar side of each pair as a grid of its own: the table's numbers, lines from point to point."""
    for name in summary["pairs"]:
        table = run.table(name)
        with h5py.File(run.folder / f"result_{name}.h5", "r") as file:
            surface = {key: file[key][()] for key in file}
        order, rows = np.argsort(surface["points"] @ (1, math.pi, 0)), np.argsort(np.array(table["x"]) + math.pi * np.array(table["y"]))
        near(f"points of {name}", surface["points"][order, :2].ravel(), np.column_stack([table["x"], table["y"]])[rows].ravel(), absolute=0)
        for column in ("pressure", "gap", "status"):
            require(np.array_equal(surface[column][order], np.array(table[column])[rows], equal_nan=True), f"{column} of {name} differs")
        ends = surface["points"][surface["cells"]]
        near(f"length of {name}", np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum(), max(table["arc_length"]), relative=ROUNDING)
        near(f"normals of {name}", np.linalg.norm(surface["normal"], axis=1), np.ones(len(order)), absolute=1e-15)
        along = (ends[:, 1] - ends[:, 0]) / np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)[:, None]  # straight sides here
        near(f"outside of {name}", surface["normal"][surface["cells"][:, 0]].ravel(),
             np.column_stack([along[:, 1], -along[:, 0], 0 * along[:, 0]]).ravel(), absolute=1e-14)
        for point, u in zip(surface["points"], surface["displacement"]):
            near(f"displacement of {name}", np.abs(fields["displacement"][(fields["points"] == point).all(axis=1)] - u).min(axis=0),
                 [0, 0, 0], absolute=0)
        tree = xml.parse(run.folder / f"result_{name}.xdmf").getroot()
        for item in tree.iter("DataItem"):
            file, dataset = item.text.split(":/")
            same(f"shape of {dataset} of {name}", (file, *(int(n) for n in item.get("Dimensions").split())),
                 (f"result_{name}.h5", *surface[dataset].shape))
        arrays = vtu_arrays(run.folder / f"result_{name}.vtu")
        for key in ("points", "displacement", "pressure", "gap", "status", "normal", "body"):
            require(np.array_equal(arrays[key], surface[key].ravel(), equal_nan=True), f"{key} of {name} differs between VTU and HDF5")
        require(np.array_equal(arrays["connectivity"], surface["cells"].ravel()), f"cells of {name} differ between VTU and HDF5")


def judge_readers(run, fields):
    """Other people's readers, where they are installed."""
    try:
        import meshio
    except ImportError:
        meshio = None
    try:
        import pyvista
    except ImportError:
        pyvista = None
    for suffix in ("xdmf", "vtu"):
        if meshio:
            mesh = meshio.read(run.folder / f"result.{suffix}")
            require(np.array_equal(mesh.point_data["displacement"], fields["displacement"]), f"meshio reads {suffix} otherwise")
        if pyvista:
            mesh = pyvista.read(run.folder / f"result.{suffix}")
            require(np.array_equal(mesh.point_data["displacement"], fields["displacement"]), f"pyvista reads {suffix} otherwise")


def judge_summary_option(run):
    """-quiet -summary - prints the JSON text and nothing else; -summary <file> writes it."""
    again = run.again("-summary", "-", "-quiet", name="printed")
    same("printed summary", json.loads(again.stdout), again.summary)
    again = run.again("-summary", "alone/summary.json", name="alone")
    written = json.loads((again.folder / "alone" / "summary.json").read_text())
    same("summary on its own", written, again.summary)
    same("temporary files", [str(path) for path in again.folder.rglob("*.part*")], [])


def judge_ranks(run, summary, fields):
    """The same as on one rank, and the same forces per thickness."""
    single = run.again(ranks=1, name="single")
    for name, pair in summary["pairs"].items():
        other, size = single.pair(name), abs(pair["normal_force"])
        near(f"force of {name}", pair["force"], other["force"], absolute=1e-10 * size)
        same(f"active nodes of {name}", pair["active_nodes"], other["active_nodes"])
        near(f"place of the largest pressure of {name}", pair["max_pressure_at"], other["max_pressure_at"], absolute=1e-12)
        same_table(run.table(name), single.table(name),
                   {"pressure": (1e-10, 0), "force": (1e-10, 0), "status": (0, 0), "arc_length": (1e-12, 0)})
    with single.fields() as file:
        order, other_order = (np.lexsort(np.round(points, 9).T) for points in (fields["points"], file["points"][()]))
        # Coincident points of different bodies are told apart by their displacements.
        for name in ("displacement", "von_mises"):
            near(f"sum of {name}", fields[name][order].sum(axis=0), file[name][()][other_order].sum(axis=0), relative=1e-10)
    thin = run.again("-thickness", "0.25", name="thin")
    for name, pair in summary["pairs"].items():
        near(f"force of {name} at half the thickness", thin.pair(name)["normal_force"], pair["normal_force"] / 2, relative=1e-10)
        near(f"pressure of {name} at half the thickness", thin.pair(name)["max_pressure"], pair["max_pressure"], relative=1e-10)


def judge_failure(run):
    """Linear systems solved to one digit: exit code 3, a sentence, and a summary that says so."""
    arguments = run.arguments + ["-ksp_type", "cg", "-pc_type", "jacobi", "-ksp_rtol", "0.1", "-ksp_max_it", "3"]
    poor = Run(run.program, run.mpiexec, run.ranks, run.folder / "poor", arguments)
    same("exit code", poor.exit, 3)
    require(poor.stderr.startswith("mortise: "), "a failed run says nothing")
    same("status", poor.summary["status"], "not_converged")


def judge(run):
    summary = run.summary
    judge_keys(summary)
    judge_mechanics(summary)
    judge_tables(run, summary)
    fields = judge_fields(run, summary)
    judge_xdmf(run, fields)
    judge_vtu(run, fields)
    judge_surfaces(run, summary, fields)
    judge_readers(run, fields)
    judge_summary_option(run)
    judge_ranks(run, summary, fields)
    judge_failure(run)
