"""A ball that contact alone holds: a factorization replaces an iteration that has cost a quarter."""
import re

from judge import near, require


def judge(run):
    said = re.search(r"cost (\d+) products .* factorization \(about (\d+)\)", run.stderr)
    require(said, f"no factorization: {run.stderr}")
    work, cost = map(int, said.groups())
    require(cost > 600 and work < 0.35 * cost, f"{work} products before a factorization that costs {cost}")
    near("force", run.pair("floor")["force"][2], 4.18879, relative=1e-4)  # statics; the volume of the mesh differs from the ball's
