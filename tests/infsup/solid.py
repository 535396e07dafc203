"""Tetrahedra on hexahedra in space, 2:3 and with exchanged roles 3:2, and tetrahedra alone. There are four meshes of order
1, the finest in the long run, and two of order 2."""
from judge import LONG
from flatness import numbers, require_flat

SWAPPED = ["-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom"]
TETRAHEDRA = ["-lower_dm_plex_simplex", "1"]


def judge(run):
    for arguments in ([], SWAPPED, TETRAHEDRA):
        require_flat(f"order 1 {arguments}", numbers(run, "joint", 4 if LONG else 3, *arguments), 0.05)
    for arguments in ([], SWAPPED):
        require_flat(f"order 2 {arguments}", numbers(run, "joint", 2, *arguments, "-order", "2"), 0.05)
