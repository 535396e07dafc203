"""Thirty hard cases of friction. Each is solved, its certificate holds, and the second method (fixed point over Tresca's problems) agrees to 1e-8 wherever it converges; or it is refused
for the reason that statics gives. Beyond rho = 1 the summary says that the solution may not be the only one. But in the long run, every second case, on several ranks every third. The table of README.md comes from here: hard.table.txt."""
import math
import pathlib

from judge import LONG, Run, near, require

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
AGREE = 1e-8


def words(options):
    return [word for name, value in options.items() for word in (f"-{name}", str(value))]


def delivered(name, **options):
    return ["-options_file", str(TOP / "options" / f"{name}.opts"), *words(options)]


def box(name, lower, upper, faces, young=1e6, poisson=0.3, **more):
    return {f"{name}_dm_plex_simplex": 0, f"{name}_dm_plex_box_lower": ",".join(map(str, lower)), f"{name}_dm_plex_box_upper": ",".join(map(str, upper)),
            f"{name}_dm_plex_box_faces": faces, f"{name}_young": young, f"{name}_poisson": poisson} | {f"{name}_{key}": value for key, value in more.items()}


def floor(body, mu, pair="floor"):
    return {f"{pair}_nonmortar": f"{body}:bottom", f"{pair}_obstacle": "plane", f"{pair}_obstacle_normal": "0,1", f"{pair}_friction": mu}


def greco(mu, **more):
    return delivered("greco", floor_friction=mu, **more)


def stiffness(ratio):
    """A block pressed and sheared on another one of this part of its stiffness."""
    return words({"model": "plane_strain", "bodies": "upper,lower", "pairs": "joint", "joint_nonmortar": "upper:bottom", "joint_mortar": "lower:top", "joint_friction": 0.4} | box(
        "upper", (0, 0), (1, 1), "9,9", 1e6 * ratio, bc_displacement="top", bc_displacement_top="0.008,-0.01") | box(
            "lower", (-0.5, -1), (1.5, 0), "13,7", bc_displacement="bottom", bc_displacement_bottom="0,0"))


def wedge(mu, slope):
    """A wedge with sides of this slope that is pressed into a rigid groove in step 1; a tenth of the force is left in step 2. Half of it."""
    return words({"model": "plane_strain", "bodies": "wedge", "pairs": "flank", "flank_nonmortar": "wedge:right", "flank_obstacle": "plane", "flank_obstacle_point": "1,0",
                  "flank_obstacle_normal": f"-1,{slope}", "flank_friction": mu, "load_steps": "1,2"} | box(
                      "wedge", (0, 0), (1, 1), "12,12", map=f"x*(1+{slope}*y), y", bc_normal="left", bc_traction="top", bc_traction_top="0,-3e3*(1.9-0.9*t)"))


def stack(push):
    """Three blocks on a floor, each with the friction of its own, all pushed by a body force."""
    names = ("low", "middle", "high")
    options = {"model": "plane_strain", "bodies": ",".join(names), "pairs": "floor,first,second"} | floor("low", 0.5)
    for k, name in enumerate(names):
        options |= box(name, (0.1 * k, k), (2 + 0.1 * k, k + 1), f"{8 - k},{3 + k}", body_force=f"{push},-1")
    for pair, above, below in (("first", "middle", "low"), ("second", "high", "middle")):
        options |= {f"{pair}_nonmortar": f"{above}:bottom", f"{pair}_mortar": f"{below}:top", f"{pair}_friction": 0.5}
    return words(options)


def corner(pairs, mu):
    """A block pushed into a corner of floor and wall."""
    options = {"model": "plane_strain", "bodies": "block", "pairs": ",".join(pairs)} | box("block", (0, 0), (1, 1), "10,10", bc_pressure="top,right", bc_pressure_top=1e4, bc_pressure_right=6e3)
    if "floor" in pairs:
        options |= floor("block", mu)
    if "wall" in pairs:
        options |= {"wall_nonmortar": "block:left", "wall_obstacle": "plane", "wall_obstacle_normal": "1,0", "wall_friction": mu}
    return words(options)


def pin(turn):
    """A pin with interference in a ring that is held outside; the core of the pin turns, in step 2."""
    ring = "(y*cos(x)), (y*sin(x))"
    return words({"model": "plane_strain", "order": 2, "bodies": "ring,pin", "pairs": "fit", "fit_nonmortar": "ring:bottom", "fit_mortar": "pin:top", "fit_friction": 0.2, "fit_gap": -1e-3, "load_steps": "1,2"} | box(
        "ring", (0, 1), (6.283185307179586, 2), "24,3", map=ring, bc_displacement="top", bc_displacement_top="0,0") | box(
            "pin", (0, 0.5), (6.283185307179586, 1), "20,3", map=ring, bc_displacement="bottom", bc_displacement_bottom=f"0-y*{turn}*max(t-1,0),x*{turn}*max(t-1,0)"))


def solved(run):
    require(run.exit == 0, f"exit {run.exit}: {run.stderr}")


def refused(run):
    require(run.exit == 2 and "friction is too small" in run.stderr, f"exit {run.exit}: {run.stderr}")


def refused_or_solved(run):
    require(run.exit in (0, 2), f"exit {run.exit}: {run.stderr}")


def slips(share):
    def judge(run):
        solved(run)
        for name, pair in run.summary["pairs"].items():
            if pair["slip_share"] is not None:
                near(f"part of {name} that slips", pair["slip_share"], share, absolute=1e-9)
    return judge


def flank_forces(run):
    solved(run)
    return [step["pairs"]["flank"]["normal_force"] for step in run.summary["steps"]]


def locked(run):
    first, second = flank_forces(run)
    require(second > 0.5 * first, f"pressed by {first}, then {second}")


def sprung(run):
    """Sliding in and out: N (sin a + mu cos a) and N (sin a - mu cos a) carry the forces."""
    angle, mu, force = math.atan(0.3), 0.1, 3e3 * 1.3
    near("normal forces", flank_forces(run), [force / (math.sin(angle) + mu * math.cos(angle)), 0.1 * force / (math.sin(angle) - mu * math.cos(angle))], relative=1e-6)


def steady(run):
    solved(run)
    steps = [step["pairs"]["joint"] for step in run.summary["steps"]]
    for key in ("slip_share", "max_slip", "dissipation"):
        near(key, [step[key] for step in steps[-4:]], [step[key] for step in steps[-8:-4]], relative=1e-8)


def torque(run):
    solved(run)
    pair = run.pair("fit")
    near("what slips", pair["slip_share"], 1, absolute=1e-9)
    table = run.table("fit")
    moment = sum(f / p * (x * qy - y * qx) for f, p, x, y, qx, qy in zip(*(table[key] for key in ("force", "pressure", "x", "y", "tangential_traction_x", "tangential_traction_y"))))
    near("moment on the radius", abs(moment), 0.2 * pair["normal_force"] if pair["normal_force"] else 0, relative=1e-3)
    near("moment of the patch", pair["patches"][0]["moment"], [moment], relative=1e-3)


def not_unique(run):
    solved(run)
    friction = run.summary["solver"]["friction"]
    require(friction["rho"] < 1 or (not friction["unique"] and "not_unique" in {w["code"] for w in run.summary["warnings"]}), f"{friction}")


CASES = {
    "greco, mu 1e-6": (greco(1e-6), solved),
    "greco, mu 1e-3": (greco(1e-3), solved),
    "greco, mu 0.1": (greco(0.1), solved),
    "greco, mu 3": (greco(3), not_unique),
    "greco, mu 10": (greco(10), not_unique),
    "greco, mu 3, order 2": (greco(3, order=2), not_unique),
    "greco, mu 1 on the left half alone": (greco("x<0.02 ? 1 : 0"), solved),
    "greco, nearly incompressible": (greco(1, block_poisson=0.4999), solved),
    "greco, lengths of 1e-9": (greco(1, block_map="x*1e-9, y*1e-9"), solved),
    "pressed block, mu 10: sticks everywhere": (greco(10, block_bc_pressure_left=0), slips(0)),
    "incline of slope 0.2, mu 0.2: on the verge": (delivered("incline", floor_friction=0.2), refused_or_solved),
    "incline of slope 0.2, mu 0.2002": (delivered("incline", floor_friction=0.2002), solved),
    "incline of slope 0.2, mu 0.1998": (delivered("incline", floor_friction=0.1998), refused),
    "block moved over a floor: slips everywhere": (words({"model": "plane_strain", "bodies": "block", "pairs": "floor"} | floor("block", 0.3) | box(
        "block", (0, 0), (2, 1), "12,6", bc_displacement="top", bc_displacement_top="0.5,-0.01")), slips(1)),
    "block pressed straight down: symmetric": (words({"model": "plane_strain", "bodies": "block", "pairs": "floor"} | floor("block", 0.15) | box(
        "block", (-1, 0), (1, 1), "12,6", bc_pressure="top", bc_pressure_top=1e4)), solved),
    "wedge of slope 0.1, mu 0.3: locks": (wedge(0.3, 0.1), locked),
    "wedge of slope 0.3, mu 0.1: springs out": (wedge(0.1, 0.3), sprung),
    "discs sheared to and fro, three cycles": (delivered("fretting", load_steps="1,2,3,4,5,6,7,8,9,10,11,12,13", upper_bc_displacement_top="0.00295*sin(pi/2*(t-1)), -0.0105*min(t,1)"), steady),
    "press fit, pulled until it slides": (delivered("pull_off"), solved),
    "clamp at 99.5 % of what it holds": (delivered("clamp", load_steps="0,0.5,0.995"), solved),
    "keystone held by friction": (delivered("keystone"), solved),
    "three blocks, pushed by 0.49 of their weight, mu 0.5": (stack(0.49), solved),
    "three blocks, pushed by 0.51 of their weight, mu 0.5": (stack(0.51), refused),
    "stiffness 1e-3 on 1": (stiffness(1e-3), solved),
    "stiffness 1e-1 on 1": (stiffness(1e-1), solved),
    "stiffness 10 on 1": (stiffness(10), solved),
    "stiffness 1e3 on 1": (stiffness(1e3), solved),
    "corner with friction on the floor": (corner(("floor",), 0.7), solved),
    "corner with friction on floor and wall": (corner(("floor", "wall"), 0.7), solved),
    "pin that turns in a ring: slips everywhere": (pin(0.05), torque),
}


def judge_case(run, place, name):
    options, judge_end = CASES[name]
    done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"case{place}", [*options, "-cross_check"])
    done.require_clean()
    judge_end(done)
    if done.exit:
        return f"| {name} | exit code {done.exit} | | |"
    solver = done.summary["solver"]
    check, friction, steps = solver["cross_check"], solver["friction"], done.summary.get("steps", [])
    iterations = [step["iterations"] for step in steps] or [solver["iterations"]]
    require(not check["converged"] or check["displacement_difference"] < AGREE, f"the second solution differs: {check}")
    second = f"{check['displacement_difference']:.0e}" if check["converged"] else "none found"
    return f"| {name} | {max(iterations)} | {friction['rho']:.3g} | {second} |"


def judge(run):
    rows, failures = [], []
    for place, name in list(enumerate(CASES))[:: 1 if LONG else 2 if run.ranks == 1 else 3]:
        try:
            rows.append(judge_case(run, place, name))
        except Exception as failure:  # all of them are told at once
            failures.append(f"{name} (case{place}): {failure}")
    (run.folder / "hard.table.txt").write_text("\n".join(rows) + "\n")
    require(not failures, "\n".join(failures))
    require(len(CASES) == 30, f"{len(CASES)} cases")
