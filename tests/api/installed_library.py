#!/usr/bin/env python3
"""installed_library.py -- what a prefix holds: names that the library shows, links of pages, and a user's program.

The program is built against the prefix by pkg-config or by CMake, in C or in C++. Its forces are those of statics and those that mortise
prints."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

CMAKE = """cmake_minimum_required(VERSION 3.21)
project(user LANGUAGES {language})
find_package(Mortise 0.2 REQUIRED)
add_executable(five_loads {source})
target_link_libraries(five_loads PRIVATE Mortise::mortise)
"""
LINE = re.compile(r"load (\S+) status (\d) force (\S+) (\S+) energy (\S+)")
FORCE = 1e6  # of options/patch2d.opts at t = 1: uniform pressure 1e6 on a side of length 1
TIGHT = 1e-8


def require(condition, sentence):
    if not condition:
        sys.exit(sentence)


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    require(done.returncode == 0, f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def check_symbols(arguments):
    """The shared library shows no name but those of mortise.h, and all of these."""
    library = next((arguments.prefix / arguments.libdir).glob("libmortise.so.*.*.*"), None)
    if library is None and (arguments.prefix / arguments.libdir / "libmortise.a").exists():
        return  # static: every name is in it
    require(library, "there is no library")
    shown = {line.split()[-1] for line in run(["nm", "-D", "--defined-only", library]).splitlines()}
    declared = set(re.findall(r"^MORTISE_PUBLIC PetscErrorCode (\w+)\(", (arguments.prefix / "include/mortise.h").read_text(), re.MULTILINE))
    require(shown == declared, f"shown and not declared: {sorted(shown - declared)}; declared and not shown: {sorted(declared - shown)}")


def check_files(arguments):
    """One header, man pages, no link of a page that leads nowhere, scenes that are not links."""
    prefix = arguments.prefix
    headers = [path.name for path in (prefix / "include").rglob("*.h")]
    require(headers == ["mortise.h"], f"headers: {headers}")
    for name in ("mortise", "mortise-plot", "mortise-report"):
        page = (prefix / f"share/man/man1/{name}.1").read_text()
        require(page.startswith(".TH MORTISE"), f"{name}.1 is no man page")
    require("bc_traction" in (prefix / "share/man/man1/mortise.1").read_text(), "mortise.1 has no options")
    for page in prefix.rglob("*.md"):
        text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
            if not re.match(r"[a-z]+:", target):
                require((page.parent / target).exists(), f"{page.relative_to(prefix)}: {target} does not exist")
    require((prefix / "share/mortise/options/two_plates.opts").is_file(), "there are no scenes")


def build(arguments, how, language):
    """The user's program, against the prefix alone."""
    folder, libdir = arguments.scratch, arguments.prefix / arguments.libdir
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    source = folder / ("five_loads.c" if language == "c" else "five_loads.cpp")
    source.write_text((pathlib.Path(__file__).parent / "five_loads.c").read_text())
    if how == "pkgconfig":
        environment = dict(os.environ, PKG_CONFIG_PATH=f"{libdir}/pkgconfig:{os.environ.get('PKG_CONFIG_PATH', '')}")
        flags = run(["pkg-config", "--cflags", "--libs", "mortise"], env=environment).split()
        compiler = "mpicc" if language == "c" else "mpicxx"
        run([compiler, "-Wall", "-Wextra", "-Werror", source, "-o", folder / "five_loads", *flags, f"-Wl,-rpath,{libdir}"])
        return folder / "five_loads"
    (folder / "CMakeLists.txt").write_text(CMAKE.format(language=language.upper(), source=source.name))
    run([arguments.cmake, "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={arguments.prefix}"])
    run([arguments.cmake, "--build", folder / "build"])
    return folder / "build/five_loads"


def check_program(arguments, how, language):
    program, scene = build(arguments, how, language), arguments.source / "options/patch2d.opts"
    own = json.loads(run([arguments.program, "-skip_petscrc", "-options_file", scene, "-summary", "-"]))
    for ranks in (1, 3):
        lines = LINE.findall(run([arguments.mpiexec, "-n", ranks, program, "-skip_petscrc", "-options_file", scene]))
        require(len(lines) == 5, f"{len(lines)} loads")
        for load, status, x, y, energy in (map(float, line) for line in lines):
            require(status == 0, f"load {load} is not solved")
            require(abs(x) <= TIGHT * FORCE and abs(y - load * FORCE) <= TIGHT * FORCE, f"load {load}: force {x}, {y}")
            strain = load**2 * sum(own["energy"]["strain"].values())
            require(abs(energy - strain) <= TIGHT * strain, f"load {load}: energy {energy}, the program has {strain}")
        printed = own["pairs"]["joint"]["force"][1]
        require(abs(float(lines[-1][3]) - printed) <= TIGHT * FORCE, f"force {lines[-1][3]}, the program prints {printed}")
    wrong = subprocess.run([program, "-skip_petscrc", "-options_file", scene, "-upper_yuong", "1"], capture_output=True, text=True, check=False)
    require(wrong.returncode == 1 and wrong.stderr.startswith("five_loads: -upper_yuong") and wrong.stderr.count("\n") == 1, f"a mistake: {wrong}")


def check_guide(arguments):
    """The program of the guide, built and run by the commands of its page, prints what the page says."""
    page = (arguments.source / "options/GUIDE.md").read_text(encoding="utf-8")
    chapter = page.split("\n## Calling Mortise from C\n")[1].split("\n## ")[0]
    folder, libdir = arguments.scratch, arguments.prefix / arguments.libdir
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "loads.c").write_text(re.search(r"^```c\n(// loads.c: .*?)^```$", chapter, re.MULTILINE | re.DOTALL).group(1))
    (folder / "press.opts").write_text(re.search(r"^```\n(# press.opts: .*?)^```$", page, re.MULTILINE | re.DOTALL).group(1))
    commands = re.search(r"^```bash\n(.*?)^```$", chapter, re.MULTILINE | re.DOTALL).group(1)
    environment = dict(os.environ, PKG_CONFIG_PATH=f"{libdir}/pkgconfig:{os.environ.get('PKG_CONFIG_PATH', '')}", PETSC_OPTIONS="")
    printed = run(["bash", "-e", "-c", commands], cwd=folder, env=environment).splitlines()
    expected = re.findall(r"^    (.*)$", chapter.split("```bash")[1], re.MULTILINE)
    require(printed == expected, f"printed: {printed}, the page says: {expected}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what")
    for name in ("prefix", "source", "program", "scratch"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    for name in ("libdir", "mpiexec", "cmake"):
        parser.add_argument(f"--{name}")
    arguments = parser.parse_args()
    if arguments.what == "symbols":
        check_symbols(arguments)
    elif arguments.what == "files":
        check_files(arguments)
    elif arguments.what == "guide":
        check_guide(arguments)
    else:
        check_program(arguments, *arguments.what.split("_"))


if __name__ == "__main__":
    main()
