"""Where coarse meshes agree, finer ones lie within the bars all the same: reactions of sides that end at a clamped one, and the centre of pressure of contact
at one node."""
from judge import require

FINE = {"upper": "6e-4", "corner": "2e-3"}  # by the first pair


def numbers(summary):
    yield from summary["reactions"].items()
    for name, pair in summary["pairs"].items():
        yield name, pair["centre_of_pressure"]


def judge(run):
    coarse = run.summary
    first = next(iter(coarse["pairs"]))
    fine = run.again("-adapt", FINE[first], name="fine", warns=["edge_pressure", "model_limit"] if first == "corner" else None).summary
    bars = [dict(numbers(results["bars"])) for results in (coarse, fine)]
    limits = dict(numbers(fine))
    for name, values in numbers(coarse):
        for k, value in enumerate(values):
            bar, own = bars[0][name][k], bars[1][name][k]
            require(abs(value - limits[name][k]) <= bar + own + 1e-8 * abs(value), f"{name}[{k}]: {value} +- {bar}, finer {limits[name][k]} +- {own}")
            require(own <= bar, f"{name}[{k}]: bar {own} of the finer mesh, {bar} of the coarse one")
