"""Bodies that are free take strains of temperature without stress; bodies that are held have the stresses of Hooke's law."""
import numpy

from judge import near
from material_axes import AXES

EXPANSION = numpy.diag([1e-5, 3e-5, -2e-5])
ONE, TWO = numpy.array([0.55, 0.45, 0.6]), numpy.array([0.25, 0.55, 0.35])
STIFFNESS, STRAIN = 150, 3e-5 * 50  # largest of the scene: no stress is one far below their product


def unstressed(run, scale=STIFFNESS * STRAIN, tolerance=1e-12):
    """No stress at any node, no energy."""
    with run.fields() as fields:
        stress = fields["stress"][:]
    near("stresses", float(numpy.abs(stress).max()), 0, absolute=tolerance * scale)
    near("energy", run.summary["energy"]["strain"]["block"], 0, absolute=tolerance * scale * STRAIN)


def stretched(run, strain):
    """The displacements of two points differ by the strain along the line between them; the other part is a rotation."""
    line = TWO - ONE
    apart = numpy.array(run.probe("two")["displacement"]) - numpy.array(run.probe("one")["displacement"])
    near("extension", float(line @ apart), float(line @ strain @ line), relative=1e-11)


def judge(run):
    strain = 50 * AXES @ EXPANSION @ AXES.T
    tetrahedra = ["-block_dm_plex_simplex", "1"]
    straight = ["-block_map", "x+0.2*y,y,1.3*z", "-order", "2", "-block_temperature", "20+3*x-5*y+2*z"]
    for name, words in run.some([("first", []), ("tetrahedra", tetrahedra), ("second", ["-order", "2"]), ("both", ["-order", "2", *tetrahedra])]):
        other = run.again(*words, name=name)
        unstressed(other)
        stretched(other, strain)
    unstressed(run.again(*straight, name="linear"))
    unstressed(run.again(*straight, *tetrahedra, name="linear_tetrahedra"))
    # the same strain, given by its components in the axes of the scene
    given = [strain[0, 0], strain[1, 1], strain[2, 2], 2 * strain[1, 2], 2 * strain[0, 2], 2 * strain[0, 1]]
    other = run.again("-block_temperature", "0", "-block_initial_strain", ",".join(f"{v:.17g}" for v in given), name="given")
    unstressed(other)
    stretched(other, strain)
