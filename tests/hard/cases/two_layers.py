from twins import judge_twin


def judge(run):
    judge_twin(run, run.again("-joint_mortar", "lower:top", name="one_layer"))
