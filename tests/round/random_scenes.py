#!/usr/bin/env python3
"""random_scenes.py -- discs, rings and balls on planes, in grooves and on each other, against statics and against each other.

    random_scenes.py <program> [scenes] [first seed] [folder]

A scene is made of its seed alone. Its rigid statics are solved by hand: forces along normals and lines of centres that balance all
weights. Where they cannot, or would have to pull, the program has to refuse (exit 2). Where they can, it has to find them (exit 0), and once
more with one of: roles swapped, the other solver, three ranks. A wrong force with exit 0 is the worst; other ends are told apart.
"""
import collections
import math
import pathlib
import random
import sys
import tempfile
import types

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import numpy as np  # noqa: E402
import roundmesh  # noqa: E402
from scenes import Failure, Scene, force  # noqa: E402 pylint: disable=wrong-import-position

FLAT, CURVED = 1e-6, 2e-3  # of the heaviest sum of forces, where a side of every pair is flat, and otherwise
SAME = 1e-6  # of two solvers, and of ranks
VARIANTS = {"solver": (("-snes_type", "vinewtonrsls"), 1), "ranks": ((), 3), "swapped": ((), 1)}
Contact = collections.namedtuple("Contact", "pair body other normal")  # normal: towards the body; other: None for a wall


class Heap:
    """A scene with what touches what. Bodies are made in the end, when all is known of them."""

    def __init__(self, seed, folder):
        self.rng, self.folder = random.Random(seed), folder
        self.contacts, self.bodies, self.kind = [], [], ""
        self.dim = 3 if seed % 5 == 4 else 2
        self.order = self.rng.choice((1, 2))
        self.family = self.rng.choice(FAMILIES[self.dim])
        self.walls = self.rng.choice(("plane", "plane", "block"))
        self.young = 10 ** self.rng.uniform(4, 7)
        self.density = {}
        self.family(self)

    def add(self, name, centre, radius, shape=None):
        self.bodies.append((name, np.array(centre, float), radius, shape or self.rng.choice(("roller", "disc", "ring") if self.dim == 2 else ("roller",))))
        self.density[name] = self.rng.uniform(0.5, 2)

    def wall(self, body, normal):
        self.contacts.append(Contact(f"w{len(self.contacts)}", body, None, np.array(normal, float) / np.linalg.norm(normal)))

    def touch(self, body, other):
        at = {name: centre for name, centre, *_ in self.bodies}
        line = at[body] - at[other]
        self.contacts.append(Contact(f"t{len(self.contacts)}", body, other, line / np.linalg.norm(line)))

    def scene(self, swapped=False):
        """[out] the Scene, and the pairs whose nonmortar side is not that of `body`"""
        rng, scene, sides, turned_pairs = random.Random(self.rng_state), Scene(self.dim, self.order), {}, set()
        for name, centre, radius, shape in self.bodies:
            load = [0.0] * (self.dim - 1) + [-self.density[name]]
            young, angle = self.young * 10 ** rng.uniform(0, 1), rng.uniform(0, 6.28)
            if shape == "roller":
                axis = (rng.gauss(0, 1), rng.gauss(0, 1), rng.gauss(0, 1), angle)
                scene.roller(name, radius, rng.choice((6, 8, 10)) if self.dim == 2 else 4, centre, turned=angle if self.dim == 2 else axis, young=young, force=load)
                sides[name] = "bottom+left+right+top" if self.dim == 2 else "bottom+left+right+top+front+back"
                continue
            mesh = roundmesh.disc(radius, rng.choice((5, 7, 9)), self.order, angle, centre, rng.choice((0, 0.2))) if shape == "disc" else roundmesh.ring(
                radius * 0.6, radius, rng.choice((28, 36, 50)), 3, self.order, angle, centre)
            scene.file(name, mesh, self.folder / "meshes", young=young, force=load)
            sides[name] = "rim" if shape == "disc" else "outer"
        at = {name: (centre, radius) for name, centre, radius, _ in self.bodies}
        for contact in self.contacts:
            swap = (rng.random() < 0.5) != swapped
            if contact.other:
                scene.joint(contact.pair, f"{contact.body}:{sides[contact.body]}", f"{contact.other}:{sides[contact.other]}", swapped=swap)
            else:
                centre, radius = at[contact.body]
                touch = centre - radius * contact.normal
                if self.walls == "plane":
                    scene.plane(contact.pair, contact.body, touch, contact.normal, side=sides[contact.body])
                    continue
                angle = math.atan2(-contact.normal[0], contact.normal[1])
                scene.block(f"b{contact.pair}", (rng.choice((10, 15)), 3), (-0.4 * radius, -0.3 * radius), (0.43 * radius, 0), turned=angle, origin=touch,
                            young=self.young * 10 ** rng.uniform(0, 1), bc_displacement="bottom", bc_displacement_bottom="0,0")
                scene.joint(contact.pair, f"{contact.body}:{sides[contact.body]}", f"b{contact.pair}:top", swapped=swap)
            if swap:
                turned_pairs.add(contact.pair)
        return scene, turned_pairs

    def statics(self, scene):
        """Forces on `body` by pair, or None where there is no balance."""
        names = [name for name, *_ in self.bodies]
        A, b = np.zeros((len(names) * self.dim, len(self.contacts))), np.zeros(len(names) * self.dim)
        for column, contact in enumerate(self.contacts):
            i = names.index(contact.body) * self.dim
            A[i:i + self.dim, column] = contact.normal
            if contact.other:
                j = names.index(contact.other) * self.dim
                A[j:j + self.dim, column] = -contact.normal
        for i, name in enumerate(names):
            b[(i + 1) * self.dim - 1] = scene.measure[name] * self.density[name]
        size, *_ = np.linalg.lstsq(A, b, rcond=None)
        if np.linalg.norm(A @ size - b) > 1e-9 * np.linalg.norm(b) or size.min() < 0:
            return None
        return {contact.pair: size[column] * contact.normal for column, contact in enumerate(self.contacts)}

    rng_state = 0


# --- families ---------------------------------------------------------------------------------------------------------


def upward(angle, dim=2, around=0.0):
    """A normal that leans by an angle."""
    return [-math.sin(angle), math.cos(angle)] if dim == 2 else [math.sin(angle) * math.cos(around), math.sin(angle) * math.sin(around), math.cos(angle)]


def on_plane(heap):
    heap.add("a", (0, 0), 1)
    heap.wall("a", upward(heap.rng.choice((0, 0, 0, 1e-6, -1e-4, 1e-2, 0.3))))


def in_groove(heap):
    heap.add("a", (0, 0), heap.rng.choice((0.1, 1, 20)))
    lean = heap.rng.uniform(0.15, 1.2)
    heap.wall("a", upward(lean))
    heap.wall("a", upward(heap.rng.choice((-1, -1, -1, 1)) * heap.rng.uniform(0.2, 1.3) + (0.1 if lean > 1 else 0)))


def two_in_groove(heap):
    """The second disc lies on the first one and on the right wall."""
    r, angle = heap.rng.uniform(0.6, 1.5), heap.rng.uniform(0.3, 1.2)
    heap.add("a", (0, 0), 1)
    heap.add("b", ((1 + r) * math.sin(angle), (1 + r) * math.cos(angle)), r)
    heap.wall("a", (0, 1))
    heap.wall("a", (1, heap.rng.choice((0, 0.2))))
    heap.touch("b", "a")
    heap.wall("b", (-1, heap.rng.uniform(0, 0.7)))


def on_two(heap):
    """A disc on two others, each of them in its groove."""
    angles = [heap.rng.uniform(0.4, 0.9), -heap.rng.uniform(0.4, 0.9)]
    heap.add("a", (0, 0), 1)
    for name, angle in zip("bc", angles):
        heap.add(name, (2 * math.sin(angle), -2 * math.cos(angle)), 1)
        heap.touch("a", name)
        heap.wall(name, (0, 1))
        heap.wall(name, (-math.copysign(1, angle), 0.3))


def ball_on_plane(heap):
    heap.add("a", (0, 0, 0), 1)
    heap.wall("a", upward(heap.rng.choice((0, 0, 1e-5, 0.2)), 3, heap.rng.uniform(0, 6)))


def ball_in_corner(heap):
    heap.add("a", (0, 0, 0), heap.rng.choice((0.2, 1)))
    start = heap.rng.uniform(0, 6)
    for k in range(3):
        heap.wall("a", upward(heap.rng.uniform(0.4, 1.1), 3, start + k * 2.1 + heap.rng.uniform(-0.2, 0.2)))


def two_balls(heap):
    """The second ball lies on the first one and on two walls; the first one on the floor and on two walls."""
    angle, around = heap.rng.uniform(0.3, 0.9), heap.rng.uniform(0, 6)
    heap.add("a", (0, 0, 0), 1)
    heap.add("b", 2 * np.array(upward(angle, 3, around)), 1)
    heap.wall("a", (0, 0, 1))
    heap.touch("b", "a")
    for name, way in (("a", around), ("b", around + math.pi)):
        for side in (-1, 1):
            heap.wall(name, upward(1.35, 3, way + side * heap.rng.uniform(0.5, 0.9)))


FAMILIES = {2: (on_plane, in_groove, in_groove, two_in_groove, on_two), 3: (ball_on_plane, ball_in_corner, two_balls)}


# --- judgement --------------------------------------------------------------------------------------------------------


def compare(done, expected, turned, limit):
    """The largest difference of a force, over the largest force."""
    scale = max(np.linalg.norm(f) for f in expected.values())
    return max(np.linalg.norm((-1 if pair in turned else 1) * force(done, pair) - f) for pair, f in expected.items()) / scale / limit


def try_scene(run, seed):
    """[out] family, a word for how it ended, what is to be told of it"""
    heap = Heap(seed, run.folder / f"s{seed}")
    heap.rng_state = seed
    if heap.dim == 3:
        heap.walls = "plane"
    scene, turned = heap.scene()
    expected = heap.statics(scene)
    what = f"{heap.family.__name__}, order {heap.order}, {heap.walls}, {'+'.join(shape for *_, shape in heap.bodies)}"
    limit = CURVED if any(contact.other for contact in heap.contacts) else FLAT
    try:
        done = scene.solve(run, f"s{seed}/first", exits=(0, 1, 2, 3, 4))
        if expected is None:
            return heap, {0: "solved, has to be refused", 2: "right"}.get(done.exit, f"exit {done.exit}, has to be refused"), what
        if done.exit:
            return heap, "refused, has a solution" if done.exit == 2 else f"exit {done.exit}", f"{what}: {(done.stderr.strip().splitlines() or [''])[0]}"
        off = compare(done, expected, turned, limit)
        if off > 1:
            return heap, "WRONG FORCE", f"{what}: off by {off * limit:.2e}"
        variant = sorted(VARIANTS)[seed % 3]
        more, ranks = VARIANTS[variant]
        other, turned_other = heap.scene(swapped=variant == "swapped")
        again = other.solve(run, f"s{seed}/{variant}", *more, ranks=ranks, exits=(0, 1, 2, 3, 4))
        if again.exit:
            return heap, f"exit {again.exit}, {variant}", f"{what}: {(again.stderr.strip().splitlines() or [''])[0]}"
        first = {pair: (-1 if pair in turned else 1) * force(done, pair) for pair in expected}
        off = compare(again, expected if variant == "swapped" else first, turned_other, limit if variant == "swapped" else SAME)
        if off > 1:
            return heap, f"WRONG FORCE, {variant}", f"{what}: off by {off * (limit if variant == 'swapped' else SAME):.2e}"
    except Failure as failure:
        return heap, "failure", f"{what}: {str(failure).splitlines()[0]}"
    return heap, "right", what


def survey(run, seeds, tell=print):
    """[out] counts by family and end; ends that are not right are told as they come"""
    counts = collections.Counter()
    for seed in seeds:
        heap, end, what = try_scene(run, seed)
        counts[heap.family.__name__, end] += 1
        if end != "right":
            tell(f"seed {seed}: {end}: {what} ({run.folder}/s{seed})")
    return counts


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    number, first = (int(word) for word in (*sys.argv[2:4], *(300, 0)[len(sys.argv[2:4]):]))
    folder = pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else tempfile.mkdtemp(prefix="round"))
    run = types.SimpleNamespace(program=program, mpiexec="mpiexec", folder=folder.resolve())
    counts = survey(run, range(first, first + number), tell=lambda line: print(line, flush=True))
    print("\n| family | end | scenes |\n|---|---|---:|")
    for (family, end), count in sorted(counts.items()):
        print(f"| {family} | {end} | {count} |")


if __name__ == "__main__":
    main()
