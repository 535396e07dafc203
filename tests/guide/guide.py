#!/usr/bin/env python3
"""guide.py -- options/GUIDE.md compared with the program.

    guide.py options <mortise>             the chapter of options is what -help prints; with --write it is written anew
    guide.py summary <mortise> <folder>    every key of the summaries of some scenes is in the tables, and every key of the tables occurs
    guide.py commands <mortise> <folder> <part> <parts>   the files of the page are written into the folder, and the commands of each parts-th chapter run there
    guide.py python <mortise> <folder>     the same of the programs in Python, which print what the page says

Prints what is wrong, or nothing."""
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "tests"))
from judge import ALONE  # noqa: E402  pylint: disable=wrong-import-position

GUIDE = TOP / "options/GUIDE.md"
BEGIN, END = "<!-- options: written by tests/guide/guide.py -->\n", "<!-- options: end -->\n"


# --- options ----------------------------------------------------------------------------------------------------------

OPTION, UNIT = slice(2, 58), slice(59, 72)  # columns of -help, see src/scene/scenehelp.c
STANDARD = 73


def read_help(text):
    """The manual that -help prints: [(title, [(option, argument, unit, standard, purpose)])]."""
    lines, chapters = text.splitlines(), []
    for number, line in enumerate(lines):
        if number + 1 < len(lines) and line and set(lines[number + 1]) == {"-"}:
            chapters.append((line, []))
        elif line.startswith("  -") and chapters:
            below = lines[number + 1]
            long = not below[:58].strip()  # an option too long for its column has a line of its own
            left, right = (line.strip(), below) if long else (line[OPTION].strip(), line)
            name, _, argument = left.partition(" ")
            chapters[-1][1].append([name, argument, right[UNIT].strip(), right[STANDARD:].strip(), ""])
        elif line.startswith(6 * " ") and line[:58].strip() and chapters:
            entry = chapters[-1][1][-1]
            entry[4] = f"{entry[4]} {line.strip()}".strip()
    return chapters


def render_options(chapters):
    """The chapter of the guide, in Markdown; names of options and of what a user names are code."""
    rows, code = [], re.compile(r"(?<![\w`])(-\w*<?[a-z]\S*[\w>*]|<\w+>\S*\w)")
    for title, entries in chapters:
        rows += [f"### {title}", "", "| option | value | unit | without it | purpose |", "|---|---|---|---|---|"]
        for name, argument, unit, standard, purpose in entries:
            cells = [f"`{name}`", f"`{argument}`" if argument else "", unit, code.sub(r"`\1`", standard), code.sub(r"`\1`", purpose)]
            rows.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        rows.append("")
    return "\n".join(rows)


def check_options(program, write):
    text = subprocess.run([program, "-help"], capture_output=True, text=True, check=True).stdout
    wanted = render_options(read_help(text))
    before, _, rest = GUIDE.read_text().partition(BEGIN)
    found, _, after = rest.partition(END)
    if write:
        GUIDE.write_text(before + BEGIN + wanted + END + after)
    elif found != wanted:
        yield "the options of options/GUIDE.md are not those of mortise -help; write them anew by: python3 tests/guide/guide.py options <mortise> --write"


# --- summary ----------------------------------------------------------------------------------------------------------

# Scenes whose summaries have every key between them.
SCENES = {
    "solved": ["-options_file", "options/manufactured_full.opts", "-cross_check", "-measure_linear", "-probes", "p", "-probe_p_body", "upper",
               "-probe_p_at", "0.5,0.5"],
    "stopped": ["-options_file", "options/two_plates.opts", "-pc_type", "truncatedmg", "-dm_refine", "1", "-stop", "discretisation", "-infsup"],
    "refused": ["-options_file", "options/overhang.opts", "-block_bc_traction", "left", "-block_bc_traction_left", "0.1,0"],
    "floating": ["-options_file", "options/stack.opts", "-units", "mm,N,MPa,K"],
    "checked": ["-options_file", "options/two_plates.opts", "-check"],
    "regions": ["-options_file", "options/lined_hub.opts"],
    "flanks": ["-options_file", "options/gears.opts"],
    "pieces": ["-options_file", "tests/hard/pieces.opts"],
    "tightened": ["-options_file", "tests/regression/bolt_springs.opts"],
    "slipping": ["-options_file", "options/incline.opts"],
    "pulled": ["-options_file", "tests/hard/pieces.opts", "-lids_body_force", "0,1"],
    "jump": ["-options_file", "tests/hard/chamfer.opts", "-warnings_accept", "gap_jump"],
    "large": ["-options_file", "options/two_plates.opts", "-upper_young", "1e3", "-upper_dm_plex_box_faces", "4,4", "-lower_dm_plex_box_faces", "3,3"],
    "study": ["-options_file", "options/manufactured_full.opts", "-study", "uniform", "-study_levels", "3", "-upper_dm_plex_box_faces", "4,4",
              "-lower_dm_plex_box_faces", "3,3", "-probes", "p", "-probe_p_body", "upper", "-probe_p_at", "0.5,0.5"],
    "steps": ["-options_file", "options/two_plates.opts", "-upper_young", "1e3", "-upper_dm_plex_box_faces", "4,4", "-lower_dm_plex_box_faces", "3,3", "-load_steps", "2"],
    "slipping steps": ["-options_file", "options/incline.opts", "-load_steps", "2"],
    "halved steps": ["-options_file", "options/greco.opts", "-block_dm_plex_box_faces", "4,4", "-load_steps", "1", "-load_steps_halved", "1", "-probes", "p",
                     "-probe_p_body", "block", "-probe_p_at", "0.02,0.02"],
    "adapted": ["-options_file", "options/two_plates.opts", "-upper_dm_plex_box_faces", "2,2", "-lower_dm_plex_box_faces", "2,2", "-adapt", "1e-2", "-adapt_goal", "force:joint"],
    "adapted friction": ["-options_file", "options/incline.opts", "-adapt", "3e-2"],
    "adapted steps": ["-options_file", "options/two_plates.opts", "-upper_dm_plex_box_faces", "2,2", "-lower_dm_plex_box_faces", "2,2", "-adapt", "5e-2",
                      "-adapt_goal", "force:joint", "-adapt_goal_tolerance", "5e-2", "-load_steps", "2"],
    "compared": ["-options_file", "options/rings.opts", "-study", "uniform", "-study_levels", "3", "-outer_dm_plex_box_faces", "3,5",
                 "-inner_dm_plex_box_faces", "2,4"],
}
ERRORS = r"(?:.+_)?(?:energy|l2|pressure_l2|pressure_weighted)_error"


def documented_keys():
    """Keys of the tables of the chapter Summary, as they stand there."""
    chapter = GUIDE.read_text().split("\n## Summary\n")[1].split("\n## ")[0]
    return [key for cell in re.findall(r"^\| (`.*?) \|", chapter, re.MULTILINE) for key in re.findall(r"`([^`]+)`", cell)]


def key_pattern(key, scene):
    """A documented key as one pattern for each step of a path."""
    names = {"<axis>": "[xyz]", "<order>": r"\d+", "<error>": ERRORS}
    for kind, found in (("<body>", scene["bodies"]), ("<pair>", scene["pairs"]), ("<probe>", scene["probes"])):
        names[kind] = "|".join(map(re.escape, found)) or "(?!)"
    return [re.compile("".join(f"(?:{names.get(part, '.+')})" if part.startswith("<") else re.escape(part) for part in re.split(r"(<\w+>)", step)))
            for step in key.split(".")]


def walk(value, path=()):
    """Paths of all that is no object; the objects of a list are one step, with [] behind its name."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from walk(inner, path + (key,))
    elif isinstance(value, list) and any(isinstance(item, dict) for item in value):
        for item in value:
            yield from walk(item, path[:-1] + (path[-1] + "[]",))
    elif value != []:
        yield path


def check_summary(program, folder):
    keys, seen = documented_keys(), set()
    for name, arguments in SCENES.items():
        done = subprocess.run([program, *arguments, "-quiet", "-summary", folder / f"{name}.json"], cwd=TOP, env=os.environ | ALONE, capture_output=True, text=True,
                              check=False)
        if not (folder / f"{name}.json").is_file():
            yield f"{name}: no summary, exit code {done.returncode}: {done.stderr}"
            continue
        summary = json.loads((folder / f"{name}.json").read_text())
        scene = {"bodies": summary["scene"]["bodies"], "pairs": summary["scene"]["pairs"], "probes": summary["probes"]}
        patterns = [(key, key_pattern(key, scene)) for key in keys]
        for path in sorted(set(walk(summary))):
            fits = [key for key, pattern in patterns if len(pattern) == len(path) and all(p.fullmatch(step) for p, step in zip(pattern, path))]
            seen.update(fits)
            if not fits:
                yield f"{name}: the summary has {'.'.join(path)}, which options/GUIDE.md does not have"
    yield from (f"options/GUIDE.md has {key}, which no summary has" for key in keys if key not in seen)


# --- commands ---------------------------------------------------------------------------------------------------------

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$\n*((?:^    [^\n]*\n)*)", re.MULTILINE | re.DOTALL)  # language, text, what is said below it
VARIES = re.compile(r"[\d.]+ s;|[\d.]+ +\d+ MB$|by \d\.\de-1\d$")  # seconds, memory, roundoff
FILE = re.compile(r'(?:# |// |""")(\w+\.\w+): ')  # the first line of a block that is a file


def lines_of(text):
    """Lines without what varies from run to run, and without their indentation."""
    return [" ".join(VARIES.sub("", line).split()) for line in text.splitlines()]


def check_commands(program, folder, part=0, parts=1, python=False):
    """Without Gmsh a chapter ends where it is first called. [in] python - run the programs in Python, else all others"""
    environment = os.environ | ({} if python else ALONE) | {"PATH": f"{pathlib.Path(program).resolve().parent}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": str(TOP / "src/python"),
                                "PYTHONDONTWRITEBYTECODE": "1"}
    (folder / "options").symlink_to(TOP / "options")
    chapters = [BLOCK.findall(chapter) for chapter in GUIDE.read_text().split("\n## ")]
    for language, block, _ in sum(chapters, []):
        if language != "sh" and FILE.match(block):
            (folder / FILE.match(block).group(1)).write_text(block)
    for blocks in [blocks for blocks in chapters if any(language == "sh" for language, _, _ in blocks)][part::parts]:
        for _, block, said in (found for found in blocks if found[0] == "sh"):
            printed = ["..."]
            if block.startswith("gmsh ") and not shutil.which("gmsh"):
                break
            for line in block.splitlines():
                command, _, remark = line.partition("  # ")
                if command.startswith("python3 ") != python:
                    continue
                wanted = int(remark.rpartition(" ")[2] or 0) if remark.startswith("exit code") else 0
                called = re.sub("^python3 ", f"{sys.executable} ", command)  # that of the test has numpy
                done = subprocess.run(called, shell=True, cwd=folder, env=environment, capture_output=True, text=True, check=False)
                if done.returncode != wanted:
                    yield f"exit code {done.returncode}, not {wanted}: {command}\n{done.stdout}{done.stderr}"
                elif python and done.stdout != textwrap.dedent(said):
                    yield f"{command} prints\n{done.stdout}and not, as the page says,\n{said}"
                printed += lines_of(done.stdout + done.stderr)
            if printed[1:]:
                yield from (f"{block}does not print, as the page says,\n{line}" for line in lines_of(said) if line not in printed)


def main():
    what, program = sys.argv[1:3]
    if what == "options":
        wrong = list(check_options(program, "--write" in sys.argv))
    else:
        folder = pathlib.Path(sys.argv[3]).resolve()
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        checks = {"summary": check_summary, "commands": check_commands, "python": functools.partial(check_commands, python=True)}
        wrong = list(checks[what](program, folder, *map(int, sys.argv[4:])))
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
