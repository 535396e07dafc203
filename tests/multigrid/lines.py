"""The same where lines of strongly coupled unknowns run along the contact: smoothers follow them on each rank alone, so that ranks which cut
them take more iterations, here half as many again (Known issues in src/CHANGES.md)."""
import multigrid

MORE = 0.6


def judge(run):
    multigrid.judge(run, MORE)
