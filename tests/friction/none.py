"""A coefficient of zero is no friction, to the last bit."""
from judge import same


def judge(run):
    without = run.again("-joint_friction", "0", name="zero")
    same("table", (without.folder / "result_joint.csv").read_bytes(), (run.folder / "result_joint.csv").read_bytes())
    with run.fields() as fields, without.fields() as others:
        same("displacement", others["displacement"][()].tobytes(), fields["displacement"][()].tobytes())
    same("friction", without.summary["solver"]["friction"], None)
    same("share that slips", without.pair("joint")["slip_share"], None)
