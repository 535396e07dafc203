"""Uniform and linear temperatures in planes, rings and solids, of free and of held bodies, by Hooke's law."""
import numpy

from judge import near

E, NU, ALPHA, T = 1000, 0.3, 1e-5, 50
SCALE = E * ALPHA * T


def stress(run, expected, tolerance=1e-12):
    near("stress", run.probe("p")["stress"], expected, absolute=tolerance * SCALE)


def energy(run, expected, tolerance=1e-12):
    for value in (run.summary["energy"]["strain"]["a"], run.summary["energy"]["potential"]):
        near("energy", value, expected, relative=tolerance, absolute=tolerance * SCALE * ALPHA * T)


def free(run, across, density, volume, *words, name, tolerance=1e-12):
    for order in "12" if run.ranks == 1 else "2":
        other = run.again(*words, "-order", order, name=f"{name}{order}")
        stress(other, [0, 0, across, 0, 0, 0], tolerance)
        energy(other, density * volume, tolerance)


def judge(run):
    area = 2 * (1 - 0.1 * 0.1)  # int (1 - 0.2 y * 0.1)
    thick = ["-thickness", "2"]
    half = E * (ALPHA * T) ** 2 / 2
    free(run, -E * ALPHA * T, half, 2 * area, *thick, name="strain")
    free(run, -E * ALPHA * T, half, 2 * area, *thick, "-a_dm_plex_simplex", "1", name="triangles")
    free(run, -E * ALPHA * T, half, 2 * area, *thick, "-a_poisson", "0.499", name="incompressible", tolerance=1e-10)
    free(run, 0, 0, 2 * area, *thick, "-model", "plane_stress", name="stress")
    ring = ["-model", "axisymmetric", "-a_map", "x+0.5,y+0.1*x"]
    free(run, 0, 0, 1, *ring, name="ring")
    free(run, 0, 0, 1, *ring, "-a_poisson", "0.4995", name="ring_incompressible", tolerance=1e-10)
    # linear temperatures: sigma_zz alone where a plane is held, nothing in a ring whose temperature varies along the axis
    straight = ["-a_map", "x+0.2*y,y", "-order", "2", "-a_temperature", "20+3*x-4*y"]
    for nu in ("0.3", "0.499"):
        here = 20 + 3 * 1.1 - 4 * 0.5
        stress(run.again(*straight, "-a_poisson", nu, name=f"linear{nu}"), [0, 0, -E * ALPHA * here, 0, 0, 0], 1e-10 if nu != "0.3" else 1e-12)
    stress(run.again(*straight, "-model", "plane_stress", name="linear_stress"), [0] * 6)
    stress(run.again(*ring, "-a_map", "x+0.5,y", "-order", "2", "-a_temperature", "20+7*z", name="linear_ring"), [0] * 6)
    held(run)


def held(run):
    """A body that is held all round: -E alpha T / (1 - 2 nu) in solids, in a plane stress -E alpha T / (1 - nu), shear -mu gamma."""
    sides = "left+right+bottom+top"
    fixed = ["-a_bc_displacement", sides, f"-a_bc_displacement_{sides}", "0,0", "-a_map", "x+0.1*y*y,y+0.1*x"]
    for nu in (0.3, 0.4999):
        hydrostatic = -E * ALPHA * T / (1 - 2 * nu)
        other = run.again(*fixed, "-a_poisson", str(nu), name=f"held{nu}")
        near("held", other.probe("p")["stress"], [hydrostatic] * 3 + [0] * 3, relative=1e-11)
        energy(other, 4.5 * E / (3 * (1 - 2 * nu)) * (ALPHA * T) ** 2 * 2 * (1 - 0.01), 1e-11)
    plane = run.again(*fixed, "-model", "plane_stress", name="held_stress").probe("p")["stress"]
    near("held", plane, [-E * ALPHA * T / (1 - NU)] * 2 + [0] * 4, relative=1e-11)
    shear = run.again(*fixed, "-a_temperature", "0", "-a_initial_strain", "0,0,0,2e-3", name="held_shear").probe("p")["stress"]
    near("held", shear, [0] * 5 + [-E / (2 * (1 + NU)) * 2e-3], relative=1e-11)
    # eps_0,zz alone: -(lambda + 2 mu) e, -lambda e
    lam, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
    across = run.again(*fixed, "-a_temperature", "0", "-a_initial_strain", "0,0,1e-3,0", name="held_across").probe("p")["stress"]
    near("held", across, numpy.array([-lam, -lam, -lam - 2 * mu, 0, 0, 0]) * 1e-3, relative=1e-11)
