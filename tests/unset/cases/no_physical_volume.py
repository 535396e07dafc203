# wrong: solids of which Gmsh wrote the surface alone, since only that is a physical group
# ends: 1
# says: this file has no solids
# says: physical volume
# ranks: 1 3
from msh import BLOCK, block

OPTIONS = BLOCK


def make(folder):
    mesh = block({"bottom": "floor", "top": "lid"})
    mesh.elements = [element for element in mesh.elements if element[0] < 3]
    mesh.write(folder / "block.msh")
