from judge import Run, near, same


def judge(run):
    """The side is inclined, and walls hold both ends: its neighbours have the parts of the end nodes (eq. 5.1), so that the force is normal to it."""
    own = Run(run.program, run.mpiexec, run.ranks, run.folder / "own_reach", run.arguments + ["-joint_reach", "0.1"])
    own.require_solved()
    table, force = own.table("joint"), own.pair("joint")["force"]
    same("nodes without a row", [x for x, status in zip(table["x"], table["status"]) if status < 0], [0, 1])
    same("nodes in contact", own.pair("joint")["active_nodes"], len(table["x"]) - 2)
    near("slope of the force", -force[0] / force[1], 0.002, relative=1e-9)
