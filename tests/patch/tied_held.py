"""Tied nodes that supports hold along the tie: with prescribed shear on both sides the stress is constant, as in options/tied.opts."""
from judge import near

SHEAR, PULL = 3e-3 * 384615384.615385, 2e-3 * 1346153846.153846
SIDES = ["-upper_bc_displacement", "top,left,right", "-lower_bc_displacement", "bottom,left,right"]
for _side, _sign in (("left", -1), ("right", 1)):
    for _body, _strain in (("upper", 3e-3), ("lower", SHEAR / 1.2e9)):
        SIDES += [f"-{_body}_bc_displacement_{_side}", f"{_strain}*y,free", f"-{_body}_bc_traction_{_side}", f"0,{_sign * SHEAR}"]
CASES = {"linear": [], "nodes": ["-order", "2"], "vertices": ["-order", "2", "-glue_multipliers", "vertices"],
         "swapped": ["-glue_nonmortar", "lower:top", "-glue_mortar", "upper:bottom"]}


def judge(run):
    for name, options in run.some(CASES.items()):
        held = run.again(*SIDES, *options, name=name)
        sign = -1 if name != "swapped" else 1
        near(f"force, {name}", held.pair("glue")["force"], [sign * SHEAR, sign * PULL], relative=1e-9)
        for probe in held.summary["probes"].values():
            near(f"shear stress, {name}", probe["stress"][5], SHEAR, relative=1e-9)
