"""roundmesh.py -- discs and rings as Gmsh files of format 2.2, of first order (polygons) or second (arcs within a fourth power).

Nodes of rims lie on their circles to the last digit. A mesh may be turned, so that another node, or none, is lowest.
"""
import math


class Mesh:
    """Nodes, facets by side, cells."""

    def __init__(self):
        self.nodes, self.facets, self.cells = [], [], []  # facets: (side, nodes); corners first, then middles

    def add(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes)

    def area(self):
        """Of straight cells and of the parabolas on their rims: the integral of x dy along the sides, by Simpson's rule."""
        at = lambda number: self.nodes[number - 1]
        total = 0.0
        for _, (a, b, *middle) in self.oriented():
            (x0, y0), (x1, y1) = at(a), at(b)
            xm, ym = at(middle[0]) if middle else ((x0 + x1) / 2, (y0 + y1) / 2)
            total += (x0 * (4 * ym - 3 * y0 - y1) + 4 * xm * (y1 - y0) + x1 * (3 * y1 - 4 * ym + y0)) / 6
        return total

    def oriented(self):
        """Facets with their cells on the left."""
        edges = {(cell[i], cell[(i + 1) % n]) for cell in self.cells for n in [3 if len(cell) in (3, 6) else 4] for i in range(n)}
        return [(side, nodes if nodes[:2] in edges else (nodes[1], nodes[0], *nodes[2:])) for side, nodes in self.facets]

    def write(self, path):
        sides = sorted({side for side, _ in self.facets})
        kinds = {("facet", 2): 1, ("facet", 3): 8, ("cell", 3): 2, ("cell", 6): 9, ("cell", 4): 3, ("cell", 9): 10}
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(sides) + 1)]
        lines += [f'1 {number + 1} "{side}"' for number, side in enumerate(sides)]
        lines += [f'2 {len(sides) + 1} "all"', "$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{number + 1} {x!r} {y!r} 0" for number, (x, y) in enumerate(self.nodes)]
        rows = [(kinds["facet", len(nodes)], sides.index(side) + 1, nodes) for side, nodes in self.facets]
        rows += [(kinds["cell", len(nodes)], len(sides) + 1, nodes) for nodes in self.cells]
        lines += ["$EndNodes", "$Elements", str(len(rows))]
        lines += [f"{number + 1} {kind} 2 {group} {group} {' '.join(map(str, nodes))}" for number, (kind, group, nodes) in enumerate(rows)]
        path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")
        return path


def disc(radius, layers, order=1, turned=0.0, centre=(0.0, 0.0), spread=0.0, side="rim"):
    """Triangles in layers around a centre, 6 k nodes on the k-th circle. [in] spread - of nodes along the rim, in parts of a facet,
    as a wave that is not even."""
    mesh, circles, middles = Mesh(), [], {}

    def place(k, angle):
        r = radius * k / layers
        return mesh.add(centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle))

    angle_of = {}
    for k in range(layers + 1):
        circle = []
        for i in range(max(6 * k, 1)):
            angle = turned + (2 * math.pi * i / (6 * k) if k else 0)
            angle += spread * math.sin(3 * angle + 1) * (2 * math.pi / (6 * layers)) * k / layers
            circle.append(place(k, angle))
            angle_of[circle[-1]] = (k, angle)
        circles.append(circle)

    def middle(a, b):
        if (min(a, b), max(a, b)) not in middles:
            (k, angle), (other, angle_b) = angle_of[a], angle_of[b]
            if k == other == layers:
                step = (angle_b - angle + math.pi) % (2 * math.pi) - math.pi
                middles[min(a, b), max(a, b)] = place(k, angle + step / 2)
            else:
                (x, y), (v, w) = mesh.nodes[a - 1], mesh.nodes[b - 1]
                middles[min(a, b), max(a, b)] = mesh.add((x + v) / 2, (y + w) / 2)
        return middles[min(a, b), max(a, b)]

    def cell(*corners):
        mesh.cells.append(corners if order == 1 else (*corners, *(middle(corners[i], corners[(i + 1) % 3]) for i in range(3))))

    for k in range(layers):
        inner, outer = circles[k], circles[k + 1]
        for sector in range(6):
            for i in range(k + 1):
                a, b = outer[sector * (k + 1) + i], outer[(sector * (k + 1) + i + 1) % len(outer)]
                foot = inner[(sector * k + i) % len(inner)]
                cell(a, b, foot)
                if i < k:
                    cell(foot, b, inner[(sector * k + i + 1) % len(inner)])
    rim = circles[-1]
    for i, a in enumerate(rim):
        b = rim[(i + 1) % len(rim)]
        mesh.facets.append((side, (a, b) if order == 1 else (a, b, middle(a, b))))
    return mesh


def ring(inner, outer, around, through, order=1, turned=0.0, centre=(0.0, 0.0)):
    """Quadrilaterals between two circles, sides "inner" and "outer"."""
    mesh = Mesh()
    fine = around * order
    rows = [[mesh.add(centre[0] + r * math.cos(turned + 2 * math.pi * i / fine), centre[1] + r * math.sin(turned + 2 * math.pi * i / fine))
             for i in range(fine)] for r in (inner + (outer - inner) * k / (through * order) for k in range(through * order + 1))]
    at = lambda k, i: rows[k][i % fine]
    for k in range(0, through * order, order):
        for i in range(0, fine, order):
            corners = (at(k, i), at(k + order, i), at(k + order, i + order), at(k, i + order))
            if order == 2:
                corners += (at(k + 1, i), at(k + 2, i + 1), at(k + 1, i + 2), at(k, i + 1), at(k + 1, i + 1))
            mesh.cells.append(corners)
    for side, k in (("inner", 0), ("outer", through * order)):
        for i in range(0, fine, order):
            mesh.facets.append((side, (at(k, i), at(k, i + order)) if order == 1 else (at(k, i), at(k, i + 2), at(k, i + 1))))
    return mesh
