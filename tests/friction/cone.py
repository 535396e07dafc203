"""All of the seat slips while the plug is pressed in: N (sin a + mu cos a) is the force, tan a = 0.1 the slope. Let go, the plug comes out where mu < tan a.
Forces and displacements are then rounding of those of the first step, on every mesh, and no mesh is made for them. With mu > tan a it stays, and the seat takes
no axial force. Pulled as hard as it was pressed in, it lifts off: by statics the seat holds N (mu cos a - sin a), less than half of the force."""
import math

from judge import Run, near, require, same

PUSH, SLOPE = 1000, math.atan(0.1)


def judge(run):
    for friction, other in ((0.05, run), (0.2, run.again("-seat_friction", "0.2", name="locked", warns=["not_unique"]))):
        pressed, free = (step["pairs"]["seat"] for step in other.summary["steps"])
        force = PUSH / (math.sin(SLOPE) + friction * math.cos(SLOPE))
        near("pressed", pressed["normal_force"], force, relative=1e-9)
        near("axial force", pressed["force"][1], PUSH, relative=1e-9)
        near("axial force, let go", free["force"][1], 0, absolute=1e-9 * force)
        if friction > 0.1:
            require(free["normal_force"] > 0.5 * force, f"nothing presses: {free['normal_force']}")
        else:
            near("let go", free["normal_force"], 0, absolute=1e-12 * force)
            same("error, let go", other.summary["steps"][1]["estimate"]["energy_norm_relative"], 0)
    pressed = run.again("-load_steps", "1", name="pressed", warns=[])
    same("meshes, as many as the first step needs", *(len(r.summary["estimate"]["meshes"]) for r in (run, pressed)))
    pulled = Run(run.program, run.mpiexec, run.ranks, run.folder / "pulled", run.arguments + ["-seat_friction", "0.2", "-plug_bc_force_top", "0, 1000*(t<1.5 ? -1 : 1)"])
    same("exit code of the pulled plug", pulled.exit, 3)
    same("free motions of the pulled plug", pulled.summary["solvability"]["free_motions"], [])
    require("friction holds the loads no longer" in pulled.stderr and "body plug lifts off along (0, 1)" in pulled.stderr, pulled.stderr)
