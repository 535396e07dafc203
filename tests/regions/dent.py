"""A dent in three layers of one body equals that in three bodies which are tied along meshes that match. The dual multipliers make both
sides of a tie move alike at every node. The stress of a layer is recovered from its own cells in both."""
import pathlib

from judge import Run, near

HERE = pathlib.Path(__file__).parent


def judge(run):
    arguments = ["-options_file", str(HERE / "dent_tied.opts")] + run.arguments[2:]
    tied = Run(run.program, run.mpiexec, run.ranks, run.folder / "tied", arguments)
    tied.require_solved()
    near("force", run.pair("dent")["force"], tied.pair("dent")["force"], relative=1e-9)
    near("strain energy", sum(run.summary["energy"]["strain"].values()), sum(tied.summary["energy"]["strain"].values()), relative=1e-9)
    for probe in ("bond", "deep"):
        for key in ("displacement", "stress"):
            near(f"{key} of {probe}", run.probe(probe)[key], tied.probe(probe)[key], relative=1e-8)
