"""Random scenes of random_scenes.py: right forces or a refusal where statics has none. 300 of them in `check.sh long`.

In seed 139 a line search on the residual cycles, with vinewtonrsls."""
from judge import LONG, require
from random_scenes import survey


def judge(run):
    told = []
    survey(run, range(300) if LONG else (*range(9), 139), told.append)
    require(not told, "\n".join(told))
