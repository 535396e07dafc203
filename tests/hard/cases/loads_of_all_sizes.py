"""Without gaps the answer is the load times the answer to a load of one."""
from judge import near, same


def judge(run):
    near("force", run.pair("joint")["force"], [0, 1.5], absolute=1e-10)
    for load in (1e-30, 1e30, 1e-140, 1e140):
        other = run.again("-upper_bc_traction_top", f"0, 0-{load!r}*(1+x)", name=f"load{load}")
        same(f"steps under {load}", other.summary["solver"]["changed"], run.summary["solver"]["changed"])
        near(f"force under {load}", other.pair("joint")["normal_force"] / load, 1.5, relative=1e-10)
        near(f"potential under {load}", other.summary["energy"]["potential"] / load**2, run.summary["energy"]["potential"], relative=1e-10)
        near(f"displacement under {load}", [u / load for u in other.probe("corner")["displacement"]], run.probe("corner")["displacement"], relative=1e-9)
