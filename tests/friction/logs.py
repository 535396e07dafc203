"""Three logs held by friction alone. On vertices of their meshes they obey the statics of round logs. On edges the heap stands, too, but a facet carries a moment, up to half of
its length times the normal force. Without friction the heap falls apart: the rigid motion that closed the gaps first did so, by a thousand times the largest gap."""
import math

from judge import near, require

MOST = 12  # Newton steps, with those of the proximal point iteration
FACETS = 60
ON_EDGES = 50  # 270 degrees is the middle of a facet


def weight(facets):
    """Of a log of the mesh."""
    return 0.5 * facets * math.sin(2 * math.pi / facets) * (1 - 0.3**2)


def along(pair, degrees):
    """Friction in this direction."""
    return sum(force * part for force, part in zip(pair["tangential_force"], (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))))


def judge_heap(run, heavy, exact):
    """[in] exact - relative, of forces that equilibrium alone gives"""
    floors, joints = ([run.pair(f"{name}_{side}") for side in ("left", "right")] for name in ("floor", "joint"))
    near("weight on the floor", [pair["normal_force"] for pair in floors], [1.5 * heavy] * 2, relative=exact)
    near("spread", floors[0]["tangential_force"][0], -floors[1]["tangential_force"][0], relative=10 * exact)
    near("weight on the lower logs", [pair["force"][1] for pair in joints], [-0.5 * heavy] * 2, relative=exact)
    require(max(run.summary["solver"]["kkt"].values()) < 1e-9, f"{run.summary['solver']['kkt']}")
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
    return floors, joints


def judge(run):
    heavy = weight(FACETS)
    friction = heavy / (2 * (2 + math.sqrt(3)))
    floors, joints = judge_heap(run, heavy, 1e-6)
    near("friction on the floor", [floors[0]["tangential_force"][0], -floors[1]["tangential_force"][0]], [friction] * 2, relative=1e-5)
    near("friction of the upper log", [along(joints[0], -30), along(joints[1], -150)], [friction] * 2, relative=1e-5)
    require(run.stderr.count("nor the friction that holds bodies there") == 4, run.stderr)
    sagitta = 1 - math.cos(math.pi / FACETS)  # a vertex of the polygon is on the circle, the middle of an edge is not
    require(run.stderr.count(f"may touch by {sagitta:.2g} too early") == 2 and run.stderr.count(f"may touch by {2 * sagitta:.2g} too early") == 2, run.stderr)
    words = [f"-{name}_dm_plex_box_faces" for name in ("left", "right", "top")]
    edges = run.again(*(word for name in words for word in (name, f"{ON_EDGES},4")), name="edges")
    heavy = weight(ON_EDGES)
    floors, joints = judge_heap(edges, heavy, 1e-6)
    # Each force on a lower log acts up to half a facet beside the place of statics. Friction on the floor differs from F by the moment of both over 1 + cos 30.
    lever = math.sin(math.pi / ON_EDGES)
    bound = lever * (1.5 * heavy + math.hypot(0.5 * heavy, floors[0]["tangential_force"][0])) / (1 + math.sqrt(3) / 2)
    near("friction on the floor, on edges", floors[0]["tangential_force"][0], heavy / (2 * (2 + math.sqrt(3))), absolute=bound)
