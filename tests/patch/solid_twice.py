"""Both solvers."""
from solid import column


def judge(run):
    column(run)
    column(run.again("-snes_type", "vinewtonrsls"))
