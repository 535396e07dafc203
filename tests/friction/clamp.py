"""A plate between a screw and a table, against statics: both resist a push, up to the coefficient times what they press."""
from judge import Run, near, require, same

PRESS, PUSH, MU = 10e3, 3e3, 0.15


def judge(run):
    for step in run.summary["steps"]:
        tip, table = step["pairs"]["tip"], step["pairs"]["table"]
        near("forces", [tip["normal_force"], table["normal_force"]], [PRESS, PRESS], relative=1e-9)
        held = [tip["tangential_force"][0], -table["tangential_force"][0]]  # on the screw, and by the plate
        near(f"friction at t = {step['t']}", sum(held), PUSH * step["t"], absolute=1e-9 * PUSH)
        require(all(abs(q) <= MU * PRESS * (1 + 1e-9) for q in held), f"friction {held} beyond the limit")
        require(min(tip["dissipation"], table["dissipation"]) >= 0, "friction returns work")
    near("the plate slides on the table", run.pair("table")["slip_share"], 1, absolute=1e-12)
    require(0 < run.pair("tip")["slip_share"] < 1, "the screw does not hold the plate")
    if run.ranks == 1:
        judge_again(run)


def judge_again(run):
    """By the second solver, with the pairs in the other order, and pushed too far."""
    checked = run.again("-cross_check", "-load_steps", "0,0.5,0.9", name="checked").summary["solver"]["cross_check"]
    require(checked["agree"], "the second solution differs")
    tight = run.again("-load_steps", "0,0.5,0.9,0.99", name="tight").summary["pairs"]
    near("at 99 percent", tight["tip"]["tangential_force"][0] - tight["table"]["tangential_force"][0], 0.99 * PUSH, absolute=1e-9 * PUSH)
    swapped = run.again("-pairs", "table,tip", name="swapped").summary
    for name in ("tip", "table"):
        near(f"{name}, pairs in the other order", swapped["pairs"][name]["tangential_force"], run.pair(name)["tangential_force"], absolute=1e-6 * PUSH)
    pushed = Run(run.program, run.mpiexec, run.ranks, run.folder / "pushed", [*run.arguments, "-load_steps", "0,0.5,1.01"])
    same("exit code beyond the limit", pushed.exit, 2)
    require("plate slides along (1, 0)" in pushed.stderr and "friction is too small to resist" in pushed.stderr, pushed.stderr)
