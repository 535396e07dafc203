"""A laminate with the strain eps = 5e-3 along its layers and none across: sigma_xx = E_i (eps - eps_0i) in each layer. eps_0 is alpha T = 1e-3
in the first, an initial strain of 2e-3 in the second, 0 in the third. The strain energy is the sum over the layers."""
from judge import near

STRAIN = 5e-3
LAYERS = [(0.3, 2.0, 1e-3), (0.4, 1000.0, 2e-3), (0.3, 5.0, 0.0)]  # height, C_xx, strain without stress


def judge(run):
    force = sum(height * young * (STRAIN - free) for height, young, free in LAYERS)
    near("reaction", run.summary["reactions"]["strip:right"], [force, 0], absolute=1e-12 * force)
    energy = sum(height * young * (STRAIN - free)**2 / 2 for height, young, free in LAYERS)
    near("strain energy", run.summary["energy"]["strain"]["strip"], energy, relative=1e-12)
    with run.fields() as file:
        points, stress = file["points"][()], file["stress"][()]
    for height, (_, young, free) in zip((0.1, 0.5, 0.9), LAYERS):
        inside = [s[0] for x, s in zip(points, stress) if abs(x[1] - height) < 0.15 and not min(abs(x[1] - 0.3), abs(x[1] - 0.7)) < 1e-9]
        near(f"stress at {height}", inside, [young * (STRAIN - free)] * len(inside), relative=1e-11)
