"""A measured overlap of curved sides, a tenth of what edges cut off them: nodes that hang on such edges change no gap. The mean pressure is that of
Lame's shells, and the estimate falls from mesh to mesh; with gaps of the straight edges it grew to more than the solution."""
from judge import near, require

PRESSURE = 0.450005184


def judge(run):
    pair, estimates = run.pair("fit"), [mesh["estimate"] for mesh in run.summary["estimate"]["meshes"]]
    near("mean pressure", pair["mean_pressure"], PRESSURE, absolute=run.summary["bars"]["pairs"]["fit"]["mean_pressure"])
    near("mean pressure", pair["mean_pressure"], PRESSURE, relative=1e-2)
    require(all(after < before for before, after in zip(estimates, estimates[1:])), f"estimates {estimates}")
    require(pair["active_nodes"] == run.summary["estimate"]["meshes"][-1]["active"] > 60, f"{pair['active_nodes']} nodes in contact")
