"""The largest slip of the benchmark GRECO is where its corner lifts off. Coarse meshes agree on it by chance. Bars of both orders contain what a finer mesh of other
cells finds, and say something."""
from judge import near, require


def judge(run):
    fine = run.again("-adapt", "4e-4", "-adapt_cells", "kept", name="fine")
    for name, part in (("order 2", run), ("order 1", run.again("-order", "1", "-adapt", "4e-2", name="linear"))):
        value, bar, limit, rest = (results["pairs"]["floor"]["max_slip"] for results in (part.summary, part.summary["bars"], fine.summary, fine.summary["bars"]))
        near(f"{name}: largest slip", value, limit, absolute=bar + rest)
        require(bar < 0.25 * value, f"{name}: the bar of the slip says nothing: {bar}")
