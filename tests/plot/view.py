"""Solids are seen from where the contact shows, or from where the user says, and are cut where he says."""

import numpy as np

from canvas import load, require_tidy, told, words_of
from judge import near, require, same


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    summary = plot.open_summary(prefix)
    solid, view = plot.load("mortise-plot-solid"), plot.load("mortise-plot-view")
    fields = plot.read_fields(prefix, summary=summary)
    surfaces = {name: plot.read_surface(prefix, name) for name in summary["scene"]["pairs"]}
    skin = solid.Skin(plot, fields["points"], np.column_stack([fields["points"], fields["colour"]]), solid.boundary_of(fields["cells_as_read"]))
    contact = view.contact_of(plot, surfaces, 0.0)
    points, triangles = skin.values[:, :3], skin.triangles
    shares = {name: view.shown_share(solid, towards, points, triangles, contact) for name, towards in view.octants().items()}
    same("octants", sorted(shares), sorted(x + y + z for x in "+-" for y in "+-" for z in "+-"))
    for name, share in shares.items():  # the ball is below: the bottom hides nothing from below, the block all of it from above
        require(share > 0.95 if name[2] == "-" else share < 0.2, f"octant {name} shows {share:.3f} of the contact")
    towards, share = view.choose(solid, points, triangles, skin.values[:, 3], contact)
    require(towards[2] < 0 and share > 0.95, f"the contact is not seen from {towards}")

    for text, wanted in (("x", [1, 0, 0]), ("-z", [0, 0, -1]), ("90,0", [0, 0, 1]), ("0,90", [0, 1, 0]), ("-30,180", [-np.sqrt(0.75), 0, -0.5])):
        near(f"--view {text}", view.parse_view(text), wanted, absolute=1e-12)
    for name in shares:
        same(f"octant {name}", ["+" if part > 0 else "-" for part in view.parse_view(name)], list(name))
    figure = plot.draw_solved(prefix, summary, None, "von_mises")
    title = plot.fill(summary["scene"]["title"], figure, 14)
    require(title.count("\n") > 0 and title.replace("\n", " ") == summary["scene"]["title"], f"the title is {title!r}")
    figure.suptitle(title, fontsize=14, fontweight="bold", parse_math=False)
    require_tidy(figure, "the picture from below")

    if solid.find_pyvista():
        left = view.cut(solid, fields, np.column_stack([fields["points"], fields["displacement"], fields["colour"], fields["node_body"]]), 0, 0.4, 1.0)
        near("end of what is left", left.values[np.unique(left.triangles), 0].max(), 0.4, absolute=1e-6)
        corners = left.values[left.triangles, :3]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        section = np.abs(corners[:, :, 0] - 0.4).max(axis=1) < 1e-6
        near("area of the section", np.linalg.norm(normals[section], axis=1).sum(), 0.7, relative=1e-5)  # 1 by 0.7
        cut = plot.draw_solved(prefix, summary, 1.0, "von_mises", {"view": "+-+", "cut": "x=0.4"})
        require(any("cut at x = 0.4" in text for text, _ in words_of(cut)), "the picture does not say that it is cut")
    for value in ("-z", "-30,180"):  # of two words, though argparse takes the second one for an option
        same(f"what --view {value} says", told(plot, prefix, "--view", value, "-o", run.folder / "seen.png"), (0, ""))
    for flag, value, says in (("view", "up", "an octant such as"), ("view", "100,0", "-90 to 90"), ("cut", "u=1", "x=0.5"), ("cut", "x=9", "from 0 to 1 along x")):
        code, words = told(plot, prefix, f"--{flag}", value, "-o", run.folder / "none.png")
        same(f"exit code of --{flag} {value}", code, 1)
        require(f"--{flag} {value}: " in words and says in words and words.count("\n") == 1, words)
