"""A uniform pressure between solids: sums of the pair, its table and its surface, errors, and the pictures of it."""
import os
import pathlib
import subprocess

import h5py
import numpy as np

from interface import vtu_arrays
from judge import near, require, same

P, ROUNDING = 10.0, 1e-10
LOWER, UPPER = np.array([1.0, 2.0, 0.0]), np.array([3.0, 5.0, 0.0])
AREA = 6.0
CORNERS = {4: 4, 9: 4, 3: 3, 6: 3}


def exact(points):
    return np.column_stack([0.0025 * (points[:, 0] - 1), 0.0025 * (points[:, 1] - 2), -0.01 * (points[:, 2] + 1)])


def judge_summary(summary):
    pair = summary["pairs"]["joint"]
    near("force", pair["force"], [0, 0, P * AREA], absolute=ROUNDING * P * AREA)
    near("normal force", pair["normal_force"], P * AREA, relative=ROUNDING)
    near("area", pair["area"], AREA, relative=ROUNDING)
    near("largest pressure", pair["max_pressure"], P, relative=ROUNDING)
    near("gap", pair["min_gap"], 0, absolute=1e-13)
    near("extent", [*pair["extent"]["lower"], *pair["extent"]["upper"]], [*LOWER, *UPPER], absolute=1e-13)
    near("centre of pressure", pair["centre_of_pressure"], (LOWER + UPPER) / 2, absolute=ROUNDING)
    require(pair["moment_imbalance"] < 1e-12, "the forces of the pair turn")
    near("reaction below", summary["reactions"]["lower:bottom"], [0, 0, P * AREA], absolute=ROUNDING * P * AREA)
    near("strain energy", [summary["energy"]["strain"][body] for body in ("upper", "lower")],
         [P * P / 2000 * volume for volume in (12, 6)], relative=ROUNDING)
    near("potential energy", summary["energy"]["potential"], -P * P / 2000 * 18, relative=ROUNDING)
    probe = summary["probes"]["inside"]
    near("displacement of a probe", probe["displacement"], exact(np.array([probe["at"]]))[0], absolute=ROUNDING)
    near("stress of a probe", probe["stress"], [0, 0, -P, 0, 0, 0], absolute=ROUNDING * P)
    near("principal stresses", probe["principal"], [0, 0, -P], absolute=ROUNDING * P)
    for body in ("upper", "lower"):
        require(max(summary["errors"][body][key] for key in ("l2_relative", "energy_relative")) < 1e-9, f"{body} has an error")
    require(max(summary["errors"]["joint"][key] for key in ("pressure_l2_relative", "pressure_weighted_relative")) < ROUNDING,
            "the pressure has an error")


def judge_surface(run):
    table = run.table("joint")
    same("columns", list(table), ["x", "y", "z", "pressure", "gap", "status", "force"])
    near("forces of the nodes", sum(table["force"]), P * AREA, relative=ROUNDING)
    near("pressures of the nodes", table["pressure"], [P] * len(table["x"]), relative=ROUNDING)
    places = [*zip(table["x"], table["y"], table["z"])]
    same("order of the rows", places, sorted(places))
    with h5py.File(run.folder / "result_joint.h5", "r") as file:
        surface = {name: file[name][()] for name in file}
    points, cells = surface["points"], surface["cells"]
    same("nodes", sorted(map(tuple, points)), places)
    near("displacement", surface["displacement"].ravel(), exact(points).ravel(), absolute=ROUNDING)
    near("pressure", surface["pressure"], [P] * len(points), relative=ROUNDING)
    near("normal", surface["normal"].ravel(), [0, 0, -1] * len(points), absolute=1e-14)
    same("status", set(surface["status"].tolist()), {1})
    corners = points[cells[:, :CORNERS[cells.shape[1]]]][:, :, :2]
    after = np.roll(corners, -1, axis=1)
    area = (corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1]).sum(axis=1) / 2
    require((area < 0).all(), "facets run anticlockwise seen from outside, from below here")
    near("area of the facets", -area.sum(), AREA, relative=1e-13)
    arrays = vtu_arrays(run.folder / "result_joint.vtu")
    for name in ("points", "displacement", "pressure", "gap", "status", "normal"):
        require(np.array_equal(arrays[name], surface[name].ravel()), f"{name} differs between VTU and HDF5")


def judge_pictures(run):
    """Two pictures, by whatever there is to draw with, and the page."""
    plot = pathlib.Path(__file__).parents[2] / "src" / "plot" / "mortise-plot"
    for name, more in (("default", []), ("other", ["--colour", "z"])):
        done = subprocess.run([plot, run.folder / "result", "-o", run.folder / f"{name}.png", *more], capture_output=True, text=True, check=False)
        same("what mortise-plot says", (done.returncode, done.stderr), (0, ""))
        image = picture(run.folder / f"{name}.png")
        bodies = image[:, :image.shape[1] // 2]
        colours = (np.ptp(bodies, axis=2) > 0.2).mean()
        require(0.1 < colours < 0.9, f"{colours:.0%} of {name}.png is coloured")
    page = (run.folder / "result.html").read_text(encoding="utf-8")
    same("pictures on the page", page.count("data:image/svg+xml"), 2)


def picture(path):
    os.environ.setdefault("MPLBACKEND", "Agg")
    from matplotlib import image  # pylint: disable=import-outside-toplevel

    return image.imread(path)[:, :, :3]


def judge(run):
    judge_summary(run.summary)
    judge_surface(run)
    if (run.folder / "result.html").exists():
        judge_pictures(run)
