"""flatness.py -- inf-sup numbers of runs on a sequence of meshes."""
from judge import near, require


def number(run, pair):
    """beta of a pair, printed and in the summary."""
    beta = run.pair(pair)["inf_sup"]["number"]
    require(f"inf-sup number {beta:.4g}" in run.stdout, "the number is not printed")
    return beta


def numbers(run, pair, levels, *arguments):
    """beta on the scene's mesh and its uniform refinements."""
    name = "".join(word for word in "_".join(map(str, arguments)) if word.isalnum() or word == "_")
    return [number(run.again(*arguments, "-dm_refine", str(level), name=f"{name}_{level}"), pair) for level in range(levels)]


def require_flat(what, betas, within):
    """The largest over the smallest number."""
    require(max(betas) <= (1 + within) * min(betas), f"{what}: inf-sup numbers {betas} are not within {within:g}")
    near(f"{what}, the last two numbers", betas[-1], betas[-2], relative=within / 2)
