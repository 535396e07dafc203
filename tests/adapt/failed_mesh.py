"""A later mesh that fails: a support's formula without a value at a node that only this mesh has, or too few iterations for it. The run ends on the mesh
before, with exit code 3, a sentence with both meshes, and all numbers, bars and files of that mesh: those of a run that ends there by a limit."""
import math

from judge import LEAK, Run, read_table, require, same

# NAN at one place, elsewhere 0: only a later mesh has a node there
SUPPORT = ["-adapt", "2e-2", "-lower_bc_displacement_bottom", "0,0/(x-0.0625)"]
# name, more arguments, the reason of the failure
CASES = [
    ("support", SUPPORT, "component 2 is not a finite number at (0.0625, -1)"),
    ("solver", ["-adapt", "5e-2", "-order", "1", "-pc_type", "truncatedmg", "-ksp_max_it", "7"], "the linear solver did not converge"),
    ("steps", [*SUPPORT, "-load_steps", "0.5,1"], "failed at t = 0.5"),
    ("friction", [*SUPPORT, "-load_steps", "0.5,1", "-joint_friction", "0.3"], "failed at t = 0.5"),
]


def alike(name, a, b, size=0):
    """Numbers of two blocks, to rounding of the largest number of a vector; times apart."""
    if isinstance(a, dict):
        same(f"{name}: keys", sorted(a), sorted(b))
        for key in a:
            if key != "seconds":
                alike(f"{name}.{key}", a[key], b[key])
    elif isinstance(a, list):
        same(f"{name}: length", len(a), len(b))
        size = max((abs(x) for x in a if isinstance(x, float)), default=0)
        for i, (x, y) in enumerate(zip(a, b)):
            alike(f"{name}[{i}]", x, y, size)
    elif isinstance(a, (int, float)) and not isinstance(a, bool):
        require(math.isclose(a, b, rel_tol=1e-7, abs_tol=max(1e-9 * size, 1e-12)), f"{name}: {a} and {b}")
    else:
        same(name, a, b)


def judge(run):
    for name, arguments, says in run.some(CASES):
        failed = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + arguments)
        same(f"{name}: exit", failed.exit, 3)
        meshes = failed.summary["estimate"]["meshes"]
        require(f"results of mesh {len(meshes)}, mesh {len(meshes) + 1} failed" in failed.stderr and says in failed.stderr, failed.stderr)
        require("PETSC ERROR" not in failed.stderr and failed.stderr.count("mortise: ") <= 3, failed.stderr)
        if name == "solver":  # a user error leaves objects behind
            require(not LEAK.search(failed.stdout + failed.stderr), f"memory is lost: {failed.stdout}")
        require(len(meshes) >= 3, f"{len(meshes)} meshes")
        limited = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{name}_limited", run.arguments + arguments + ["-adapt_max_meshes", str(len(meshes))])
        same(f"{name}: exit at the limit", limited.exit, 3)
        for block in ("bars", "pairs", "energy", "probes", "reactions", "estimate"):
            alike(f"{name}: {block}", failed.summary[block], limited.summary[block])
        require((failed.folder / "result.h5").is_file(), "no fields are written")
        if "-load_steps" in arguments:
            same(f"{name}: rows", list(read_table(failed.folder / "result_steps.csv")["t"]), list(read_table(limited.folder / "result_steps.csv")["t"]))
