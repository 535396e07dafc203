"""The same where unknowns are coupled strongly along lines or across contact: smoothers keep such couplings together on each rank alone, so that
ranks which cut them take more iterations, here up to half as many again (Known issues in src/CHANGES.md)."""
import multigrid

MORE = 0.6


def judge(run):
    multigrid.judge(run, MORE)
