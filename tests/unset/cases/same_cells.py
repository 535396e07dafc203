# wrong: two bodies of one file, and the regions forgotten: each body is made of all cells
# ends: 1
# says: -lower_mesh_region
# says: the file has the regions steel (1), wood (4)
# says: 24 cells
# ranks: 1 3
from msh import TWO, two

OPTIONS = TWO.replace("-upper_mesh_region steel\n", "").replace("-lower_mesh_region wood\n", "")


def make(folder):
    two().write(folder / "two.msh")
