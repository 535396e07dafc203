"""A block on an incline: statics, and where it begins to slide. In space the slope is in no direction of the mesh."""
from judge import Run, near, require, same

SLOPE = {"floor": 0.2, "joint": 5**0.5 / 10}
FORCES = {"floor": ([-4e3, 2e4], [-4e3, 0]), "joint": ([-6e3, -3e3, 3e4], [-6e3, -3e3, 0])}


def judge(run):
    name = next(iter(run.summary["pairs"]))
    pair, limit = run.pair(name), SLOPE[name]
    near("force", pair["force"], FORCES[name][0], relative=1e-11)
    near("tangential force", pair["tangential_force"], FORCES[name][1], relative=1e-11)
    (patch,) = pair["patches"]
    near("force of its patch", patch["force"], pair["force"], relative=1e-11)
    if name == "floor":  # of the weight (4e3, -2e4) in the centre (1, 0.5)
        near("its moment about the origin", patch["moment"][0] + patch["centre"][0] * patch["force"][1], 2.2e4, relative=1e-11)
    require(pair["dissipation"] > 0 and 0 < pair["slip_share"] < 1, f"slip: {pair['slip_share']}, dissipation {pair['dissipation']}")
    friction = run.summary["solver"]["friction"]
    require(friction["unique"] and max(friction[key] for key in ("cone", "slip", "dissipation")) < 1e-11, f"friction {friction}")
    limits = [0.3 * p * (1 + 1e-11) for p in run.table(name)["pressure"]]
    tangents = zip(*(run.table(name)[f"tangential_traction_{axis}"] for axis in "xyz"[: len(pair["force"])]))
    require(all(sum(q * q for q in t) ** 0.5 <= g for t, g in zip(tangents, limits)), "a traction is beyond the limit")
    checked = run.again("-cross_check", name="checked").summary["solver"]["cross_check"]
    require(checked["agree"] and checked["displacement_difference"] < 1e-9, f"second solution {checked}")
    run.again(f"-{name}_friction", repr(1.03 * limit), name="rough", warns=set())
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "smooth", [*run.arguments, f"-{name}_friction", repr(0.97 * limit)])
    same("exit code where friction is too small", refused.exit, 2)
    require("slides along" in refused.stderr and "friction is too small to resist" in refused.stderr, refused.stderr)
    if name == "joint":  # cones are round: the 16 edges of a pyramid around them held loads up to 2 % beyond
        just = Run(run.program, run.mpiexec, run.ranks, run.folder / "just", [*run.arguments, "-joint_friction", repr(0.99999 * limit)])
        same("exit code where a pyramid around the cone holds", just.exit, 2)
        require("body block slides along (0.894427, 0.447214, 0)" in just.stderr, just.stderr)
