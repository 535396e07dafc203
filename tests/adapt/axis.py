"""The block moves as a whole into a sphere that no node meets: one mesh says so, though its error is compared with a rigid motion, and -adapt goes on until it
finds the contact. The force is above Hertz's for a half space, 4/3 E* sqrt(R) d^1.5. For a layer of thickness h that is held on its other side the factor is
1 + a x + (a x)^2 with x = sqrt(R d)/h, a = 2/pi (1.2876 - 1.4678 nu + 1.3442 nu^2)/(1 - nu) (Dimitriadis et al. 2002): 1.114. The block is no wider than high."""
from judge import near, require, same


def judge(run):
    same("nodes in contact on one mesh", run.pair("ball")["active_nodes"], 0)
    hertz = 4 / 3 * 2000 / (1 - 0.3**2) * 2**0.5 * 0.0069**1.5
    found = [run.again("-adapt", "2e-2", *cells, name=name, warns=["model_limit"]) for name, cells in (("cut", []), ("kept", ["-block_dm_plex_simplex", "0", "-adapt_cells", "kept"]))]
    forces, bars = ([results["pairs"]["ball"]["normal_force"] for results in part] for part in zip(*((other.summary, other.summary["bars"]) for other in found)))
    near("forces of both meshes", forces[0], forces[1], absolute=sum(bars))
    require(1.08 < forces[0] / hertz < 1.14, f"the force is {forces[0]}, Hertz's {hertz}")
