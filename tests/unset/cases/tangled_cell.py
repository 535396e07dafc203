# wrong: a node moved across its cells: they are tangled
# ends: 1
# says: tangled
from msh import PLATE, plate

OPTIONS = PLATE


def make(folder):
    mesh = plate()
    mesh.nodes[7] = (1.9, 0.9, 0.0)
    mesh.write(folder / "plate.msh")
