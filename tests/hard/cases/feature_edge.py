from twins import judge_twin


def judge(run):
    judge_twin(run, run.again("-joint_nonmortar", "upper:bottom", name="one_face"))
