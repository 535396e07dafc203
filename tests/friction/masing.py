"""A press fit with a given bound of friction, pulled, pushed and pulled again. Poisson's ratio 0 leaves no friction after pressing, and nodes that slip go on in their direction until the load
turns. So each way after the first one has twice the force of the first at twice the distance (Masing 1926), and each of its steps twice the dissipation."""
from judge import near, require

STEPS = 6  # of each way


def judge(run):
    pairs = [step["pairs"]["fit"] for step in run.summary["steps"]]
    force, took = [pair["tangential_force"][1] for pair in pairs], [sum(pair["dissipation"] for pair in pairs[1 + STEPS * k:1 + STEPS * (k + 1)]) for k in range(3)]
    first, size = force[1:STEPS + 1], max(force)
    near("no friction after pressing", force[0], 0, absolute=1e-12 * size)
    near("pushed", force[STEPS + 1:2 * STEPS + 1], [first[-1] - 2 * f for f in first], absolute=1e-11 * size)
    near("pulled again", force[2 * STEPS + 1:], [2 * f - first[-1] for f in first], absolute=1e-11 * size)
    near("dissipation", took[1:], [2 * took[0]] * 2, relative=1e-10)
    shares = [pair["slip_share"] for pair in pairs[1:]]
    require(0 < shares[0] < shares[2] < 1 and shares[:STEPS] == shares[STEPS:2 * STEPS] == shares[2 * STEPS:], f"shares that slip {shares}")
