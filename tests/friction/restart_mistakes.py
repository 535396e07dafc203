"""Files that a run cannot go on from: one sentence each, and exit code 1."""
from judge import Run, require


def judge(run):
    done = Run(run.program, run.mpiexec, 1, run.folder / "done", [*run.arguments, "-load_steps", "0.5,1"])
    require(done.exit == 0, done.stderr)
    file = str(done.folder / "result.h5")
    (run.folder / "text.h5").write_text("no HDF5")
    loose = [*run.arguments[:run.arguments.index("-load_steps")]]
    single = Run(run.program, run.mpiexec, 1, run.folder / "alone", loose)
    require(single.exit == 0, single.stderr)
    fine = Run(run.program, run.mpiexec, 2, run.folder / "fine", [*run.arguments, "-load_steps", "1", "-dm_refine", "1"])
    require(fine.exit == 0, fine.stderr)
    tried = {
        "missing": (["-restart", "no_such.h5", "-load_steps", "2"], "cannot be read as an HDF5 file"),
        "text": (["-restart", str(run.folder / "text.h5"), "-load_steps", "2"], "cannot be read as an HDF5 file"),
        "no_steps": (["-restart", file], "give -load_steps"),
        "finer": (["-restart", file, "-load_steps", "0.5,1,2", "-dm_refine", "1"], "the body block has a node that the file does not have at"),
        "other_body": (["-restart", file, "-load_steps", "0.5,1,2", "-block_dm_plex_box_upper", "3,1"], "that the file does not have at"),
        "behind": (["-restart", file, "-load_steps", "2"], "it ends at t = 1, and has all steps of -load_steps"),
        "finer_file": (["-restart", str(fine.folder / "result.h5"), "-load_steps", "0.5,1,2"], "408 of the file's 561 points are no nodes of the scene"),
        "own": (["-restart", "result.h5", "-load_steps", "3"], "-output result would replace this file"),
        "adapted": (["-restart", file, "-load_steps", "0.5,1,2", "-adapt", "0.1", "-floor_friction", "0"], "-adapt"),
        "single": (["-restart", str(single.folder / "result.h5"), "-load_steps", "0.5,1,2"], "has no solved load step"),
    }
    for name, (options, says) in tried.items():
        failed = Run(run.program, run.mpiexec, 2 if name in ("finer", "missing") else 1, run.folder / name, [*loose, *options])
        lines = [line for line in failed.stderr.splitlines() if line.startswith("mortise:")]
        require(failed.exit == 1 and len(lines) == 1 and says in lines[0] and "-restart" in lines[0], f"{name}: exit {failed.exit}, {failed.stderr}")
    onward = Run(run.program, run.mpiexec, 1, run.folder / "onward", [*loose, "-restart", file, "-load_steps", "0.25,0.75"])
    require(onward.exit == 0 and [step["t"] for step in onward.summary["steps"]] == [0.25, 0.75], f"other times: {onward.stderr}")
