"""A semicircular arch of voussoirs with friction in all joints under its own weight. By statics of rigid blocks it stands exactly if some thrust H at
the crown, at some height, lies within every joint and every cone of friction. The program refuses what is below that coefficient, and solves what is
above it."""
import math

from judge import Run, near, require

BLOCKS, INNER, THICK = 9, 1.0, 1.4  # radii
CELLS = "2,4"  # along the arch, across


def places():
    """Angles of the joints from the left springing to the right one."""
    return [math.pi * k / BLOCKS for k in range(BLOCKS + 1)]


def point(radius, angle):
    return -radius * math.cos(angle), radius * math.sin(angle)


def moments(first, last, outer):
    """Area of a voussoir with straight faces, and x of its centroid times that."""
    corners = [point(INNER, first), point(INNER, last), point(outer, last), point(outer, first)]
    area = moment = 0
    for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
        cross = x0 * y1 - x1 * y0
        area += cross / 2
        moment += cross * (x0 + x1) / 6
    return abs(area), moment * math.copysign(1, area)


def half(outer):
    """(angle from the crown, weight, moment about the middle) of all that lies between the crown and a joint on the right."""
    angles, found = places(), []
    end, flat = angles[BLOCKS // 2 + 1], math.sin(angles[BLOCKS // 2])
    corners = [(0, INNER * flat), point(INNER, end), point(outer, end), (0, outer * flat)]
    area = moment = 0
    for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
        cross = x0 * y1 - x1 * y0
        area, moment = area + cross / 2, moment + cross * (x0 + x1) / 6
    weight, moment = abs(area), abs(moment)
    found.append((end - math.pi / 2, weight, moment))
    for k in range(BLOCKS // 2 + 1, BLOCKS):
        more, turn = moments(angles[k], angles[k + 1], outer)
        weight, moment = weight + more, moment + turn
        found.append((angles[k + 1] - math.pi / 2, weight, moment))
    return found


def needed(thrust, joints, outer):
    """Coefficient that a thrust needs, infinity where no height of it stays within all joints."""
    low, high, slope = -math.inf, math.inf, 0  # no joint is at the crown: the thrust may leave the block there
    for angle, weight, moment in joints:  # (thrust height + moment) / normal is the radius of the resultant
        normal = thrust * math.cos(angle) + weight * math.sin(angle)
        low, high = max(low, (INNER * normal - moment) / thrust), min(high, (outer * normal - moment) / thrust)
        slope = max(slope, abs(weight * math.cos(angle) - thrust * math.sin(angle)) / normal)
    return slope if low <= high else math.inf


def limit(outer):
    """The least coefficient, infinity where the arch is too thin."""
    joints = half(outer)
    total = joints[-1][1]
    return min(needed(total * k / 20000, joints, outer) for k in range(1, 20000))


def thinnest():
    """The least outer radius, with any friction."""
    low, high = INNER, THICK
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (low, middle) if limit(middle) < math.inf else (middle, high)
    return high


def scene(mu, outer):
    angles = places()
    names = [f"v{k}" for k in range(BLOCKS)]
    options = {"model": "plane_strain", "bodies": ",".join(names)}
    for k, name in enumerate(names):
        (c0, s0), (c1, s1) = [(-math.cos(a), math.sin(a)) for a in angles[k:k + 2]]
        options |= {f"{name}_dm_plex_simplex": "0", f"{name}_dm_plex_box_faces": CELLS, f"{name}_dm_plex_box_lower": f"0,{INNER}", f"{name}_dm_plex_box_upper": f"1,{outer!r}",
                    f"{name}_map": f"y*({c1!r}*x+({c0!r})*(1-x)), y*({s1!r}*x+({s0!r})*(1-x))", f"{name}_young": "1e6", f"{name}_poisson": "0.2", f"{name}_body_force": "0,-1"}
    pairs = ["west", *(f"j{k}" for k in range(1, BLOCKS)), "east"]
    options["pairs"] = ",".join(pairs)
    for end, side in (("west", "v0:left"), ("east", f"v{BLOCKS - 1}:right")):
        options |= {f"{end}_nonmortar": side, f"{end}_obstacle": "plane", f"{end}_obstacle_normal": "0,1"}
    for k in range(1, BLOCKS):
        options |= {f"j{k}_nonmortar": f"v{k}:left", f"j{k}_mortar": f"v{k - 1}:right", f"j{k}_gap": "0"}
    for pair in pairs:
        options[f"{pair}_friction"] = repr(mu)
    return [word for name, value in options.items() for word in (f"-{name}", value)]


def solve(run, name, mu, outer):
    done = Run(run.program, run.mpiexec, run.ranks, run.folder / name, scene(mu, outer))
    done.require_clean()
    return done


def require_refused(done, told):
    require(done.exit == 2 and "no solution" in done.stderr and "v4" in done.stderr, f"{told}: exit {done.exit}, {done.stderr}")


def require_stands(done, mu, outer, told):
    require(done.exit == 0, f"{told}: exit {done.exit}, {done.stderr}")
    pairs, weight = done.summary["pairs"], half(outer)[-1][1]
    near("both springings carry half", [pairs[end]["force"][1] for end in ("west", "east")], [weight, weight], relative=1e-6)
    thrust = pairs["west"]["force"][0]
    near("thrusts", [pairs["east"]["force"][0]], [-thrust], absolute=1e-6 * weight)
    require(any(needed(abs(thrust) * (1 + part), half(outer), outer) <= mu * (1 + 1e-6) for part in (-1e-6, 0, 1e-6)), f"{told}: thrust {thrust}, weight {weight}")


def judge(run):
    least = limit(THICK)
    for factor in run.some((0.99, 0.3, 2, 1.01)):
        done = solve(run, f"friction{factor}", factor * least, THICK)
        if factor < 1:
            require_refused(done, f"{factor} of the coefficient {least}")
        else:
            require_stands(done, factor * least, THICK, f"{factor} times the coefficient {least}")
    thin = thinnest()
    for part in run.some((0.995, 1.1, 1.005)):
        outer = INNER + part * (thin - INNER)
        done = solve(run, f"thickness{part}", 2.0, outer)
        if part < 1:
            require_refused(done, f"{part} of the thickness {thin - INNER}")
        else:
            require_stands(done, 2.0, outer, f"{part} times the thickness {thin - INNER}")
