"""Without stress at a corner between free sides, all of its von Mises stress and principal stresses is error. Components add up in them: their bars are wider
than those of the components."""
from judge import near


def judge(run):
    found, bars = run.probe("corner"), run.summary["bars"]["probes"]["corner"]
    near("von Mises", found["von_mises"], 0, absolute=bars["von_mises"])
    for k, bar in enumerate(bars["principal"]):
        if bar is None:  # it still grows
            continue
        near(f"principal {k}", found["principal"][k], 0, absolute=bar)
