"""How the program starts MPI: no daemon for a process without a launcher, no setting of a user or library overridden, no MPI for words.

OPAL_BINDIR leads Open MPI to a folder without its daemon. A message layer that does not exist ends MPI_Init(). hwloc tells what it asks for cards.
"""
import argparse
import os
import re
import subprocess

# Of this machine, that say how MPI starts.
VARIABLES = ("OMPI_MCA_ess_singleton_isolated", "OMPI_MCA_orte_create_session_dirs", "OMPI_MCA_pml", "HWLOC_COMPONENTS", "HWLOC_PLUGINS_PATH")
CARDS = {"pci", "opencl", "gl"}  # components of hwloc


def ends(arguments, **variables):
    """Exit code of a command with further environment variables, and without VARIABLES."""
    return subprocess.run(arguments, env={**bare(), **variables}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode


def bare():
    return {name: value for name, value in os.environ.items() if name not in VARIABLES}


def asks_for_cards(arguments, **variables):
    """Whether hwloc uses one of the components that look for cards and displays."""
    told = subprocess.run(arguments, env={**bare(), "HWLOC_COMPONENTS_VERBOSE": "1", **variables}, capture_output=True, text=True).stderr
    lists = re.findall("enabled discovery components: (.*)", told)
    return any(entry.split("(")[0] in CARDS for line in lists for entry in line.split(","))


def check(what, holds):
    if not holds:
        raise SystemExit(f"start: {what}: no")
    print(f"{what}: yes")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("library_program", nargs="+", help="a program of the library and its arguments")
    given = parser.parse_args()
    solve = [given.program, "-options_file", given.scene, "-skip_petscrc", "-quiet"]
    nowhere, no_layer = {"OPAL_BINDIR": "/nowhere"}, {"OMPI_MCA_pml": "none_such"}

    for words in "-version", "-help", "-h":
        check(f"{words} starts no MPI", ends([given.program, words], **no_layer) == 0)
    versions = subprocess.run([given.program, "-version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    check("a scene is solved", ends(solve) == 0)
    if "Open MPI v4" not in versions:
        return
    check("a scene starts no daemon", ends(solve, **nowhere) == 0)
    check("a scene makes no folder that other processes share", ends(solve, TMPDIR="/dev/null/none") == 0)
    check("a message layer that the user names is asked for", ends(solve, **no_layer) != 0)
    check("a user who asks for the daemon has it", ends(solve, OMPI_MCA_ess_singleton_isolated="0", **nowhere) != 0)
    check("a scene asks for no cards and displays", not asks_for_cards(solve))
    check("a user who asks for them has them", asks_for_cards(solve, HWLOC_COMPONENTS="pci"))
    check("under a launcher nothing is set", ends(solve, MV2_COMM_WORLD_SIZE="1", **nowhere) != 0)
    check("a program of the library has Open MPI as it is", ends(given.library_program, **nowhere) != 0)


if __name__ == "__main__":
    main()
