"""A shrink fit along an ellipse (semi-axes 2 and 1.5, overlap 1/2000), from files, against the same rings by maps, whose nodes are on it by formula.

With normals of the circles through three nodes, files of first order have 1.8 times the largest pressure, and 5 times by `-adapt`. Along the parabolas
of a file of second order, `-adapt` has 2.8 times, growing without limit.
"""
import roundmesh
from judge import near
from scenes import Findings, Scene

FLAT = 0.75
RINGS = {"shaft": (1, 2), "hub": (1.999, 3)}


def scene_of(order, mesh):
    """[in] mesh - of a ring by its name and radii: options of a body"""
    scene = Scene(order=order)
    for name, radii in RINGS.items():
        scene.body(name, young=1e3, **mesh(name, *radii))
    scene.give(hub_bc_displacement="outer", hub_bc_displacement_outer="0,0")
    scene.joint("joint", "hub:inner", "shaft:outer")
    return scene


def half_by_map(run):
    """Half of it: both ends are on the plane of symmetry."""
    scene = scene_of(2, lambda name, inner, outer: {
        "dm_plex_simplex": 0, "dm_plex_box_faces": "8,64" if name == "shaft" else "8,48", "dm_plex_box_lower": f"{inner},0",
        "dm_plex_box_upper": f"{outer},3.141592653589793", "map": f"x*cos(y),{FLAT}*x*sin(y)", "bc_normal": "bottom,top"})
    place = scene.options.index("-hub_bc_displacement")
    scene.options[place:place + 4] = ["-hub_bc_displacement", "right", "-hub_bc_displacement_right", "0,0"]
    scene.options[scene.options.index("hub:inner")], scene.options[scene.options.index("shaft:outer")] = "hub:left", "shaft:right"
    return scene.solve(run, "map", "-dm_refine", "1").pair("joint")


def from_files(folder, order, file_order, shaft, hub):
    around = {"shaft": (shaft, 0.1), "hub": (hub, 0.33)}
    folder.mkdir(parents=True, exist_ok=True)

    def mesh(name, inner, outer):
        ring = roundmesh.ring(inner, outer, around[name][0], 2, file_order, around[name][1])
        ring.nodes = [(x, FLAT * y) for x, y in ring.nodes]
        return {"dm_plex_filename": ring.write(folder / f"{name}.msh")}

    return scene_of(order, mesh)


def judge(run):
    found, known = Findings(), half_by_map(run)
    for name, order, file_order, facets, words in (("linear", 1, 1, (40, 48), ("-dm_refine", "2")), ("raised", 2, 1, (40, 48), ("-dm_refine", "2")),
                                                   ("adapted", 1, 1, (40, 48), ("-adapt", "2e-2")), ("parabolas", 2, 2, (20, 24), ("-adapt", "2e-2")),
                                                   ("straightened", 1, 2, (20, 24), ("-dm_refine", "2"))):
        with found.case():
            ended = from_files(run.folder / "meshes" / name, order, file_order, *facets).solve(run, name, *words)
            done = ended.pair("joint")
            near(f"{name}: mean pressure", done["mean_pressure"], known["mean_pressure"], relative=6e-3 if file_order == 1 else 2e-3)
            near(f"{name}: largest pressure", done["max_pressure"], known["max_pressure"], relative=0.25)
            if name == "adapted":
                near("told largest pressure", done["max_pressure"], known["max_pressure"], absolute=ended.summary["bars"]["pairs"]["joint"]["max_pressure"])
    found.end()
