"""scatter.py in space: hexahedra and tetrahedra of both orders on each other, turned anyhow, cover in part, gaps given, ties.

Facets are triangles, or parallelograms, and so are the shadows that they throw on each other: all integrals are exact.
"""
import math
import random

import scatter

# Nodes that are covered a little - products of shares along two edges - have their pressure from small integrals: 7e-10 was found.
RELATIVE = 1e-9
STIFFNESS = "3000,1000,1200,0,50,0,2500,900,0,0,-40,2800,30,0,0,1000,0,20,800,0,1200"


def turned(forms, angles):
    """A map followed by rotations about z and x, as texts, and the rotation."""
    (c, s), (d, e) = ((math.cos(a), math.sin(a)) for a in angles)
    R = [[c, -s, 0.0], [d * s, d * c, -e], [e * s, e * c, d]]
    return ", ".join("+".join(f"({r!r})*({form})" for r, form in zip(row, forms)) for row in R), R


def vector(R, v):
    """R v as text."""
    return ",".join(repr(sum(r * x for r, x in zip(row, v))) for row in R)


def options_of(number):
    """One box on another as {option: text}."""
    source = random.Random(number)
    pick, integer = source.choice, source.randint
    order, simplex = ({body: pick(texts) for body in ("upper", "lower")} for texts in ("112", "01"))
    tets, plain = set(simplex.values()) == {"1"}, set(order.values()) == {"1"}
    forms = {body: ["x", "y", "z"] for body in order}
    if plain:  # cells that are not alike; what is bent is bent alike, so that it stays one surface for both
        forms["upper"][0], forms["lower"][1] = pick(["x", "x+0.1*x*(1-x)"]), pick(["y", "y-0.2*y*(1-y)"])
    if plain and tets and pick([True, False]):
        for body, bend in zip(forms, ("(1-z)", "(1+z)")):
            forms[body][2] = f"z-0.15*((x-0.4)^2+0.5*x*y)*{bend}"
    elif pick([True, False]):
        forms["lower"][0] = "x+0.2*(y-0.5)"
    angles = pick([(0.0, 0.0), (0.7, 0.4), (-0.3, 2.1)])
    options = {"bodies": "upper,lower", "model": "solid", "pairs": "joint", "joint_reach": "1",
               "lower_dm_plex_box_lower": pick(["0,0,-1", "0.13,0,-1", "-0.2,-0.1,-1", "0.26,0.31,-1"]),
               "lower_dm_plex_box_upper": pick(["1,1,0", "0.87,1,0", "1.2,1.1,0", "0.77,0.73,0"])}
    for body in order:
        options[f"{body}_polygonal"] = "1"  # space.py has straight facets only
        most = 4 - int(order[body]) - int(simplex[body])
        options |= {f"{body}_dm_plex_box_faces": f"{integer(1, most + 1)},{integer(1, most)},{integer(1, 2)}", f"{body}_order": order[body],
                    f"{body}_dm_plex_simplex": simplex[body]}
        options |= {f"{body}_stiffness": STIFFNESS, f"{body}_material_angle": "30,40,-20"} if pick("000000a") == "a" else {
            f"{body}_young": pick(["200", "1000", "3000"]), f"{body}_poisson": pick(["0", "0.25", "0.3"])}
        options[f"{body}_map"], R = turned(forms[body], angles)
    options |= {"upper_bc_displacement": "top", "upper_bc_displacement_top": vector(R, pick([(0.01, -0.005, -0.02), (0, 0, -0.01), (0.003, 0, -0.04)])),
                "lower_bc_displacement": "bottom", "lower_bc_displacement_bottom": "0,0,0"}
    if pick([True, False]):
        options |= {"upper_bc_traction": "right", "upper_bc_traction_right": vector(R, (2, 5, -20)), "lower_body_force": "3,-10,4",
                    "lower_bc_pressure": "back", "lower_bc_pressure_back": "3"}
    sides = ["upper:bottom", "lower:top"]
    source.shuffle(sides)
    options |= {"joint_nonmortar": sides[0], "joint_mortar": sides[1], "joint_type": pick(["contact", "contact", "contact", "tied"])}
    if options["joint_type"] == "contact":
        options |= pick([{}, {}, {"joint_gap": "0.004*(x^2+y^2)"}, {"joint_gap_offset": "0.003"}])
    if order[sides[0].split(":")[0]] == "2":
        options["joint_multipliers"] = pick(["nodes", "nodes", "vertices"])
    return options


def judge(run):
    scatter.judge(run, options_of, lambda options: RELATIVE, every=4)
