"""Two plates whose sides have the ratios of facets 1:1, 2:1, 1:2, 3:2 and 5:1, nonmortar side first. Five meshes of order 1 agree with the
independent computation of pairing.py. Order 2 has four meshes, the finest ones in the long run. Theory: the number tends to that of two half
planes."""
from judge import LONG, near
from flatness import numbers, require_flat
from pairing import number

RATIOS = ((4, 4), (8, 4), (4, 8), (6, 4), (10, 2))
DENSE = 32  # facets up to which pairing.py takes less than a second


def judge(run):
    for n, m in RATIOS:
        faces = ["-upper_dm_plex_box_faces", f"{n},{n}", "-lower_dm_plex_box_faces", f"{m},{m}"]
        betas = numbers(run, "joint", 5 if LONG else 3, *faces)
        require_flat(f"{n}:{m}", betas, 0.03)
        for level, beta in enumerate(betas):
            if max(n, m) * 2**level <= DENSE:
                near(f"{n}:{m}, refined {level} times", beta, number("dual", n * 2**level, m * 2**level, lumped=True), relative=1e-9)
        require_flat(f"{n}:{m}, order 2", numbers(run, "joint", 4 if LONG else 3, *faces, "-order", "2"), 0.01)
