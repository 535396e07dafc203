"""A tie whose nodes are all held by supports still holds in its free directions: two springs of uniaxial strain in a row."""
from judge import near


def stiff(young, poisson):
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def judge(run):
    force = 0.01 / (1 / stiff(1000, 0.3) + 0.5 / stiff(300, 0.2))
    vertices = ["-order", "2", "-tie_multipliers", "vertices"]
    variants = {"as it is": [], "wider": ["-upper_dm_plex_box_faces", "2,1,2"], "vertices": vertices, "multigrid": ["-pc_type", "truncatedmg"]}
    for name, options in run.some(variants.items()):
        near(f"force, {name}", run.again(*options, name=name.split()[0]).pair("tie")["force"], [0, 0, -force], relative=1e-8, absolute=1e-8)
