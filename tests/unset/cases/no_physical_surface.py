# wrong: solids with a physical volume, and no physical surface for the support
# ends: 1
# says: body 'block' has no side 'floor'
from msh import BLOCK, block

OPTIONS = BLOCK


def make(folder):
    block({}).write(folder / "block.msh")
