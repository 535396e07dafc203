"""msh.py -- small Gmsh files of format 2.2 for cases: blocks of quadrilaterals or hexahedra, joined only where they are told to be; and the
scenes that several cases spoil."""
import itertools

FACETS = {  # of a block: axis, end, name
    2: [(0, 0, "left"), (0, 1, "right"), (1, 0, "bottom"), (1, 1, "top")],
    3: [(0, 0, "left"), (0, 1, "right"), (1, 0, "front"), (1, 1, "back"), (2, 0, "bottom"), (2, 1, "top")],
}
TYPES = {1: 1, 2: 3, 3: 5}  # Gmsh's numbers of lines, quadrilaterals and hexahedra
AROUND = {1: [(0,), (1,)], 2: [(0, 0), (1, 0), (1, 1), (0, 1)]}  # corners in Gmsh's order
AROUND[3] = [corner + (up,) for up in (0, 1) for corner in AROUND[2]]


class Msh:
    """Nodes, cells and facets by group. Blocks have nodes of their own, unless `join` is set when they are added."""

    def __init__(self, dim):
        self.dim, self.nodes, self.elements, self.groups = dim, [], [], {}  # elements: (dimension, group, nodes)

    def group(self, dim, name):
        """The number of a physical group; None for elements without one."""
        return self.groups.setdefault((dim, name), len(self.groups) + 1) if name else 0

    def node(self, x):
        self.nodes.append(tuple(x))
        return len(self.nodes)

    def block(self, lower, upper, faces, region="all", sides=None, join=False):
        """A box of cells. [in] sides - names of groups by FACETS, {"left": "wall"}; others are in none; join - use nodes that are there."""
        known = {x: n + 1 for n, x in enumerate(self.nodes)} if join else {}
        grid = {}
        for place in itertools.product(*(range(n + 1) for n in faces)):
            x = tuple(a + (b - a) * i / n for a, b, i, n in zip(lower, upper, place, faces)) + (0.0,) * (3 - self.dim)
            grid[place] = known.get(x) or self.node(x)
        for place in itertools.product(*(range(n) for n in faces)):
            self.elements.append((self.dim, self.group(self.dim, region), [grid[tuple(p + c for p, c in zip(place, corner))] for corner in AROUND[self.dim]]))
        for axis, end, name in FACETS[self.dim]:
            if name not in (sides or {}):
                continue
            others = [k for k in range(self.dim) if k != axis]
            for place in itertools.product(*(range(faces[k]) for k in others)):
                corners = []
                for corner in AROUND[self.dim - 1]:
                    at = [0] * self.dim
                    at[axis] = faces[axis] * end
                    for k, p, c in zip(others, place, corner):
                        at[k] = p + c
                    corners.append(grid[tuple(at)])
                self.elements.append((self.dim - 1, self.group(self.dim - 1, sides[name]), corners))
        return self

    def write(self, path):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.groups))]
        lines += [f'{dim} {number} "{name}"' for (dim, name), number in self.groups.items()]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{n + 1} {' '.join(map(repr, x))}" for n, x in enumerate(self.nodes)]
        lines += ["$EndNodes", "$Elements", str(len(self.elements))]
        lines += [f"{n + 1} {TYPES[dim]} 2 {group} {group} {' '.join(map(str, nodes))}" for n, (dim, group, nodes) in enumerate(self.elements)]
        path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")


# --- scenes that are right: options, and the mesh of their file -------------------------------------------------------

HANGING = """
-bodies {body}
-{body}_dm_plex_filename {body}.msh
-{body}_young 2e5
-{body}_poisson 0.3
-{body}_body_force {force}
-{body}_bc_displacement {sides}
"""
PLATE = HANGING.format(body="plate", force="0,-1", sides="foot") + "-plate_bc_displacement_foot 0,0\n"
BLOCK = HANGING.format(body="block", force="0,0,-1", sides="floor") + "-block_bc_displacement_floor 0,0,0\n"
TWO = """
-bodies upper,lower
-upper_dm_plex_filename two.msh
-upper_mesh_region steel
-upper_young 2e5
-upper_poisson 0.3
-upper_bc_displacement top
-upper_bc_displacement_top 0,-0.001
-lower_dm_plex_filename two.msh
-lower_mesh_region wood
-lower_young 1e4
-lower_poisson 0.3
-lower_bc_displacement floor
-lower_bc_displacement_floor 0,0
-pairs joint
-joint_nonmortar upper:foot
-joint_mortar lower:seat
"""


def plate():
    """The mesh of PLATE."""
    return Msh(2).block((0, 0), (2, 1), (4, 2), "steel", {"bottom": "foot"})


def block(sides):
    """The mesh of BLOCK. [in] sides - its groups, {"bottom": "floor"} where nothing is wrong with them."""
    return Msh(3).block((0, 0, 0), (1, 1, 1), (2, 2, 2), "steel", sides)


def two():
    """The mesh of TWO, both bodies in one file."""
    upper = Msh(2).block((0, 0), (1, 1), (3, 4), "steel", {"top": "top", "bottom": "foot"})
    return upper.block((0, -1), (1, 0), (4, 3), "wood", {"top": "seat", "bottom": "floor"})
