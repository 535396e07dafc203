# wrong: a region of the file is misspelt
# ends: 1
# says: -plate_mesh_region stel
# says: steel
from msh import PLATE, plate

OPTIONS = PLATE + "-plate_mesh_region stel\n"


def make(folder):
    plate().write(folder / "plate.msh")
