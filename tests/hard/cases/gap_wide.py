from bars import judge as judge_bars


def judge(run):
    judge_bars(run, relative=1e-9)  # what is squeezed is 1e-5 of what moves
