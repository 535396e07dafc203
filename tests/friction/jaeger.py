"""Equal half planes of any profile, here a flat one with round shoulders. The shear tractions of a frictional run are mu (p(P) - p(P*)), P* = P - Q /
mu, with pressures of two frictionless runs (Ciavarella 1998; Jaeger 1998)."""
from judge import near, require

MU = 0.2


def pressures(run, name, approach):
    """Normal force and {x: p} without friction at a part of the approach."""
    done = run.again("-joint_friction", "0", "-load_steps", repr(approach), name=name)
    table = done.table("joint")
    return done.pair("joint")["normal_force"], dict(zip(table["x"], table["pressure"]))


def at_force(run, name, force, full):
    """Pressures at a normal force, by secants from 0 and the full one."""
    points = [(0.0, 0.0), (1.0, full)]
    for turn in range(6):
        (t0, f0), (t1, f1) = points[-2:]
        t = t1 + (force - f1) * (t1 - t0) / (f1 - f0)
        found, table = pressures(run, f"{name}{turn}", t)
        if abs(found / force - 1) < 1e-6:
            return table
        points.append((t, found))
    return require(False, f"no approach gives the force {force}")


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    force, shear = pair["normal_force"], abs(pair["tangential_force"][0])
    require(0.3 < shear / (MU * force) < 0.9, f"sheared by {shear / (MU * force)}")
    full, loaded = pressures(run, "full", 1.0)
    near("the force does not feel friction", full, force, relative=2e-3)
    loaded = at_force(run, "loaded", force, full)
    inner = at_force(run, "inner", force - shear / MU, full)
    largest = MU * max(loaded.values())
    off = [abs(abs(q) - MU * (loaded[x] - inner[x])) / largest for x, q in zip(table["x"], table["tangential_traction_x"])]
    ends = [abs(x) for x, status in zip(table["x"], table["status"]) if status == 4]
    stuck = max(x for x, p in inner.items() if p > 1e-6 * max(inner.values()))
    h = min(b - a for a, b in zip(sorted(loaded), sorted(loaded)[1:]))
    near("where it sticks", max(ends), stuck, absolute=3 * h)
    require(sum(o * o for o in off) <= 4e-6 * len(off) and max(off) < 0.01, f"root mean square {(sum(o * o for o in off) / len(off)) ** 0.5} of mu p, largest {max(off)}")
