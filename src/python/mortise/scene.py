"""A scene as a dictionary."""
from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

# Options that list names, and the prefix of the data of each name. Where it depends on the body, it begins with the option itself.
LISTS = {"bodies": "", "pairs": "", "probes": "probe_", "paths": "path_"}
SIDES = ("bc_displacement", "bc_normal", "bc_traction", "bc_pressure", "bc_force", "bc_moment")
MATERIALS = "regions"


def text_of(name: str, value: Any) -> str:
    """A value as an option's text: a number with all its digits, a sequence as a comma list, True as 1."""
    if isinstance(value, str):
        if value[:1] == "-" and value[1:2].isalpha():
            raise ValueError(f"{name} = {value!r}: PETSc takes what begins with - and a letter for an option; write '0{value}'")
        return value
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, Iterable):
        return ",".join(text_of(name, item) for item in value)
    return repr(value) if isinstance(value, float) else str(value)


def flatten(scene: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Options and their texts, in order. See arguments_of()."""
    for key, value in scene.items():
        name = prefix + str(key).lstrip("-")
        option = name[len(prefix):]
        if value is None:
            continue
        if not isinstance(value, Mapping):
            yield name, text_of(name, value)
            continue
        inner = name + "_"
        if option in SIDES or option == MATERIALS or (not prefix and option in LISTS):
            yield name, ",".join(map(str, value))
            inner = inner if option in SIDES else prefix + LISTS.get(option, "")
        for item, data in value.items():
            if isinstance(data, Mapping):
                yield from flatten(data, f"{inner}{item}_")
            elif data is not None:
                yield f"{inner}{item}".replace(" ", "_"), text_of(f"{inner}{item}", data)


def arguments_of(scene: Mapping[str, Any]) -> list[str]:
    """The command line of a scene: ["-order", "2", "-bodies", "upper,lower", ...].

    scene: options without their dash. A value is a text, a number, a sequence (a comma list) or a bool; None omits the option. A dictionary
    {"hub": {"young": 2e5}} is a prefix: -hub_young. Where the option lists names, a dictionary is the list and the data of each.
    {"bodies": {"hub": {"young": 2e5, "bc_traction": {"top": (0, -1)}}}} is -bodies hub -hub_young 2e5 -hub_bc_traction top
    -hub_bc_traction_top 0,-1. Such options are bodies, pairs, probes, paths, the bc_... of a body, and its regions."""
    return [word for name, value in flatten(scene) for word in ("-" + name, value)]
