"""scatter.py and scatter_space.py with nearly incompressible bodies, where their cells are fit for that."""
import scatter
import scatter_space

SPACE = 6  # of twelve scenes those from here on are solids
# Of the digits of the other scenes those are missing that a bulk modulus of up to 5000 shear moduli takes.
BULK = 100


def options_of(number):
    solid = number % scatter.COUNT >= SPACE
    options = (scatter_space if solid else scatter).options_of(number)
    if not solid:
        options["model"] = "plane_strain"
    for place, body in enumerate(options["bodies"].split(",")):
        simplex, order = options[f"{body}_dm_plex_simplex"] == "1", options[f"{body}_order"]
        fit = not simplex or (order == "2" and not solid)
        if fit and f"{body}_poisson" in options:
            options[f"{body}_poisson"] = ("0.4999", "0.47", "0.499")[(number + place) % 3]
    return options


def judge(run):
    scatter.judge(run, options_of, lambda options: BULK * max(scatter_space.RELATIVE, scatter.tolerance_of(options)), every=2)
