"""The weights of options/stack.opts, with other moduli."""
import pathlib

from judge import load

WEIGHTS = load(pathlib.Path(__file__).resolve().parent.parent / "weights.py")


def judge(run):
    WEIGHTS(run)
    WEIGHTS(run.again("-order", "2", name="quadratic"))
