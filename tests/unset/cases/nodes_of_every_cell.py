# wrong: every cell has nodes of its own, as some exporters write them: the pieces of the plate fall
# ends: 2
# says: body plate is in 4 pieces that touch and are not joined: 6 nodes coincide
from msh import PLATE, Msh

OPTIONS = PLATE


def make(folder):
    mesh = Msh(2)
    for i in range(4):
        mesh.block((i, 0), (i + 1, 1), (1, 1), "steel", {"left": "foot"} if i == 0 else {})
    mesh.write(folder / "plate.msh")
