# wrong: two nodes of a cell in one place: a facet has no length
# ends: 1
# says: degenerate
from msh import PLATE, plate

OPTIONS = PLATE


def make(folder):
    mesh = plate()
    mesh.nodes[0] = mesh.nodes[1]
    mesh.write(folder / "plate.msh")
