from bars import judge as judge_bars


def judge(run):
    judge_bars(run, relative=1e-8)  # displacements of 0.01 in the stiff bar are known to 1e-18, and 1e-17 of strain is 1e-8 of stress
