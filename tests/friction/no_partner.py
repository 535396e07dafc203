"""A pair with friction whose side faces nothing: solved as if there were no pair, and told, by a factorization and by multigrid. The program ended with a
segmentation fault, without the steps' summary."""
from judge import same


def judge(run):
    other = run.again("-pc_type", "truncatedmg", name="multigrid", warns=["no_partner"])
    for each in (run, other):
        same("friction and contact", [each.summary["solver"]["friction"], each.pair("joint")["area"]], [None, 0])
        same("warned of", [warning["code"] for warning in each.summary["warnings"]], ["no_partner"])
