"""Equal discs pressed together and sheared once, against Cattaneo and Mindlin. The middle ceases to stick at c / a = sqrt(1 - Q / (mu P)), by the
traction in the middle, q = mu p0 (1 - c / a), and by the nodes."""
import math

from judge import near, require

MU, MODULUS, RADIUS = 0.2, 200 / (2 * (1 - 0.3**2)), 160


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    force = pair["normal_force"]
    a = math.sqrt(4 * force * RADIUS / (math.pi * MODULUS))
    p0 = 2 * force / (math.pi * a)
    c = math.sqrt(1 - abs(pair["tangential_force"][0]) / (MU * force))
    near("p0", pair["max_pressure"], p0, relative=2e-3)
    nodes = sorted((abs(x), status, abs(q)) for x, status, q in zip(table["x"], table["status"], table["tangential_traction_x"]))
    near("c / a by the middle", 1 - nodes[0][2] / (MU * p0), c, relative=5e-3)
    stuck, slips = max(x for x, status, _ in nodes if status == 4), min(x for x, status, _ in nodes if status == 3)
    require(0.7 < c < 0.8 and stuck < slips and stuck - 0.01 * a < c * a < slips + 0.01 * a, f"sticks to {stuck}, slips from {slips}, c {c * a}")
