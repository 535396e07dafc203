"""Hertz' contact in the plane by Mortise and by GetFEM (Debian's python3-getfem): the same nodes, cells, supports and materials. Processor seconds
for a largest pressure to so many percent.

    bygetfem.py <mortise> [<refinements>]

Scene, mesh and reference are those of calculix.py. GetFEM takes Lagrange multipliers of the cells' order on the arc, its contact brick for large
sliding by raytracing, and MUMPS. (Its brick for small sliding on meshes that do not match gave 2.4 times the pressure here.) One thread each, processor seconds with the start of the program."""
import os
import resource
import subprocess
import sys
import tempfile

from calculix import APPROACH, DEPTH, MATERIALS, NEAR, RADIUS, REPEATS, mortise

# Our corners, middles of edges and middle in GetFEM's order, x first.
ORDER = {4: [0, 1, 3, 2], 9: [0, 4, 1, 7, 8, 5, 3, 6, 2]}
AUGMENTATION = 1e4  # of the multipliers, in the scene's units; with ten and a hundred times as much Newton's method takes 34 and 40 steps for 24


def solve():
    """In a process of its own: result.h5 here, the largest pressure on stdout."""
    import getfem as gf
    import h5py
    import numpy as np

    with h5py.File("result.h5") as file:
        points, cells, body = file["points"][:, :2], file["cells"][:], file["body"][:]
    order = 1 if cells.shape[1] == 4 else 2
    gf.util("trace level", 0)
    model, fems, meshes, rules = gf.Model("real"), [], [], []
    for b, (young, poisson) in MATERIALS.items():
        mesh = gf.Mesh("empty", 2)
        mine = cells[body == b][:, ORDER[cells.shape[1]]]
        mesh.add_convex(gf.GeoTrans(f"GT_QK(2,{order})"), np.transpose(points[mine], (2, 1, 0)))
        near = NEAR * RADIUS
        on = [lambda p: abs(p[0]) < near,
              (lambda p: abs(p[1] - RADIUS) < near) if b == 0 else (lambda p: abs(p[1] + DEPTH) < near),
              (lambda p: abs(np.hypot(p[0], p[1] - RADIUS) - RADIUS) < near) if b == 0 else (lambda p: abs(p[1]) < near)]
        for region, inside in enumerate(on, 1):
            ids = np.flatnonzero(np.array([inside(p) for p in mesh.pts().T]))
            mesh.set_region(region, mesh.faces_from_pid(ids))
        fem = gf.MeshFem(mesh, 2)
        fem.set_fem(gf.Fem(f"FEM_QK(2,{order})"))
        rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,6)"))
        model.add_fem_variable(f"u{b}", fem)
        model.add_initialized_data(f"lambda{b}", [young * poisson / ((1 + poisson) * (1 - 2 * poisson))])
        model.add_initialized_data(f"mu{b}", [young / (2 * (1 + poisson))])
        model.add_isotropic_linearized_elasticity_brick(rule, f"u{b}", f"lambda{b}", f"mu{b}")
        for region, row, value in ((1, [[1, 0], [0, 0]], [0, 0]), (2, [[0, 0], [0, 1]], [0, -APPROACH if b == 0 else 0])):
            model.add_initialized_data(f"H{b}{region}", np.array(row, float))
            model.add_initialized_data(f"r{b}{region}", value)
            model.add_generalized_Dirichlet_condition_with_multipliers(rule, f"u{b}", fem, region, f"r{b}{region}", f"H{b}{region}")
        fems.append(fem)
        meshes.append(mesh)
        rules.append(rule)
    pressures = gf.MeshFem(meshes[0], 2)
    pressures.set_fem(gf.Fem(f"FEM_QK(2,{order})"))
    model.add_filtered_fem_variable("pressure", pressures, 3)
    model.add_initialized_data("r", [AUGMENTATION])
    brick = model.add_integral_large_sliding_contact_brick_raytracing("r", RADIUS / 10)
    model.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, rules[0], 3, "u0", "pressure")
    model.add_master_contact_boundary_to_large_sliding_contact_brick(brick, rules[1], 3, "u1")
    iterations, converged = model.solve("max_res", 1e-8, "max_iter", 100, "lsolver", "mumps", "lsearch", "simplest")
    if not converged:
        sys.exit(f"no solution after {iterations} Newton steps")
    print(abs(model.variable("pressure")).max())


def getfem(folder):
    """Median seconds and the largest pressure."""
    seconds = []
    for _ in range(REPEATS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([sys.executable, os.path.abspath(__file__), "--solve"], cwd=folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            sys.exit(f"getfem: {done.stdout[-500:]}{done.stderr[-1500:]}")
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return sorted(seconds)[REPEATS // 2], float(done.stdout.split()[-1])


def main():
    program, finest = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 2
    with tempfile.TemporaryDirectory() as folder:
        _, _, reference = mortise(program, folder, 2, finest + 1, 1)
        print(f"largest pressure {reference:.5g}\n\n| order | unknowns | Mortise s | error % | GetFEM s | error % | times as long |\n|---|---:|---:|---:|---:|---:|---:|")
        for order in (1, 2):
            for refinements in range(finest + 1):
                time, unknowns, pressure = mortise(program, folder, order, refinements)
                theirs, found = getfem(folder)
                errors = [100 * abs(p / reference - 1) for p in (pressure, found)]
                print(f"| {order} | {unknowns} | {time:.2f} | {errors[0]:.2g} | {theirs:.2f} | {errors[1]:.2g} | {theirs / time:.0f} |", flush=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["--solve"]:
        solve()
    else:
        main()
