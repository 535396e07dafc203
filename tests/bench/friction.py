#!/usr/bin/env python3
"""friction.py <mortise> [test ...] -- closed forms and independent numbers of friction: asked and got.

The checks are those of tests/friction, with the scenes and arguments of friction.cmake. Each comparison is a line: the number that is asked for, the one that the program has,
and what the test allows; of a list the one that is farthest off. It goes on after one that is off, and marks it.
"""
import pathlib
import re
import shlex
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TESTS))
import judge  # noqa: E402 pylint: disable=wrong-import-position

ASKED = ("incline", "incline_solid", "patch", "patch_solid", "one_node", "cattaneo", "mindlin", "flat_punch", "sliding_punch", "round_punch", "greco", "graded", "jaeger", "belt", "arch",
         "keystone", "pull_off", "masing", "disc", "locked", "strip", "clutch", "leaning", "logs", "crawl", "tresca", "third_solver")


def declared(name):
    """Scene and arguments of a test."""
    text = (TESTS / "friction" / "friction.cmake").read_text()
    words = shlex.split(re.search(rf"^mortise_scene_test\({name} (.*?)\)\n(?=mortise|#|\n)", text, re.MULTILINE | re.DOTALL)[1])
    scene = words[words.index("SCENE") + 1] if "SCENE" in words else name
    folder = TESTS / "friction" if (TESTS / "friction" / f"{scene}.opts").is_file() else TESTS.parent / "options"
    arguments = words[words.index("ARGS") + 1:] if "ARGS" in words else []
    return ["-options_file", str(folder / f"{scene}.opts"), *arguments], "OWN_RUNS" in words, words[words.index("CHECK") + 1]


def show(what, value, expected, relative=0.0, absolute=0.0):
    """In place of judge.near()."""
    values, targets = judge.as_list(value), judge.as_list(expected)
    allowed = absolute + relative * max(map(abs, targets), default=0)
    off, got, asked = max(((abs(v - t), v, t) for v, t in zip(values, targets)), default=(0, 0, 0))
    print(f"| {what} | {asked:.7g} | {got:.7g} | {off:.1e} of {allowed:.1e}{'' if off <= allowed else ' **off**'} |", flush=True)


def main():
    program, names = sys.argv[1], sys.argv[2:] or ASKED
    judge.near = show
    print("| comparison | asked | got | off by |\n|---|---:|---:|---:|")
    for name in names:
        arguments, own, check = declared(name)
        print(f"| **{name}** | | | |", flush=True)
        with tempfile.TemporaryDirectory() as folder:
            run = judge.Run(str(pathlib.Path(program).resolve()), "mpiexec", 1, pathlib.Path(folder) / name, arguments, own)
            try:
                judge.EXPECTED.codes = {"large_friction", "not_unique", "coarse_contact", "model_limit", "free_motion", "edge_pressure", "solver_replaced"}
                judge.load(TESTS / "friction" / check)(run)
            except judge.Failure as failure:
                print(f"| **{name} fails** | | | {str(failure).splitlines()[0]} |", flush=True)


if __name__ == "__main__":
    main()
