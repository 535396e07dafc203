"""Plane strain, a = 1, b = 2, pressure q = 1 outside and p inside. u(a) of the hub is that of the shaft,
(1 + nu) / E ((1 - 2 nu) (p a^2 - q b^2) + (p - q) b^2) / (b^2 - a^2) a  =  -(1 + nu) (1 - 2 nu) / E_s p a."""
from judge import near


def judge(run):
    shaft, hub, nu = 1.3 * 0.4 / 1e3, 1.3 / 2e3, 0.3
    # hub: u = hub ((1 - 2 nu) (p - 4) + 4 (p - 1)) / 3
    p = hub * ((1 - 2 * nu) * 4 + 4) / 3 / (shaft + hub * ((1 - 2 * nu) + 4) / 3)
    pressures = run.table("joint")["pressure"]
    near("pressure", pressures, [p] * len(pressures), relative=1e-6)
