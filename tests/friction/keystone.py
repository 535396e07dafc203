"""A wedge between two blocks on a rough floor, against statics: the forces, and the coefficient from which it stands."""
from judge import Run, near, require, same

LIMIT = 0.64 / 2.94


def judge(run):
    for name, sign in (("west", 1), ("east", -1)):
        near(f"force of the floor, {name}", run.pair(name)["force"], [sign * 0.64, 2.94], relative=1e-9)
        near(f"friction, {name}", run.pair(name)["tangential_force"], [sign * 0.64, 0], absolute=1e-9)
    near("thrust", run.pair("from_left")["force"], [0.64, 0.64], relative=1e-9)
    checked = run.again("-cross_check", name="checked").summary["solver"]["cross_check"]
    require(checked["agree"], "the second solution differs")
    smooth = [f"-{name}_friction" for name in ("west", "east")]
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "smooth", [*run.arguments, *(word for option in smooth for word in (option, repr(0.99 * LIMIT)))])
    same("exit code below the limit", refused.exit, 2)
    require("wedge slides along (0, -1)" in refused.stderr and "friction is too small to resist" in refused.stderr, refused.stderr)
