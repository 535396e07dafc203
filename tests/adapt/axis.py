"""The block moves as a whole into a sphere that no node meets: one mesh says so, though its error is compared with a rigid motion, and -adapt goes on until it
finds the contact. The force is above Hertz's for a half space, 4/3 E* sqrt(R) d^1.5. For a layer of thickness h that is held on its other side the factor is
1 + a x + (a x)^2 with x = sqrt(R d)/h, a = 2/pi (1.2876 - 1.4678 nu + 1.3442 nu^2)/(1 - nu) (Dimitriadis et al. 2002): 1.114. The block is no wider than high.
With friction that turns within the facets at the axis, the largest pressure of a coarse mesh lies within its bar of a finer one's."""
from judge import near, require, same


def judge(run):
    same("nodes in contact on one mesh", run.pair("ball")["active_nodes"], 0)
    hertz = 4 / 3 * 2000 / (1 - 0.3**2) * 2**0.5 * 0.0069**1.5
    found = [run.again("-adapt", "2e-2", *cells, name=name, warns=["model_limit"]) for name, cells in (("cut", []), ("kept", ["-block_dm_plex_simplex", "0", "-adapt_cells", "kept"]))]
    forces, bars = ([results["pairs"]["ball"]["normal_force"] for results in part] for part in zip(*((other.summary, other.summary["bars"]) for other in found)))
    near("forces of both meshes", forces[0], forces[1], absolute=sum(bars))
    require(1.08 < forces[0] / hertz < 1.14, f"the force is {forces[0]}, Hertz's {hertz}")
    slides = ["-ball_friction", "0.1", "-block_dm_plex_box_faces", "3,3", "-block_bc_displacement_top", "free,-0.0069"]
    coarse, fine = (run.again(*slides, "-adapt", tolerance, name=tolerance, warns=["model_limit"]) for tolerance in ("4e-2", "4e-3"))
    value, bar, limit, rest = (results["pairs"]["ball"]["max_pressure"] for results in (coarse.summary, coarse.summary["bars"], fine.summary, fine.summary["bars"]))
    near("pressure around the axis", value, limit, absolute=bar + rest)
    require(bar < 0.2 * value, f"the bar of the pressure says nothing: {bar}")
