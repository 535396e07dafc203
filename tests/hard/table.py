#!/usr/bin/env python3
"""table.py [<build folder>] -- the table of cases in README.md: checks that it lists all cases in the words of their files. Given the
folder of a build whose hard.* tests have run, it writes the table anew with their figures."""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from cases import read_head, worst  # noqa: E402  pylint: disable=wrong-import-position

BEGIN, END = "<!-- cases: written by table.py -->\n", "<!-- end of cases -->\n"
TITLE = "| case | difficulty | required result (source) | found |\n|---|---|---|---|\n"
ENDS = {"1": "exit code 1", "3": "exit code 3"}
VERDICTS = {"solvable": "", "free_motion": "; free motion", "marginal": "; warning", "no_solution": "no solution"}


def words(path):
    head = read_head(path)
    return f"| `{path.stem}` | {head['hard']} | {head['must']} ({head['whence']}) |"


def figures(path, build, old):
    """Steps of both solvers, their difference, the largest number of the certificate, and the verdict, of the run on the fewest ranks. The
    previous entry if the case has not run in this build."""
    head = read_head(path)
    if head["exit"] in ENDS:
        return f" {ENDS[head['exit']]} |"
    ranks = head.get("ranks", "1").split()[0]
    result = build / f"tests/scratch/hard.{path.stem}.np{ranks}/{head.get('row', '.')}/result.json"
    if not result.exists():
        return next(row for row in old if row.startswith(words(path))).removeprefix(words(path))
    summary = json.loads(result.read_text(encoding="utf-8"))
    verdict = VERDICTS[summary["solvability"]["verdict"]]
    if head["exit"] == "2":
        return f" {verdict} |"
    check = summary["solver"]["cross_check"]
    return f" {summary['solver']['iterations']}, {check['iterations']}; {check['displacement_difference']:.0e}; {worst(summary):.0e}{verdict} |"


def main():
    readme = HERE / "README.md"
    cases = sorted((HERE / "cases").glob("*.opts"))
    before, rest = readme.read_text(encoding="utf-8").split(BEGIN)
    table, after = rest.split(END)
    rows = table.splitlines()[2:]
    if len(sys.argv) > 1:
        rows = [words(path) + figures(path, pathlib.Path(sys.argv[1]), rows) for path in cases]
        readme.write_text(before + BEGIN + TITLE + "".join(row + "\n" for row in rows) + END + after, encoding="utf-8")
        return
    wrong = [f"no row begins with {words(path)}" for path in cases if not any(row.startswith(words(path)) for row in rows)]
    wrong += [f"a row of no case: {row}" for row in rows if not any(row.startswith(words(path)) for path in cases)]
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
