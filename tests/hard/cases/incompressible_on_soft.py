"""Lever arms; and no locking: bilinear cells that lock are several times too stiff."""
from judge import near


def judge(run):
    fine = run.again("-order", "2", name="quadratic")
    for solved in (run, fine):
        near("force", solved.pair("joint")["force"], [0, 1.5], absolute=1e-9)
        near("place", solved.pair("joint")["centre_of_pressure"][0], 5 / 9, absolute=1e-8)
    plain = [run.again("-upper_poisson", "0.3", "-order", order, name=f"plain{order}").summary["energy"] for order in "12"]
    ours = [run.summary["energy"], fine.summary["energy"]]
    for what, of in (("potential", lambda energy: energy["potential"]), ("energy of the block", lambda energy: energy["strain"]["upper"])):
        apart = abs(of(plain[0]) / of(plain[1]) - 1)
        near(what, of(ours[0]), of(ours[1]), relative=2 * apart)
