"""scenes.py -- scenes of round parts as lists of options, and statics by hand.

    scene = Scene()
    scene.roller("a", radius=1, cells=12, centre=(0, 1))       # by a map: its nodes are on the circle on every mesh
    scene.plane("floor", "a", point=(0, 0), normal=(0, 1))
    done = scene.solve(run, "rests")                            # a Run of judge.py in a folder of its own
"""
import contextlib
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from judge import Failure, Run, near, require  # noqa: E402 pylint: disable=wrong-import-position

DISC = ("x*sqrt(1-y^2/2)", "y*sqrt(1-x^2/2)")  # of [-1,1]^2
BALL = ("x*sqrt(1-y^2/2-z^2/2+y^2*z^2/3)", "y*sqrt(1-z^2/2-x^2/2+z^2*x^2/3)", "z*sqrt(1-x^2/2-y^2/2+x^2*y^2/3)")
RIM = {2: "bottom+left+right+top", 3: "bottom+left+right+top+front+back"}


def numbers(values):
    return ",".join(repr(float(value)) for value in values)


def turn(axis_angle):
    """A rotation, from an angle (plane), an axis with an angle (space), or as it is."""
    if np.ndim(axis_angle) == 2:
        return axis_angle
    if np.isscalar(axis_angle):
        c, s = math.cos(axis_angle), math.sin(axis_angle)
        return np.array([[c, -s], [s, c]])
    *axis, angle = axis_angle
    x, y, z = np.array(axis, float) / np.linalg.norm(axis)
    c, s = math.cos(angle), math.sin(angle)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return c * np.eye(3) + s * cross + (1 - c) * np.outer([x, y, z], [x, y, z])


def lagrange(order, xi):
    """Values and derivatives of the shape functions on [-1, 1] at points. [out] [point][function]"""
    at = np.linspace(-1, 1, order + 1)
    values = [np.poly1d(np.poly(np.delete(at, i)) / np.prod(at[i] - np.delete(at, i))) for i in range(order + 1)]
    return np.array([[f(x) for f in values] for x in xi]), np.array([[f.deriv()(x) for f in values] for x in xi])


def measure(shape, cells, order, dim):
    """Area or volume of a box that a map has bent, as isoparametric cells have it. [in] shape - of an array [dim][...] on [-1,1]^dim"""
    xi, weight = np.polynomial.legendre.leggauss(4)
    value, slope = lagrange(order, xi)
    axis = np.linspace(-1, 1, cells * order + 1)
    nodes = np.array(shape(np.array(np.meshgrid(*[axis] * dim, indexing="ij"))))
    corner = np.arange(cells) * order
    places = np.ix_(*[(corner[:, None] + np.arange(order + 1)).ravel()] * dim)
    X = np.array([row[places].reshape([n for _ in range(dim) for n in (cells, order + 1)]) for row in nodes])
    J = []
    for along in range(dim):  # derivatives by one reference coordinate at all Gauss points of all cells
        term = X
        for d in range(dim):
            term = np.moveaxis(np.tensordot(slope if d == along else value, term, axes=(1, 2 + 2 * d)), 0, 2 + 2 * d)
        J.append(term)
    det = np.linalg.det(np.moveaxis(np.array(J), (0, 1), (-2, -1)))
    for d in reversed(range(dim)):
        det = np.tensordot(det, weight, axes=(1 + 2 * d, 0))
    return float(det.sum())


def disc_shape(x):
    return [x[0] * np.sqrt(1 - x[1] ** 2 / 2), x[1] * np.sqrt(1 - x[0] ** 2 / 2)]


def ball_shape(x):
    a, b, c = x**2
    return [x[0] * np.sqrt(1 - b / 2 - c / 2 + b * c / 3), x[1] * np.sqrt(1 - c / 2 - a / 2 + c * a / 3), x[2] * np.sqrt(1 - a / 2 - b / 2 + a * b / 3)]


class Scene:
    """Bodies and pairs of a scene; options are added as they are typed."""

    def __init__(self, dim=2, order=1):
        self.dim, self.order, self.bodies, self.pairs, self.options, self.measure = dim, order, [], [], [], {}

    def give(self, **options):
        for key, value in options.items():
            self.options += [f"-{key}", str(value)]

    def body(self, name, young=1e5, poisson=0.3, force=None, **options):
        self.bodies.append(name)
        self.give(**{f"{name}_young": young, f"{name}_poisson": poisson, **{f"{name}_{key}": value for key, value in options.items()}})
        if force is not None:
            self.give(**{f"{name}_body_force": numbers(force)})

    def roller(self, name, radius, cells, centre, turned=None, **more):
        """A disc or a ball by a map of a square or a cube."""
        turned = turn((0.0 if self.dim == 2 else (0, 0, 1, 0.0)) if turned is None else turned)
        shape = DISC if self.dim == 2 else BALL
        rows = ["+".join([repr(float(centre[i])), *(f"({radius * turned[i, j]!r})*({shape[j]})" for j in range(self.dim))]) for i in range(self.dim)]
        one = [1] * self.dim
        self.measure[name] = radius**self.dim * measure(disc_shape if self.dim == 2 else ball_shape, cells, self.order, self.dim)
        self.body(name, dm_plex_simplex=0, dm_plex_box_faces=",".join([str(cells)] * self.dim), dm_plex_box_lower=numbers(-np.array(one)),
                  dm_plex_box_upper=numbers(one), map=", ".join(rows), **more)

    def block(self, name, cells, lower, upper, turned=0.0, origin=None, **more):
        """A box, turned about the origin and then moved to `origin`. [in] lower, upper - before that"""
        more = {"dm_plex_simplex": 0, "dm_plex_box_faces": ",".join(map(str, cells)), "dm_plex_box_lower": numbers(lower),
                "dm_plex_box_upper": numbers(upper), **more}
        if origin is not None:
            R = turn(turned)
            more["map"] = ", ".join("+".join([repr(float(origin[i])), *(f"({R[i, j]!r})*{'xyz'[j]}" for j in range(self.dim))]) for i in range(self.dim))
        self.body(name, **more)

    def file(self, name, mesh, folder, **more):
        """A mesh of roundmesh.py, written into a folder."""
        self.measure[name] = mesh.area()
        folder.mkdir(parents=True, exist_ok=True)
        self.body(name, dm_plex_filename=mesh.write(folder / f"{name}.msh"), **more)

    def plane(self, pair, body, point, normal, side=None):
        self.pairs.append(pair)
        self.give(**{f"{pair}_nonmortar": f"{body}:{side or RIM[self.dim]}", f"{pair}_obstacle": "plane", f"{pair}_obstacle_point": numbers(point),
                     f"{pair}_obstacle_normal": numbers(normal)})

    def joint(self, pair, one, other, swapped=False):
        """Two sides "body:side"; the first one is nonmortar unless they are swapped."""
        self.pairs.append(pair)
        self.give(**{f"{pair}_nonmortar": other if swapped else one, f"{pair}_mortar": one if swapped else other})

    def arguments(self):
        return ["-bodies", ",".join(self.bodies), "-pairs", ",".join(self.pairs), "-order", str(self.order), *self.options]

    def write(self, path):
        """The scene as an options file, so that it can be run by hand."""
        words = self.arguments()
        pathlib.Path(path).write_text("".join(f'{key} "{value}"\n' if " " in value else f"{key} {value}\n" for key, value in zip(words[::2], words[1::2])))

    def solve(self, run, name, *more, ranks=1, exits=(0,)):
        """Runs the scene in a folder of its own. [in] run - of judge.py, whose program is taken"""
        done = Run(run.program, run.mpiexec, ranks, run.folder / name, [*self.arguments(), *more])
        self.write(done.folder / "scene.opts")
        if done.exit not in exits:
            said = (done.stderr.strip().splitlines() or [""])[0]
            raise Failure(f"{name}: exit code {done.exit} instead of {' or '.join(map(str, exits))}: {said} ({done.folder}/scene.opts)")
        done.require_clean()
        return done


class Findings:
    """What fails in many cases, told together at the end."""

    def __init__(self):
        self.count, self.failures = 0, []

    @contextlib.contextmanager
    def case(self):
        self.count += 1
        try:
            yield
        except Failure as failure:
            self.failures.append(str(failure).split("\n", maxsplit=1)[0])

    def end(self):
        require(not self.failures, "\n".join([f"{len(self.failures)} of {self.count} cases fail", *self.failures]))


def force(done, pair):
    """What acts on the nonmortar body of a pair."""
    return np.array(done.pair(pair)["force"])


def judge_force(what, done, pair, expected, relative, swapped=False):
    """A contact force, all components of it, against the size of what is expected."""
    value = -force(done, pair) if swapped else force(done, pair)
    off = np.linalg.norm(value - expected) / np.linalg.norm(expected)
    require(off <= relative, f"{what}: force of {pair} is {value.tolist()}, by statics {list(map(float, expected))}: off by {off:.3g} of it, allowed {relative:.3g} ({done.folder}/scene.opts)")


__all__ = ["Failure", "Findings", "Run", "Scene", "force", "judge_force", "near", "numbers", "require", "turn"]
