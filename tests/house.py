#!/usr/bin/env python3
"""house.py -- checks of the text: house.py <layers|sizes|comments|contracts|options|warnings|tunables|theory|pages> <top of the tree>. Prints what is wrong, or nothing."""
import fnmatch
import pathlib
import re
import sys

MAX_FILE, MAX_FUNCTION, MAX_ARGUMENTS = 600, 80, 7
MAX_WORDS = 1000  # of the front page
MAX_LINE, MAX_COMMENT, MAX_CLAUSE = 132, 110, 25  # columns of a line, of one that is a comment alone; words between two marks of punctuation
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
PETSC_OWN = re.compile(r"-(skip_petscrc|no_signal_handler|options_file_yaml|dm_plex_gmsh_\w+)")  # set or passed on here, not ours to document
ROW = re.compile(r"^\| (\d+) \| `(\w+)` \| ([^|]*) \|", re.MULTILINE)


def sources(top):
    return sorted(top.glob("src/**/*.[ch]")) + sorted(top.glob("include/**/*.h"))


# --- layers -----------------------------------------------------------------------------------------------------------


def read_table(top):
    """The table of src/README.md: module -> layer, module -> names of its interface headers."""
    rows = ROW.findall((top / "src/README.md").read_text())
    return {module: int(layer) for layer, module, _ in rows}, {module: set(re.findall(r"`(\w+)`", headers)) for _, module, headers in rows}


def read_includes(top):
    """The project's own includes: file -> files, as paths from src."""
    return {str(path.relative_to(top / "src")): INCLUDE.findall(path.read_text()) for path in sorted(top.glob("src/*/*.[ch]"))}


def find_cycle(graph):
    """A list of files each of which includes the next and the last the first, or None."""
    done, path = set(), []

    def visit(file):
        if file in path:
            return path[path.index(file):]
        if file in done:
            return None
        path.append(file)
        cycle = next(filter(None, map(visit, graph.get(file, []))), None)
        path.pop()
        done.add(file)
        return cycle

    return next(filter(None, map(visit, graph)), None)


def strip_comments(text):
    """C without comments and strings."""
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:[^"\\\n]|\\.)*"', " ", text, flags=re.DOTALL)


def check_calls(top, layer):
    """No module uses a function that is defined in a higher layer, whoever declares it: else calls between modules could form a cycle. Helpers have names of their own."""
    texts = {path: strip_comments(path.read_text()) for path in sorted(top.glob("src/*/*.c"))}
    owner = {}
    for path, text in texts.items():
        for signature in re.findall(r"^(?!static\b)\w[^;{}()=#]*?\b(\w+)\([^;{}]*\)\s*\{$", text, re.MULTILINE):
            owner[signature] = path.parent.name
    helpers = {}
    for path, text in texts.items():
        for name in re.findall(r"^static\b[^;{}()=#]*?\b(\w+)\([^;{}]*\)\s*\{$", text, re.MULTILINE):
            if helpers.setdefault(name, path) != path:
                yield f"{path.relative_to(top)} and {helpers[name].relative_to(top)} have different functions {name}(): a profile cannot tell them apart"
    for path, text in texts.items():
        module = path.parent.name
        for name in sorted(set(re.findall(r"\b[A-Z]\w+", text)) & set(owner)):
            if layer.get(owner[name], 0) > layer.get(module, 0):
                yield f"{path.relative_to(top)} uses {name}() of {owner[name]}, a higher layer"


def check_layers(top):
    layer, interface = read_table(top)
    graph = read_includes(top)
    stems = {}
    for path in sorted(top.glob("src/*/")):
        if any(path.glob("*.c")) and path.name not in layer:
            yield f"src/{path.name} is not in the table of src/README.md"
    for module, headers in interface.items():
        yield from (f"the table of src/README.md names {name}, which is not in src/{module}"
                    for name in sorted(headers) if not (top / f"src/{module}/{name}.h").is_file())
    for file, includes in graph.items():
        module, stem = file.split("/")[0], pathlib.PurePath(file).stem
        stems.setdefault(stem, set()).add(module)
        for other in includes:
            if other not in graph:
                yield f'src/{file} includes "{other}", which is not in src'
                continue
            owner, name = other.split("/")[0], pathlib.PurePath(other).stem
            if layer.get(owner, 0) > layer.get(module, 0):
                yield f"src/{file} includes {other} of a higher layer"
            elif owner != module and name not in interface.get(owner, ()):
                yield f"src/{file} includes {other}, which is private to {owner}"
    yield from (f"{stem} is the name of files in {' and '.join(sorted(modules))}" for stem, modules in sorted(stems.items()) if len(modules) > 1)
    yield from check_calls(top, layer)
    cycle = find_cycle(graph)
    if cycle:
        yield "these include each other in a cycle: " + " -> ".join(cycle + cycle[:1])


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


# --- comments ---------------------------------------------------------------------------------------------------------


def read_comments(text):
    """Comments of C with their places; // on lines that follow each other are one."""
    comments = []
    for match in re.finditer(r'/\*.*?\*/|//[^\n]*|"(?:[^"\\\n]|\\.)*"', text, flags=re.DOTALL):
        begin, comment = match.start(), match.group()
        if comment.startswith('"'):
            continue
        if comments and comment.startswith("//") and comments[-1][1].startswith("//") and re.fullmatch(r" *\n *", text[comments[-1][2]:begin]):
            comments[-1] = (comments[-1][0], comments[-1][1] + "\n" + comment, match.end())
        else:
            comments.append((begin, comment, match.end()))
    return comments


def count_words(clause):
    """Words, without names and formulas."""
    return len(re.findall(r"(?<![\w_(.])[A-Za-z][a-z'-]*[a-z](?![\w_(])", clause))


def check_comments(top):
    """Lines end in time, and clauses of comments are short: a sentence has a mark of punctuation before its 26th word."""
    for path in sources(top):
        file, text = path.relative_to(top), path.read_text()
        alone = set()
        for begin, comment, _ in read_comments(text):
            number, head = text.count("\n", 0, begin) + 1, text[text.rfind("\n", 0, begin) + 1:begin]
            if not head.strip():
                alone.update(range(number, number + comment.count("\n") + 1))
            words = re.sub(r"\n[ */]*\n", ". ", comment.strip("/* "))  # a paragraph ends a sentence
            words = re.sub(r"\b(eqs?|e\.g|i\.e)\.", r"\1", re.sub(r"\n[ */]*", " ", re.sub(r"\[(in|out|in,out)\]", ". ", words)))
            for clause in re.split(r"[.?!;:][)\"]?(?:\s+|$)", words):
                if count_words(clause) > MAX_CLAUSE:
                    yield f"{file}:{number}: {count_words(clause)} words without a mark of punctuation, more than {MAX_CLAUSE}: {clause.strip()[:60]}..."
        for number, line in enumerate(text.splitlines(), 1):
            most = MAX_COMMENT if number in alone and not re.search(r"\*/ *\S", line) else MAX_LINE
            if len(line) > most:
                yield f"{file}:{number}: {len(line)} columns, more than {most}"


# --- contracts --------------------------------------------------------------------------------------------------------

NO_MPI = {"kernel"}  # modules whose functions are never collective
DECLARATION = re.compile(r"^PetscErrorCode +([A-Z]\w*)\(", re.MULTILINE)
CONTRACT = re.compile(r"ollective|irst rank")
FUNCTION = re.compile(r"\s*\n\w[^;{}()=#]*\([^;{}]*\)\s*([;{])")
PARAMETERS = re.compile(r"\[(in|out|in,out)\]\s+(\w+(?:,\s+\w+)*)\s+-")


def check_contracts(top):
    """A declared function that can fail says, or the head of its header does, whether it is collective; of Destroy() its Create() says so."""
    for path in sorted(top.glob("src/*/*.h")):
        text = path.read_text()
        comments = [(begin, comment) for begin, comment, _ in read_comments(text) if not text[text.rfind("\n", 0, begin) + 1:begin].strip()]
        if path.parent.name in NO_MPI or CONTRACT.search(comments[0][1]):
            continue
        for match in DECLARATION.finditer(text):
            above = [comment for begin, comment in comments if begin < match.start()][-1]
            if not CONTRACT.search(above) and not match.group(1).endswith("Destroy"):
                yield f"{path.relative_to(top)}: {match.group(1)}() does not say whether it is collective"
    for path in sources(top):
        yield from check_parameters(path.relative_to(top), path.read_text())


def check_parameters(file, text):
    """What a comment above a function says of a parameter has the name of one: of an output that of an argument or a member, of an input at least a name in the function."""
    for begin, comment, end in read_comments(text):
        match = FUNCTION.match(text, end)
        if not match or text[text.rfind("\n", 0, begin) + 1:begin].strip():
            continue
        block = text[end:(text + "\n}\n\n").index("\n}\n" if match.group(1) == "{" else "\n\n", end)]
        words = set(re.findall(r"\w+", strip_comments(block)))
        arguments = set(re.findall(r"\w+", block[:match.end() - end] if match.group(1) == "{" else block)) | set(re.findall(r"->(\w+)", block))
        for kind, names in PARAMETERS.findall(comment):
            for name in re.split(r",\s+", names):
                if name not in (words if kind == "in" else arguments):
                    yield f"{file}:{text.count(chr(10), 0, begin) + 1}: [{kind}] {name} is no parameter"


# --- options ----------------------------------------------------------------------------------------------------------


def check_options(top):
    table_file = top / "src/scene/optiontable.c"
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
    table = (top / "options/GUIDE.md").read_text().split("\n## Warnings\n")[1].split("\n## ")[0]
    listed = set(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE))
    used = {code: path.relative_to(top) for path in sources(top) for code in re.findall(r'\.code\s*=\s*"(\w+)"', path.read_text()) if path.name != "warning.h"}
    yield from (f"{file} warns of {code}, which the table of options/GUIDE.md does not have" for code, file in sorted(used.items()) if code not in listed)
    yield from (f"the table of options/GUIDE.md has {code}, which nothing warns of" for code in sorted(listed - set(used)))
    accepted = set(re.findall(r'"(\w+)"', (top / "src/base/warning.c").read_text().split(" CODES[] = {")[1].split("};")[0]))
    yield from (f"-warnings_accept refuses {code}, which is not among CODES of src/base/warning.c" for code in sorted(set(used) - accepted))
    yield from (f"CODES of src/base/warning.c have {code}, which nothing warns of" for code in sorted(accepted - set(used)))
    yield from (f"{code} is not in snake_case" for code in sorted(used) if not re.fullmatch(r"[a-z]+(_[a-z]+)*", code))


def check_warns(top):
    """The tables of expected warnings name codes and tests that exist."""
    tests = pathlib.Path(sys.argv[3]).read_text().split(";")
    known = set(re.findall(r"^\| `(\w+)` \|", (top / "options/GUIDE.md").read_text().split("\n## Warnings\n")[1], re.MULTILINE))
    for table in sorted(top.glob("tests/*/warns.txt")):
        names = [test.split(".", 1)[1] for test in tests if test.startswith(f"{table.parent.name}.")]
        names += [name.rsplit(".np")[0] + end for name in names for end in ("", ".long")]
        for code, *patterns in (line.split() for line in table.read_text().splitlines() if not line.startswith("#")):
            if code.rstrip(":") not in known:
                yield f"{table.relative_to(top)}: {code} is no code of options/GUIDE.md"
            yield from (f"{table.relative_to(top)}: {pattern} is no test" for pattern in patterns if not fnmatch.filter(names, pattern))


# --- tunables ---------------------------------------------------------------------------------------------------------

SOLVERS = ("multigrid", "pdas", "rigid", "solve")  # modules whose constants src/TUNABLES.md lists
CONSTANT = re.compile(r"(static const Petsc(?:Real|Int)|enum \{|#define)\s+(.*)")
COUNTED = re.compile(r"MAX_|_MAX|STEPS|UNKNOWNS|SETS|PER_|INTERVALS|NODE_TERMS")  # other enums are codes and sizes of arrays
SIZES = {"MAX_DIM", "DIM_MAX"}


def read_constants(path):
    """Named constants of a file, by declaration: (what declares them, [(name, value)], comment)."""
    lines, comment, number = path.read_text().splitlines(), "", 0
    while number < len(lines):
        declared = CONSTANT.match(lines[number])
        if lines[number].startswith("/*"):
            first = number
            while "*/" not in lines[number]:
                number += 1
            comment = " ".join(line.strip() for line in lines[first:number + 1]).strip("/* ")
        elif declared:
            kind, text = declared.groups()
            while kind != "#define" and ";" not in text:
                number += 1
                text += " " + lines[number].strip()
            own = re.search(r"(?:/\*|//)\s*(.*?)[\s*/]*$", text)
            body = re.sub(r"^([A-Z_0-9]+)\s+", r"\1 = ", text.split("/*")[0]) if kind == "#define" else text.split(";")[0]
            found = re.findall(r"\b([A-Z][A-Z_0-9]+)(?:\[\])?\s*=\s*(\{[^}]*\}|[^,{}]*[^,{}\s])", body)
            yield kind, [(name, value) for name, value in found if re.match(r"[^\"]*(\d|EPSILON)", value)], own.group(1) if own else comment
        elif lines[number]:
            comment = ""
        number += 1


def render_tunables(top):
    """The tables of src/TUNABLES.md."""
    text = []
    for module in SOLVERS:
        rows = []
        for path in sorted((top / "src" / module).glob("*.[ch]")):
            for kind, found, comment in read_constants(path):
                found = [one for one in found if one[0] not in SIZES and (kind != "enum {" or COUNTED.search(one[0]))]
                shown = ", ".join(f"`{name}` {value}" for name, value in found)
                if rows and rows[-1][1:] == [path.name, comment] and shown:
                    rows[-1][0] += f", {shown}"
                elif shown:
                    rows.append([shown, path.name, comment])
        text += [f"## {module}", "", "| constant | file | meaning and reason |", "|---|---|---|"]
        text += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows] + [""]
    return "\n".join(text)


def check_tunables(top):
    """src/TUNABLES.md lists the constants of the solvers with their comments, each of which has one; no name has two values in the tree."""
    page, wanted = top / "src/TUNABLES.md", render_tunables(top)
    head, _, found = page.read_text().partition("\n\n## ")
    if "--write" in sys.argv:
        page.write_text(f"{head}\n\n{wanted}")
    elif f"## {found}" != wanted:
        yield "src/TUNABLES.md is not what the sources have; write it anew by: python3 tests/house.py tunables . --write"
    yield from (f"src/TUNABLES.md: {line.split('|')[1].strip()} has no comment" for line in wanted.splitlines() if line.endswith("|  |"))
    values = {}
    for path in sources(top):
        for kind, found, _ in read_constants(path):
            for name, value in found if kind.startswith("static") else []:
                values.setdefault(name, {}).setdefault(value, path.relative_to(top))
    yield from (f"{name} has {len(of)} values: {', '.join(f'{value} in {path}' for value, path in of.items())}" for name, of in values.items() if len(of) > 1)


# --- theory -----------------------------------------------------------------------------------------------------------


def check_theory(top):
    """Equations of src/THEORY.md are numbered in order, section by section; its contents are those of the page; every equation that the tree cites exists."""
    text = (top / "src/THEORY.md").read_text()
    listed = re.findall(r"\| (\d+) \| ([^|]+?) (?=\|)", text.split("\n## ")[0])
    headings = re.findall(r"^## (\d+)\. (.*)$", text, re.MULTILINE)
    yield from (f"src/THEORY.md: {number}. {title} is either no heading or not in the contents" for number, title in sorted(set(listed) ^ set(headings)))
    section, last, numbers = 0, 0, set()
    for line in text.splitlines():
        heading, tag = re.match(r"## (\d+)\.", line), re.match(r" {4}.*\((\d+)\.(\d+)\)$", line)
        if heading:
            section, last = int(heading.group(1)), 0
        if tag:
            if (int(tag.group(1)), int(tag.group(2))) != (section, last + 1):
                yield f"src/THEORY.md: ({tag.group(1)}.{tag.group(2)}) follows ({section}.{last})"
            last = int(tag.group(2))
            numbers.add(f"{section}.{last}")
    yield from (f"src/THEORY.md cites ({number}), which it does not have" for number in sorted(set(re.findall(r"\((\d+\.\d+)\)", text)) - numbers))
    for path in sorted(file for folder in ("src", "include", "tests", "options", "plot") for file in (top / folder).rglob("*")):
        if path.suffix not in (".c", ".h", ".py", ".md", ".opts", ".cmake"):
            continue
        for lineno, line in enumerate(path.read_text().splitlines(), 1):
            cited = re.findall(r"\d+\.\d+", " ".join(re.findall(r"\beqs?\. (\d+\.\d+(?:(?:, | and |-)\d+\.\d+)*)", line)))
            for number in [number for number in cited if number not in numbers] + re.findall(r"\(T\d+\)", line):
                yield f"{path.relative_to(top)}:{lineno} cites {number}, which src/THEORY.md does not have"


# --- pages ------------------------------------------------------------------------------------------------------------


def read_page(path):
    """A page without its blocks of code."""
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"^    .*$", "", text, flags=re.MULTILINE)


def page_anchors(path):
    """What a link to a heading of this page may name, as GitHub and GitLab form it."""
    anchors = []
    for heading in re.findall(r"^#+ +(.*?) *$", read_page(path), re.MULTILINE):
        anchor = re.sub(r"[^\w\- ]", "", re.sub(r"\]\([^)]*\)", "", heading).lower()).replace(" ", "-")
        anchors.append(f"{anchor}-{anchors.count(anchor)}" if anchor in anchors else anchor)
    return anchors


def check_pages(top):
    """Links lead somewhere, and the front page is short."""
    words = len((top / "README.md").read_text(encoding="utf-8").split())
    if words > MAX_WORDS:
        yield f"README.md has {words} words, more than {MAX_WORDS}"
    pages = [path for path in sorted(top.glob("**/*.md")) if path.relative_to(top).parts[0] != "build"]
    for page in pages:
        for link in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", read_page(page))):
            if re.match(r"\w+:", link):
                continue
            file, _, anchor = link.partition("#")
            target = page.parent / file if file else page
            if not target.exists():
                yield f"{page.relative_to(top)}: there is no {link}"
            elif anchor and anchor not in page_anchors(target):
                yield f"{page.relative_to(top)}: {link} is no heading of that page"


def main():
    checks = {"layers": check_layers, "sizes": check_sizes, "comments": check_comments, "contracts": check_contracts, "options": check_options, "warnings": check_warnings, "theory": check_theory, "tunables": check_tunables, "warns": check_warns,
              "pages": check_pages}
    wrong = list(checks[sys.argv[1]](pathlib.Path(sys.argv[2]).resolve()))
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
