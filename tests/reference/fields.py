"""HDF5 files: the fields of a run against a file of the independent program, and against one written on other ranks."""
import pathlib
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from compare import VANISHING, read_fields, same_nodes, scene_folder  # pylint: disable=wrong-import-position

OTHER_RANKS = {1: 3, 2: 1, 3: 2, 4: 3}  # whose file is read on so many ranks


def judge(run):
    with h5py.File(scene_folder(run) / "fields.h5", "r") as file:
        expected = read_fields(file)
    with run.fields() as file:
        table = read_fields(file)
    columns = [name for name in expected if name not in ("body", "x", "y", "z")]
    same_nodes(table, expected, columns)
    with run.again(ranks=OTHER_RANKS[run.ranks], name="other").fields() as file:
        same_nodes(read_fields(file), table, columns, relative=VANISHING)
