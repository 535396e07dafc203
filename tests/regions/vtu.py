"""The VTU file has the numbers of the HDF5 file: region of cells, and two stresses at the nodes between regions."""
import base64
import re

import numpy as np

import layers
from judge import require


def array(text, name):
    found = re.search(rf'<DataArray type="(\w+)" Name="{name}"[^>]*>([^<]*)<', text)
    require(found, f"the VTU file lacks {name}")
    return np.frombuffer(base64.b64decode(found.group(2).strip())[8:], dtype=found.group(1).lower())  # behind the number of bytes


def judge(run):
    layers.judge(run)
    text = (run.folder / "result.vtu").read_text()
    codes = re.search(r'Name="bodies"[^>]*>([^<]*)<', text).group(1).split()
    names = list(run.summary["scene"]["bodies"])
    require(bytes(map(int, codes)).decode() == "".join(f"{name}\0" for name in names), f"the VTU file names bodies {codes}")
    with run.fields() as file:
        require(file.attrs["bodies"] in (",".join(names), ",".join(names).encode()), f"the HDF5 file names bodies {file.attrs['bodies']}")
        for name in ("region", "stress", "body"):
            require((array(text, name) == file[name][()].ravel()).all(), f"{name} differs")
