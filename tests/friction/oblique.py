"""Equal discs moved onto each other on an oblique line, with more friction than that needs. Nothing slips, and each ring of contact remembers where
it closed. Steps of any length are wrong by their order; halved ones give the limit.

Expected: the forces P and Q of a step add dQ / (pi sqrt(a^2 - x^2)) to the traction. This is the shape of a bonded punch of half width a(P) (Johnson,
Contact mechanics, 7.4; equal halves). The normal approach is P (Cn - ln P) / (pi E*), and so a bonded punch yields by dQ (Ct - 1 - ln P) / (pi E*).
What is far off makes Cn and Ct, which a normal step and one small tangential step give; the path between is the formula's. Nothing is taken by
friction."""
import math

from judge import near, require

MODULUS, DOWN, ASIDE, SMALL = 200 / (2 * (1 - 0.3**2)), 0.0105, 0.0006, 1e-7


def pair_of(step):
    return step["pairs"]["joint"]


def exact(normal, tangent):
    """Q at the end of the path. [in] normal - P there; tangent - dQ of a displacement SMALL there"""
    far = math.pi * MODULUS * DOWN / normal + math.log(normal)
    aside = math.pi * MODULUS * SMALL / tangent + 1 + math.log(normal)
    total, parts = 0, 2000
    for i in range(parts):
        down, low, high = DOWN * (i + 0.5) / parts, 0, normal
        for _ in range(60):
            force = (low + high) / 2
            low, high = (force, high) if force * (far - math.log(force)) < math.pi * MODULUS * down else (low, force)
        total += ASIDE / parts * math.pi * MODULUS / (aside - 1 - math.log(force))
    return total


def judge(run):
    small = run.again("-joint_friction", "2", "-load_steps", "1,2", "-load_steps_halved", "0",
                      "-upper_bc_displacement_top", f"{SMALL}*max(t-1,0),-{DOWN}*min(t,1)", name="small").summary["steps"]
    expected = exact(pair_of(small[0])["normal_force"], pair_of(small[0])["tangential_force"][0] - pair_of(small[1])["tangential_force"][0])
    step = run.summary["steps"][-1]
    value, bar = (pair_of(step["limit"][key])["tangential_force"][0] for key in ("values", "bars"))
    whole = run.again("-load_steps_halved", "0", name="whole").summary["steps"][-1]
    near("tangential force", -value, expected, absolute=bar + 2e-3 * expected)
    require(bar < 0.05 * expected, f"a bar of {bar} for {expected}")
    require(abs(pair_of(whole)["tangential_force"][0] + expected) > 0.02 * expected, "whole steps are as good")
    taken = sum(abs(pair_of(row["limit"]["values"])["dissipation"]) + pair_of(row["limit"]["bars"])["dissipation"] for row in run.summary["steps"])
    require(taken < 1e-3 * sum(step["energy"]["strain"].values()), f"friction takes {taken}")
