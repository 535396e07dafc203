from bars import judge as judge_bars


def judge(run):
    judge_bars(run, relative=1e-9)  # stiffness along and across the cells is in the ratio of 1e6
