"""Against the axisymmetric model of the same head and cup, whose rims are circles and not those of a quarter of a cube.

With the rim of the head at 1.15 to 1.35 rad from the pole, the axisymmetric force is 1523.9 to 1534.5. The pressure at the pole is 7.410
to 7.424 (24 by 8 cells on 32 by 10 of order 2, refined once)."""
import numpy as np

from judge import near, require


def judge(run):
    pair = run.pair("joint")
    near("force", -4 * pair["force"][2], 1529.2, relative=7e-3)
    near("moment between the two forces of the pair, across a gap that is curved", pair["moment_imbalance"], 0, absolute=1e-12)
    table = run.table("joint")
    p = np.array(table["pressure"])
    near("pressure at the pole", p[np.argmin(np.hypot(table["x"], table["y"]))], 7.417, relative=7e-3)
    require(np.nanmax(p) < 1.01 * 7.417, f"a pressure of {np.nanmax(p):.3g} at the edge of the socket, where nothing touches")
    require(min(table["force"]) > -1e-9, "a contact that pulls")
