"""A bolt that is tightened to a force: the section carries it, and its strain is the interference that does the same."""
import pathlib

from judge import Run, near

LENGTH = 10


def judge(run):
    steps = run.summary["steps"]
    first = steps[0]
    near("force of the bolt", first["pretension"]["shank"]["force"], 17e3, relative=1e-9)
    near("seat", first["pairs"]["seat"]["normal_force"], 17e3, relative=1e-9)
    near("joint", first["pairs"]["joint"]["normal_force"], 17e3, relative=1e-9)
    near("symmetry plane", first["reactions"]["shank:bottom"][1], -17e3, relative=1e-9)
    strain = first["pretension"]["shank"]["strain"]
    for step in steps:
        near("tightened once", step["pretension"]["shank"]["strain"], strain)
        near("section", step["pretension"]["shank"]["force"], -step["reactions"]["shank:bottom"][1], relative=1e-9)
        near("balance", step["pairs"]["joint"]["normal_force"] + 7854 * step["t"], step["pairs"]["seat"]["normal_force"], relative=1e-9)
    # no pretension, but a seat that overlaps by what the bolt was shortened: the same forces in every step
    scene = pathlib.Path(run.arguments[run.arguments.index("-options_file") + 1]).read_text()
    other = run.folder / "overlap.opts"
    other.write_text("".join(line for line in scene.splitlines(True) if "pretension" not in line) + f"-seat_gap {LENGTH * strain:.17g}\n")
    overlap = Run(run.program, run.mpiexec, run.ranks, run.folder / "overlap", ["-options_file", str(other)])
    overlap.require_solved()
    for step, same in zip(steps, overlap.summary["steps"]):
        for pair in ("seat", "joint"):
            near("overlap", same["pairs"][pair]["normal_force"], step["pairs"][pair]["normal_force"], relative=1e-9)
    # a force that names t is found in every step
    for step in run.again("-shank_pretension", "17e3*(1+0*t)", "-load_steps", "0,1", name="each_step").summary["steps"]:
        near("each step", step["pretension"]["shank"]["force"], 17e3, relative=1e-9)
