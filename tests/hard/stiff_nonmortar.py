"""Mean gaps of the stiff side are below every gap by 1e-4 of the approach of the bodies. That is no jump of the gap, though the stiff side moves by less."""
from judge import near, require

APPROACH = 0.002


def judge(run):
    overlap = run.pair("seat")["false_overlap"]
    require(0 < overlap < 1e-3 * APPROACH, f"the overlap is {overlap / APPROACH:.3g} of the approach, not a little above 0")
    rigid = run.again("-seat_nonmortar", "soft:bottom", "-seat_mortar", "stiff:top", name="exchanged")
    near("force with the roles exchanged", run.pair("seat")["normal_force"], rigid.pair("seat")["normal_force"], relative=0.01)
