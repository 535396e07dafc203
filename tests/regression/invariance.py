"""The history of the active set depends neither on c over twenty decades nor on the units of length and stress."""
from judge import near, same

COORDINATES = {"-upper_dm_plex_box_lower": (0, 0), "-upper_dm_plex_box_upper": (1, 1), "-lower_dm_plex_box_lower": (0, -1),
               "-lower_dm_plex_box_upper": (1, 0), "-probe_corner_at": (1, 0), "-probe_middle_at": (0.5, 0.5)}
STRESSES = {"-upper_young": (8e9,), "-lower_young": (8e9,), "-upper_bc_traction_left": (3e6, -4e6),
            "-lower_bc_traction_right": (-3e6, -7e6)}


def scaled(length, stress):
    """Options of the two plates in another unit of length and of stress."""
    arguments = []
    for table, factor in ((COORDINATES, length), (STRESSES, stress)):
        for option, values in table.items():
            arguments += [option, ",".join(f"{value * factor:.17g}" for value in values)]
    return arguments


def judge(run):
    history = run.summary["solver"]["changed"]
    for exponent in range(-10, 11, 4):
        for reduce in ("true", "false"):
            again = run.again("-snes_pdas_c", f"1e{exponent}", "-snes_pdas_reduce", reduce, name=f"c{exponent}{reduce}")
            same(f"history with c = 1e{exponent}, reduce {reduce}", again.summary["solver"]["changed"], history)
    for length in (1e-6, 1.0, 1e6):
        for stress in (1e-6, 1.0, 1e6):
            again, what = run.again(*scaled(length, stress), name=f"unit{length}_{stress}"), f"in units {length}, {stress}"
            same("history " + what, again.summary["solver"]["changed"], history)
            near("force " + what, again.pair("joint")["normal_force"] / (length * stress), run.pair("joint")["normal_force"], relative=1e-10)
            near("displacement " + what, [u / length for u in again.probe("corner")["displacement"]], run.probe("corner")["displacement"],
                 relative=1e-10)
            again = run.again(*scaled(length, stress), "-snes_type", "vinewtonrsls", name=f"vi{length}_{stress}")
            near("force by vinewtonrsls " + what, again.pair("joint")["normal_force"] / (length * stress),
                 run.pair("joint")["normal_force"], relative=1e-10)
