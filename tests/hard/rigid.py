"""A body on one that is a million times stiffer meets something as good as rigid."""
import pathlib

from judge import Run

SCENE = pathlib.Path(__file__).with_name("dent_rigid.opts")
PARTNER = 1e-6  # stiffness of the soft body over that of the stiff one


def rigid_twin(run, *arguments):
    """The scene of dent_rigid.opts."""
    twin = Run(run.program, run.mpiexec, run.ranks, run.folder / "rigid", ["-options_file", str(SCENE), *arguments])
    twin.require_solved()
    return twin
