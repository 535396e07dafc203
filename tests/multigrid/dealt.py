"""Ranks may lose all blocks that they smoothed when the active set changes."""
from judge import near


def judge(run):
    other = run.again("-pc_type", "truncatedmg").summary
    near("energy", other["energy"]["potential"], run.summary["energy"]["potential"], relative=1e-9)
