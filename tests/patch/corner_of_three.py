"""A block in a corner, held by contact alone: hexahedra and tetrahedra of both orders, either solver."""
from hydrostatic import hydrostatic
from judge import near, same


def judged(run, tolerance=1e-11):
    hydrostatic(run, tolerance)
    touching = [sorted(zip(run.table(pair)["x"], run.table(pair)["y"], run.table(pair)["z"])) for pair in run.summary["pairs"]]
    for nodes in touching:
        same("nodes of a pair in the corner", sum(max(map(abs, node)) < 1e-9 for node in nodes), 1)
    near("complementarity", run.summary["solver"]["kkt"]["complementarity"], 0, absolute=1e-12)


def judge(run):
    judged(run)
    judged(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"))
    judged(run.again("-block_dm_plex_simplex", "1", "-west_dm_plex_simplex", "1", name="tetrahedra"))
    judged(run.again("-order", "2", "-west_dm_plex_simplex", "1", name="quadratic"))
