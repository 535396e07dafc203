#!/usr/bin/env python3
"""unset.py -- scenes that are set up wrong: none ends with exit code 0 and no warning.

    unset.py <program> <mpiexec> <ranks> <folder> <case>

A case is a file of options, cases/<case>.opts. Or it is a program that makes its meshes, cases/<case>.py, with options as the text
OPTIONS and a function make(folder). Its head says

    # wrong: what was meant, and what is wrong
    # ends: 1                         the exit code; with 0 the codes of all warnings of the run
    # says: words of the sentence     one line for each part of what stderr must have
    # ranks: 1 3                      without this line, one
"""
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from judge import Failure, Run, judge_mistake, require, same  # noqa: E402

HEAD = re.compile(r"^# (wrong|ends|says|ranks): (.*)$", re.MULTILINE)


def read_head(text):
    """{key: list of texts}, each key but `says` and `ranks` once."""
    head = {}
    for key, value in HEAD.findall(text):
        head.setdefault(key, []).append(value.strip())
    require(len(head.get("wrong", [])) == len(head.get("ends", [])) == 1, "the head of a case has one line 'wrong' and one line 'ends'")
    return head


def options_of(case, folder):
    """The arguments of the run; meshes and options of a program of a case are written into the folder."""
    if case.suffix == ".opts":
        return ["-options_file", str(case)]
    made = {"__name__": case.stem, "__file__": str(case)}
    exec(compile(case.read_text(encoding="utf-8"), str(case), "exec"), made)  # pylint: disable=exec-used
    made["make"](folder)
    (folder / "scene.opts").write_text(made["OPTIONS"], encoding="utf-8")
    return ["-options_file", str(folder / "scene.opts")]


def judge_end(run, head):
    """Exit code, warnings, words."""
    ends, *codes = head["ends"][0].split()
    says = head.get("says", [])
    if ends == "1":
        judge_mistake(run, says)
        return
    same("exit code", run.exit, int(ends))
    run.require_clean()
    if ends == "0":
        require(codes, "a case that ends with exit code 0 names the codes of its warnings")
        found = {warning["code"] for warning in run.summary["warnings"]}
        require(set(codes) == found, f"warnings {sorted(found)} instead of {codes}")
    require("mortise: " in run.stderr, "stderr says nothing")
    for words in says:
        require(words in run.stderr, f"nothing says '{words}'")


def main():
    program, mpiexec, ranks, scratch, case = sys.argv[1:]
    folder, case, run = pathlib.Path(scratch), pathlib.Path(case), None
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "input").mkdir(parents=True)
    try:
        head = read_head(case.read_text(encoding="utf-8"))
        run = Run(program, mpiexec, int(ranks), folder / "run", options_of(case, folder / "input"))
        judge_end(run, head)
    except (Failure, subprocess.TimeoutExpired) as failure:
        sys.exit(f"{failure}\n{run.describe() if run else ''}")


if __name__ == "__main__":
    main()
