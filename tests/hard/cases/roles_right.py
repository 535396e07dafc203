from judge import near
from rigid import PARTNER, rigid_twin


def judge(run):
    twin = rigid_twin(run)
    near("force", run.pair("joint")["normal_force"], twin.pair("joint")["normal_force"], relative=10 * PARTNER)
    near("pressures", sorted(run.table("joint")["pressure"]), sorted(twin.table("joint")["pressure"]), relative=10 * PARTNER)
    near("strain energy", run.summary["energy"]["strain"]["upper"], twin.summary["energy"]["strain"]["upper"], relative=10 * PARTNER)
