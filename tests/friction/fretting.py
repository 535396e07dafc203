"""Equal discs sheared to and fro, against Cattaneo and Mindlin at every step: history is that of all steps before."""
import math

from judge import near, read_table, require

MU, MODULUS, RADIUS = 0.2, 200 / (2 * (1 - 0.3**2)), 160


def ellipse(x, a):
    return math.sqrt(max(0, 1 - (x / a) ** 2))


def shear(x, a, part):
    """q / (mu p0) of a tangential force that is this part of mu P, sheared for the first time."""
    c = a * math.sqrt(1 - part)
    return ellipse(x, a) - c / a * ellipse(x, c) if c > 0 else ellipse(x, a)


def top(t):
    """Displacement of the upper side, as the scene gives it."""
    return 0.00295 * (max(t - 1, 0) - 2 * max(t - 2, 0) + 2 * max(t - 4, 0)), -0.0105 * min(t, 1)


def judge(run):
    steps = run.summary["steps"]
    parts = []
    for step in steps:
        pair = step["pairs"]["joint"]
        parts.append(-pair["tangential_force"][0] / (MU * pair["normal_force"]))
        require(pair["dissipation"] > -1e-20, f"dissipation {pair['dissipation']} at t = {step['t']}")
    near("sheared to and fro", [parts[2], parts[6], parts[10]], [parts[2], -parts[2], parts[2]], absolute=2e-3)
    require(0.8 < parts[2] < 0.95, f"sheared by {parts[2]} of what slips everywhere")
    table = read_table(run.folder / "result_steps.csv")
    for name, key in (("tangential_force_x", lambda pair: pair["tangential_force"][0]), ("dissipation", lambda pair: pair["dissipation"])):
        near(f"column {name}", table[f"joint.{name}"], [key(step["pairs"]["joint"]) for step in steps], relative=1e-15)
    for before, step in zip(steps, steps[1:]):
        way = [after - old for after, old in zip(top(step["t"]), top(before["t"]))]
        work = sum((old + new) / 2 * d for old, new, d in zip(before["reactions"]["upper:top"], step["reactions"]["upper:top"], way))
        stored = sum(step["energy"]["strain"].values()) - sum(before["energy"]["strain"].values())
        balance = step["energy"]["balance"]
        near(f"work of the upper side until t = {step['t']}", [balance["work"], balance["stored"]], [work, stored], relative=1e-8)
        taken = step["pairs"]["joint"]["dissipation"]
        near("defect", balance["defect"], work - stored - taken, absolute=1e-8 * abs(work))
    force = run.pair("joint")["normal_force"]
    a = math.sqrt(4 * force * RADIUS / (math.pi * MODULUS))
    p0 = 2 * force / (math.pi * a)
    table = run.table("joint")
    stuck = max(abs(x) for x, status in zip(table["x"], table["status"]) if status == 4)
    c = a * math.sqrt(1 - (parts[10] - parts[6]) / 2)  # loaded again from the other side: the whole turn counts by half
    near("where it sticks", stuck, c, absolute=0.1 * a)
    for x, q in zip(table["x"], table["tangential_traction_x"]):
        exact = shear(x, a, -parts[6]) - 2 * shear(x, a, (parts[10] - parts[6]) / 2)  # of the nonmortar body: signs turn
        if abs(x) < 0.8 * a:
            near(f"q at x = {x:.3g}", q / (MU * p0), exact, absolute=0.05)
