"""Hertz' contact in the plane by Mortise and by Kratos (PyPI's KratosContactStructuralMechanicsApplication with KratosLinearSolversApplication): the
same nodes, cells, supports and materials. Processor seconds for a largest pressure to so many percent.

    bykratos.py <mortise> [<refinements>] [--python <interpreter that has Kratos>]

Scene, mesh and reference are those of calculix.py. Kratos takes cells of order 1 (its contact knows no others). It has small displacements,
augmented Lagrangian mortar contact with dual multipliers, its own penalty and scale, and the sparse LU of Eigen. It looks for partners once at
the beginning of a load step. In one step it ends with a zone of contact that is too small, in two it does not. One thread each, processor
seconds with the start of the program."""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile

from calculix import APPROACH, DEPTH, MATERIALS, NEAR, RADIUS, REPEATS, mortise

PARTS = {0: "Disc", 1: "Block"}
STEPS = 2  # of the approach


def write_mesh(folder):
    """result.h5 as Kratos' hertz.mdpa."""
    import h5py
    import numpy as np

    with h5py.File(os.path.join(folder, "result.h5")) as file:
        points, cells, body = file["points"][:, :2], file["cells"][:, :4], file["body"][:]
    x, y = points.T
    of_disc = np.zeros(len(points), bool)
    of_disc[cells[body == 0].ravel()] = True
    near = NEAR * RADIUS
    sides = {"Arc": of_disc & (abs(np.hypot(x, y - RADIUS) - RADIUS) < near), "Top": ~of_disc & (abs(y) < near), "Axis": abs(x) < near,
             "Driven": of_disc & (abs(y - RADIUS) < near), "Bottom": ~of_disc & (abs(y + DEPTH) < near)}
    sides["Touching"] = sides["Arc"] | sides["Top"]
    with open(os.path.join(folder, "hertz.mdpa"), "w", encoding="ascii") as out:
        out.write("Begin ModelPartData\nEnd ModelPartData\nBegin Properties 0\nEnd Properties\n")
        out.write("".join(f"Begin Properties {b + 1}\nEnd Properties\n" for b in PARTS) + "Begin Nodes\n")
        out.writelines(f"{i + 1} {p[0]:.16e} {p[1]:.16e} 0\n" for i, p in enumerate(points))
        out.write("End Nodes\nBegin Elements SmallDisplacementElement2D4N\n")
        out.writelines(f"{c + 1} {body[c] + 1} {' '.join(str(n + 1) for n in cell)}\n" for c, cell in enumerate(cells))
        out.write("End Elements\n")
        for b, name in PARTS.items():
            mine = np.flatnonzero(body == b)
            out.write(f"Begin SubModelPart {name}\nBegin SubModelPartNodes\n" + "".join(f"{n + 1}\n" for n in np.unique(cells[mine]))
                      + "End SubModelPartNodes\nBegin SubModelPartElements\n" + "".join(f"{c + 1}\n" for c in mine)
                      + "End SubModelPartElements\nEnd SubModelPart\n")
        for name, inside in sides.items():
            out.write(f"Begin SubModelPart {name}\nBegin SubModelPartNodes\n" + "".join(f"{n + 1}\n" for n in np.flatnonzero(inside))
                      + "End SubModelPartNodes\nEnd SubModelPart\n")


def support(part, component, value):
    fixed, values = [False] * 3, [None] * 3
    fixed[component], values[component] = True, value
    return {"python_module": "assign_vector_variable_process", "kratos_module": "KratosMultiphysics", "process_name": "AssignVectorVariableProcess",
            "Parameters": {"model_part_name": f"Structure.{part}", "variable_name": "DISPLACEMENT", "constrained": fixed, "value": values}}


def write_parameters(folder):
    materials = [{"model_part_name": f"Structure.{name}", "properties_id": b + 1, "Material": {
        "constitutive_law": {"name": "LinearElasticPlaneStrain2DLaw"},
        "Variables": {"YOUNG_MODULUS": MATERIALS[b][0], "POISSON_RATIO": MATERIALS[b][1], "THICKNESS": 1.0, "DENSITY": 1.0}, "Tables": {}}}
        for b, name in PARTS.items()]
    parameters = {
        "problem_data": {"problem_name": "hertz", "parallel_type": "OpenMP", "start_time": 0.0, "end_time": 1 - 0.5 / STEPS, "echo_level": 0},
        "solver_settings": {
            "solver_type": "Static", "model_part_name": "Structure", "domain_size": 2, "echo_level": 0, "analysis_type": "non_linear",
            "time_stepping": {"time_step": 1 / STEPS}, "rotation_dofs": False, "max_iteration": 50,
            "model_import_settings": {"input_type": "mdpa", "input_filename": "hertz"},
            "material_import_settings": {"materials_filename": "materials.json"},
            "contact_settings": {"mortar_type": "ALMContactFrictionless"},
            "convergence_criterion": "contact_residual_criterion", "residual_relative_tolerance": 1e-8, "residual_absolute_tolerance": 1e-10,
            "linear_solver_settings": {"solver_type": "LinearSolversApplication.sparse_lu"}},
        "processes": {
            "constraints_process_list": [support("Axis", 0, 0.0), support("Bottom", 1, 0.0), support("Driven", 1, f"{-APPROACH}*t")],
            "contact_process_list": [{
                "python_module": "alm_contact_process", "kratos_module": "KratosMultiphysics.ContactStructuralMechanicsApplication",
                "process_name": "ALMContactProcess",
                "Parameters": {"model_part_name": "Structure", "contact_model_part": {"0": ["Touching"]}, "assume_master_slave": {"0": ["Arc"]},
                               "contact_type": "Frictionless"}}]}}
    for name, content in (("materials", {"properties": materials}), ("parameters", parameters)):
        with open(os.path.join(folder, name + ".json"), "w", encoding="ascii") as file:
            json.dump(content, file)


def by_kratos(folder, python):
    """Median seconds and the largest pressure."""
    seconds = []
    for _ in range(REPEATS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([python, os.path.join(os.path.dirname(os.path.abspath(__file__)), "kratossolve.py")], cwd=folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            sys.exit(f"kratos: {done.stdout[-2500:]}{done.stderr[-1500:]}")
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return statistics.median(seconds), float(done.stdout.split()[-1])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("refinements", nargs="?", type=int, default=2)
    parser.add_argument("--python", default=sys.executable)
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    with tempfile.TemporaryDirectory() as folder:
        _, _, reference = mortise(program, folder, 2, arguments.refinements + 1, 1)
        write_parameters(folder)
        print(f"largest pressure {reference:.5g}\n\n| unknowns | Mortise s | error % | Kratos s | error % | times as long |\n|---:|---:|---:|---:|---:|---:|")
        for refinements in range(arguments.refinements + 1):
            time, unknowns, pressure = mortise(program, folder, 1, refinements)
            write_mesh(folder)
            theirs, found = by_kratos(folder, arguments.python)
            errors = [100 * abs(p / reference - 1) for p in (pressure, found)]
            print(f"| {unknowns} | {time:.2f} | {errors[0]:.2g} | {theirs:.2f} | {errors[1]:.2g} | {theirs / time:.0f} |", flush=True)


if __name__ == "__main__":
    main()
