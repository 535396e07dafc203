from judge import Run, same


def judge(run):
    own = Run(run.program, run.mpiexec, run.ranks, run.folder / "own_reach", run.arguments + ["-joint_reach", "0.1"])
    own.require_solved()
    same("nodes in contact", own.pair("joint")["active_nodes"], len(own.table("joint")["x"]))
