"""A block pushed over a floor by its own side: all of its weight rubs, in one step or three. If supports move all of the nodes, friction is lost, and told."""
from judge import near, require, same


def rubs(run):
    pair = run.summary["pairs"]["floor"]
    near("friction", pair["tangential_force"][0], -0.3 * pair["normal_force"], relative=2e-4)  # in space some of it acts across
    near("extent", pair["extent"]["lower"][0], 0.0, absolute=1e-12)


def judge(run):
    dim = len(run.summary["pairs"]["floor"]["force"])
    rubs(run)
    later = run.again("-load_steps", "1,1.5,2", "-block_bc_displacement_left", "1e-2*max(t-1,0),free" + ",free" * (dim - 2), name="later", warns=set())
    rubs(later)
    balances = [step["energy"]["balance"] for step in later.summary["steps"][1:]]  # nodes with multipliers are those of all steps
    require(all(balance["work"] is not None for balance in balances), "a step has no energy balance")
    near("defect", balances[-1]["defect"], 0.0, absolute=1e-3 * balances[-1]["dissipation"])  # it slides all the time
    rubs(run.again("-order", "2", name="quadratic", warns=set()))
    if dim == 2:
        run.again("-block_bc_displacement_left", "0,free", name="still", warns=set())
        dragged = run.again("-block_bc_displacement", "left,bottom", "-block_bc_displacement_bottom", "1e-2,free", name="dragged", warns={"held_friction"})
        (warning,) = dragged.summary["warnings"]
        same("at", [warning["pair"], warning["at"]], ["floor", [0, 0]])
        require("at 7 nodes in" in warning["text"] and "100 % of its area" in warning["text"], warning["text"])
