# wrong: a file of Gmsh 4.0, an old format, of solids
# ends: 1
# says: its format is 4; formats 2.2 and 4.1 are accepted
# says: block.msh
from msh import BLOCK, block

OPTIONS = BLOCK


def make(folder):
    path = folder / "block.msh"
    block({"bottom": "floor"}).write(path)
    path.write_text(path.read_text().replace("2.2 0 8", "4.0 0 8", 1))
