# wrong: two bodies of one file, both with the region steel
# ends: 1
# says: -lower_mesh_region
# says: the file has the regions steel (1), wood (4)
# says: 12 cells
from msh import TWO, two

OPTIONS = TWO.replace("wood", "steel")


def make(folder):
    two().write(folder / "two.msh")
