#!/usr/bin/env python3
"""house.py -- checks of the text itself: house.py <floors|sizes|options|warnings> <top of the tree>. Prints what is wrong, or nothing."""
import pathlib
import re
import sys

MAX_FILE, MAX_FUNCTION, MAX_ARGUMENTS = 600, 80, 7
INCLUDE = re.compile(r'^#include [<"]([^">]+)[">]', re.MULTILINE)
PETSC_OWN = re.compile(r"-(skip_petscrc|options_file_yaml|dm_plex_gmsh_\w+)")  # set or passed on here, not ours to document
ROW = re.compile(r"^\| (\d+) \| `(\w+)` \| ([^|]*) \|", re.MULTILINE)


def sources(top):
    return sorted(top.glob("src/**/*.[ch]")) + sorted(top.glob("include/**/*.h"))


# --- floors -----------------------------------------------------------------------------------------------------------


def read_table(top):
    """The table of src/README.md: room -> floor, header -> room."""
    floor, room_of = {}, {}
    for number, room, headers in ROW.findall((top / "src/README.md").read_text()):
        floor[room] = int(number)
        room_of.update({header: room for header in re.findall(r"`(\w+)`", headers)})
    return floor, room_of


def read_includes(top):
    """The house's own includes: file -> files, as paths from the top."""
    graph = {}
    for path in sources(top):
        own = [top / "include" / name if name.startswith("mortise") else path.parent / name for name in INCLUDE.findall(path.read_text())]
        graph[str(path.relative_to(top))] = [str(file.relative_to(top)) for file in own if file.is_file()]
    return graph


def find_circle(graph):
    """A list of files each of which includes the next and the last the first, or None."""
    done, path = set(), []

    def visit(file):
        if file in path:
            return path[path.index(file):]
        if file in done:
            return None
        path.append(file)
        circle = next(filter(None, map(visit, graph.get(file, []))), None)
        path.pop()
        done.add(file)
        return circle

    return next(filter(None, map(visit, graph)), None)


def check_floors(top):
    floor, room_of = read_table(top)
    graph = read_includes(top)

    def room(file):
        parts = pathlib.PurePath(file).parts
        return parts[1] if parts[0] == "src" else room_of.get(pathlib.PurePath(file).stem)

    headers = {path.stem for path in top.glob("include/mortise/*.h")}
    yield from (f"include/mortise/{name}.h has no place in the table of src/README.md" for name in sorted(headers - set(room_of)))
    yield from (f"the table of src/README.md names {name}, which is not in include/mortise" for name in sorted(set(room_of) - headers))
    yield from (f"src/{path.name} is a room without a floor" for path in top.glob("src/*/") if path.name not in floor)
    for file, includes in graph.items():
        if file in ("src/main.c", "include/mortise.h"):
            continue  # the roof
        for other in includes:
            if floor.get(room(other), 0) > floor.get(room(file), 0):
                yield f"{file} ({room(file)}) includes {other} of the higher floor of {room(other)}"
            if other.startswith("src/") and room(other) != room(file):
                yield f"{file} includes {other}, which is private to another room"
    for name in sorted(headers & set(room_of)):
        said = re.search(r"\(floor (\d)", (top / f"include/mortise/{name}.h").read_text())
        if said and int(said.group(1)) != floor[room_of[name]]:
            yield f"include/mortise/{name}.h says floor {said.group(1)}, the table says {floor[room_of[name]]}"
    circle = find_circle(graph)
    if circle:
        yield "these include each other in a circle: " + " -> ".join(circle + circle[:1])


# --- sizes ------------------------------------------------------------------------------------------------------------


def count_arguments(signature):
    """Arguments of the function that a signature declares; commas within inner parentheses do not count."""
    inner = signature[signature.index("(") + 1:signature.rindex(")")]
    depth, count = 0, 1
    for letter in inner:
        depth += (letter == "(") - (letter == ")")
        count += letter == "," and depth == 0
    return count


def check_sizes(top):
    for path in sources(top):
        file, lines = path.relative_to(top), path.read_text().splitlines()
        if len(lines) > MAX_FILE:
            yield f"{file} has {len(lines)} lines, more than {MAX_FILE}: is it one idea?"
        begin = 0
        for number, line in enumerate(lines):
            if line == "{":
                begin = number
                first = max(n for n in range(number) if n == 0 or not lines[n - 1].strip() or lines[n - 1].endswith("*/") or lines[n - 1] == "}")
                signature = " ".join(lines[first:number])
                match = re.search(r"(\w+)\(", signature)
                if match and not match.group(1).endswith("Fn") and count_arguments(signature) > MAX_ARGUMENTS:
                    yield f"{file}:{number}: {match.group(1)}() has {count_arguments(signature)} arguments, more than {MAX_ARGUMENTS}"
            if line == "}" and begin and number - begin > MAX_FUNCTION:
                yield f"{file}:{begin + 1}: a function of {number - begin} lines, more than {MAX_FUNCTION}"


# --- options ----------------------------------------------------------------------------------------------------------


def check_options(top):
    table_file = top / "src/scene/table.c"
    groups = re.findall(r'\{(GROUP_\w+), "(-[^"]+)"', table_file.read_text())
    documented = {name for _, name in groups}
    patterns = [re.compile(re.escape(name).replace(r"\*", r"\w+")) for name in documented]
    read = set()
    for path in sources(top):
        if path != table_file:
            read.update((name, path.relative_to(top)) for name in re.findall(r'"(-[a-z<][a-z_<>]*)"', path.read_text()))
    for name, file in sorted(read):
        if not PETSC_OWN.fullmatch(name) and not any(pattern.fullmatch(name) for pattern in patterns):
            yield f"{file} reads {name}, which is not in {table_file.relative_to(top)}"
    for name in sorted({name for group, name in groups if group != "GROUP_PETSC"} - {name for name, _ in read}):
        yield f"{table_file.relative_to(top)} documents {name}, which nothing reads"


# --- warnings ---------------------------------------------------------------------------------------------------------


def check_warnings(top):
    """Codes of warnings are listed with what they mean, and all those that are listed exist."""
    table = (top / "options/README.md").read_text().split("\n## Warnings\n")[1].split("\n## ")[0]
    listed = set(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE))
    used = {code: path.relative_to(top) for path in sources(top) for code in re.findall(r'\.code\s*=\s*"(\w+)"', path.read_text()) if path.name != "warning.h"}
    yield from (f"{file} warns of {code}, which the table of options/README.md does not have" for code, file in sorted(used.items()) if code not in listed)
    yield from (f"the table of options/README.md has {code}, which nothing warns of" for code in sorted(listed - set(used)))
    yield from (f"{code} is not in snake_case" for code in sorted(used) if not re.fullmatch(r"[a-z]+(_[a-z]+)*", code))


def main():
    checks = {"floors": check_floors, "sizes": check_sizes, "options": check_options, "warnings": check_warnings}
    wrong = list(checks[sys.argv[1]](pathlib.Path(sys.argv[2]).resolve()))
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
