#!/usr/bin/env python3
"""adapted.py <mortise> <folder> <file.opts,file.opts> ... -- hard cases on adaptive meshes: each ends in seconds, with its own verdict. A sixth of
them, all in the long run.

An argument is the list of options files of a case, the last one its own. A tolerance that takes more than the few unknowns that are allowed here
ends with exit code 3 and the sentence that says so. What differs for a reason stands in EXCEPT and UNLIMITED."""
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from cases import read_head  # noqa: E402  pylint: disable=wrong-import-position
from judge import ALONE, LONG, Failure, require, same  # noqa: E402  pylint: disable=wrong-import-position

ADAPT = ["-skip_petscrc", "-adapt", "0.05", "-adapt_max_unknowns", "6000", "-quiet"]
LIMIT = "-adapt_max_unknowns allows 6e+03"
SECONDS = 60  # on a busy machine; else one each at most
# -adapt raises the order to 2, which these cannot have on triangles and tetrahedra: exit code, sentence. With -order 1 they are judged like others.
EXCEPT = {
    "ball_between_plates": (1, "degenerate or tangled cell of order 2 after its map"),  # the map of a cube is singular in its corners
    "punch_axisymmetric": (1, "degenerate or tangled cell of order 2 after its map"),  # cells graded by a square and a cube
    "slab_punch": (3, "the active set still changed after -snes_max_it iterations"),  # multipliers of order 2 on a side 1e6 times stiffer
}
# Nodes of both halves of the hole touch on finer meshes. The directions of their gaps meet in two points .02 apart, which holds the pin in linear theory.
FINER = {"pin_with_play": "solvable"}
# The couple of these links ends as a concentrated force at the ends of the tie (THEORY 5): the error stalls, and the warning says why.
UNLIMITED, STALLED, WHY = ["tie_across_gap"], "twice the unknowns have hardly lowered it", "the links exert concentrated forces"


def run(program, folder, files, more):
    """Exit code, stderr, summary."""
    output = folder / files[-1].stem
    arguments = [word for file in files for word in ("-options_file", file)]
    done = subprocess.run([program, *arguments, *ADAPT, *more, "-output", output], capture_output=True, text=True, timeout=SECONDS, check=False,
                          env=os.environ | ALONE)
    summary = output.with_suffix(".json")
    return done.returncode, done.stderr, json.loads(summary.read_text(encoding="utf-8")) if summary.exists() else {}


def judge(program, folder, files):
    case, head, more = files[-1].stem, read_head(files[-1]), []
    if case in EXCEPT:
        code, stderr, _ = run(program, folder, files, [])
        require(code == EXCEPT[case][0] and EXCEPT[case][1] in stderr, f"no longer ends with {EXCEPT[case]}: {code} {stderr}")
        more = ["-order", "1"]
    code, stderr, summary = run(program, folder, files, more)
    if code == 3 and head["exit"] == "0":
        require((STALLED if case in UNLIMITED else LIMIT) in stderr, f"not solved: {stderr}")
        require((case in UNLIMITED) == any(WHY in (warning["advice"] or "") for warning in summary["warnings"]), f"the reason: {summary['warnings']}")
    else:
        same("exit code", code, int(head["exit"]))
    if code != 1:
        same("verdict", summary["solvability"]["verdict"], FINER.get(case, head["verdict"]))
    if head["exit"] == "0":
        require(summary["solver"]["certified"], f"not certified: {stderr}")
        require(summary["estimate"]["meshes"] and (code == 3) == (summary["estimate"]["energy_norm_relative"] > 0.05), "the estimate is another verdict")


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    failed, cases = [], sys.argv[3:] if LONG else sys.argv[3::6]
    for argument in cases:
        files = [pathlib.Path(file) for file in argument.split(",")]
        try:
            judge(program, folder, files)
        except (Failure, subprocess.TimeoutExpired) as reason:
            failed.append(f"{files[-1].stem}: {reason}")
    print(f"{len(cases)} cases", *failed, sep="\n")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
