"""Bars of numbers that coarse meshes agree on by chance contain what finer meshes of other cells find: the radial reaction, whose corner is refined late, and
the slip of a stamp that sticks on all meshes, with the work of friction."""
from judge import near, require

# a stamp in the plane whose friction is bounded; it sticks on the meshes of the first tolerance
PLANE = ["-model", "plane_strain", "-stamp_dm_plex_box_faces", "4,4", "-stamp_dm_plex_box_lower", "-0.6648,0", "-stamp_dm_plex_box_upper", "0.5317,0.8",
         "-stamp_young", "862", "-stamp_poisson", "0", "-stamp_bc_displacement_top", "0,-0.00314", "-block_dm_plex_box_faces", "2,5",
         "-block_dm_plex_box_lower", "-1,-1", "-block_young", "3968", "-block_poisson", "0", "-joint_nonmortar", "block:top", "-joint_mortar", "stamp:bottom",
         "-joint_friction", "0", "-joint_friction_bound", "1.956"]
# a stamp about the axis on the coarsest meshes, without friction
RING = ["-stamp_dm_plex_box_faces", "5,2", "-stamp_dm_plex_box_upper", "0.4666,1.116", "-stamp_young", "656", "-stamp_poisson", "0.409", "-stamp_bc_displacement_top",
        "0,-0.00667", "-block_dm_plex_box_faces", "5,5", "-block_dm_plex_box_upper", "1.232,0", "-block_young", "62.3", "-block_poisson", "0.387", "-joint_friction", "0"]


def judge(run):
    coarse = run.again(*RING, "-adapt", "1e-1", name="ring")
    fine = run.again(*RING, "-adapt", "8e-3", "-adapt_cells", "kept", name="ring_fine")
    value, bar, limit, rest = (results["reactions"]["stamp:top"][0] for results in (coarse.summary, coarse.summary["bars"], fine.summary, fine.summary["bars"]))
    near("ring: radial", value, limit, absolute=bar + rest)
    require(bar < 0.5 * abs(value), f"the bar of the radial reaction says nothing: {bar}")
    for name, scene in (("axis", []), ("plane", PLANE)):
        warns = ["edge_pressure"] if scene else None
        coarse = run.again(*scene, name="plane", warns=warns) if scene else run
        fine = run.again(*scene, "-adapt", "8e-3", "-adapt_cells", "kept", name=f"{name}_fine", warns=warns)
        for number, (path, index) in {"radial": (("reactions", "stamp:top"), 0), "slip": (("pairs", "joint", "max_slip"), None),
                                      "work": (("pairs", "joint", "dissipation"), None)}.items():
            values = []
            for results in (coarse.summary, coarse.summary["bars"], fine.summary, fine.summary["bars"]):
                for key in path:
                    results = results[key]
                values.append(results if index is None else results[index])
            value, bar, limit, rest = values
            near(f"{name}: {number}", value, limit, absolute=bar + rest)
    slip = coarse.summary["bars"]["pairs"]["joint"]["max_slip"]
    require(slip < 1e-2 * 0.00314, f"the bar of the slip says nothing: {slip}")
