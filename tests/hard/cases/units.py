"""Lengths and stresses in other units, in every option that has one."""
from judge import near, same

POWERS = {  # of length and stress, of every figure of the scene
    "-upper_dm_plex_box_upper": (1, 0, "1,1"), "-lower_dm_plex_box_lower": (1, 0, "-1,-1"), "-lower_dm_plex_box_upper": (1, 0, "2,0"),
    "-joint_gap_offset": (1, 0, "1e-4"), "-ball_obstacle_point": (1, 0, "0.5,3"), "-ball_obstacle_radius": (1, 0, "2.005"),
    "-probe_corner_at": (1, 0, "1,1"), "-probe_middle_at": (1, 0, "0.4,0.3"), "-probe_below_at": (1, 0, "0.9,-0.2"),
    "-upper_young": (0, 1, "2e11"), "-lower_young": (0, 1, "1e11"),
}
UNITS = {"millimetres_megapascals": (1e3, 1e-6), "micrometres_gigapascals": (1e6, 1e-9), "short_and_stiff": (1e-9, 1e14), "long_and_soft": (1e20, 1e-40),
         "beyond_reason": (1e-60, 1e60)}


def scaled(length, stress):
    x, y = f"x/{length!r}", f"y/{length!r}"
    arguments = ["-upper_bc_pressure_top", f"{1e8 * stress!r}*(1+{x})", "-upper_body_force", f"0,{-1e7 * stress / length!r}*(1+{x})",
                 "-lower_map", f"x+0.1*y*(1+{y}),y"]
    for option, (k, m, text) in POWERS.items():
        arguments += [option, ",".join(repr(float(x) * length**k * stress**m) for x in text.split(","))]
    return arguments


def judge(run):
    for name, (length, stress) in UNITS.items():
        other = run.again(*scaled(length, stress), name=name)
        same(f"steps in {name}", other.summary["solver"]["changed"], run.summary["solver"]["changed"])
        for pair in ("joint", "ball"):
            near(f"force of {pair} in {name}", other.pair(pair)["normal_force"] / (length * stress), run.pair(pair)["normal_force"], relative=1e-10)
        near(f"potential in {name}", other.summary["energy"]["potential"] / length**2 / stress, run.summary["energy"]["potential"], relative=1e-10)
        error = [r.summary["estimate"]["energy_norm_relative"] for r in (other, run)]  # has curved sides and linear loads
        near(f"estimated error in {name}", error[0], error[1], relative=1e-9)
        for probe, values in run.summary["probes"].items():
            for quantity, unit in (("displacement", length), ("stress", stress)):
                near(f"{quantity} at {probe} in {name}", [v / unit for v in other.probe(probe)[quantity]], values[quantity], relative=1e-9)
