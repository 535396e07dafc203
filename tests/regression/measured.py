"""-measure_linear: one linear solve with the final active set, beside the whole solve; nothing of it where nobody asks."""
from judge import near, require


def measured(run, multigrid):
    solver, timing = run.summary["solver"], run.summary["timing"]
    reference = solver["linear_reference"]
    require(reference is not None and timing["linear_reference"] > 0, "there is no linear reference")
    require(reference["contact_ratio"] > 0, "the solve costs nothing beside it")
    stages = sum(timing[stage] for stage in ("setup", "mortar", "assembly", "condense", "solve", "output"))
    require(stages + timing["linear_reference"] <= timing["total"], "the reference is counted in a stage")
    if multigrid:
        require(0 < reference["iterations"] <= 15, f"{reference['iterations']} iterations for one linear system")
        require(0 < reference["work_units"] <= solver["work_units"], "one system costs more products than the whole solve")
        require("products with the matrix" in run.stdout, "the products are not printed")
    else:
        require(solver["work_units"] is None and reference["work_units"] is None, "products are counted without levels")
    require("one linear solve with the final active set" in run.stdout, "the reference is not printed")


def judge(run):
    measured(run, multigrid=True)
    for ranks in (1, 2):
        plain = run.again("-measure_linear", "0", ranks=ranks, name=f"plain{ranks}")
        require(plain.summary["solver"]["linear_reference"] is None, "a reference that nobody asked for")
        require(plain.summary["timing"]["linear_reference"] is None, "seconds that nobody asked for")
        near("work units", plain.summary["solver"]["work_units"], run.summary["solver"]["work_units"], relative=0.2)
    for word in ("pdas", "vinewtonrsls"):
        measured(run.again("-pc_type", "cholesky", "-snes_type", word, name=word), multigrid=False)
    measured(run.again("-snes_type", "vinewtonrsls", ranks=2, name="multigrid"), multigrid=True)
