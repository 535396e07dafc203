# wrong: a plane mesh drawn in the x-z plane instead of the x-y plane
# ends: 1
# says: not parallel to the x,y plane
from msh import PLATE, plate

OPTIONS = PLATE


def make(folder):
    mesh = plate()
    mesh.nodes = [(x, z, y) for x, y, z in mesh.nodes]
    mesh.write(folder / "plate.msh")
