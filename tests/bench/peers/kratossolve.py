"""Solves parameters.json of this folder with Kratos' interpreter; prints the largest contact pressure on the last line (see bykratos.py)."""
import sys

import KratosMultiphysics as kratos
import KratosMultiphysics.ContactStructuralMechanicsApplication as contact
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

with open("parameters.json", encoding="ascii") as file:
    parameters = kratos.Parameters(file.read())
steps = parameters["solver_settings"]["max_iteration"].GetInt()
model = kratos.Model()
StructuralMechanicsAnalysis(model, parameters).Run()
if model["Structure"].ProcessInfo[kratos.NL_ITERATION_NUMBER] >= steps:
    sys.exit(f"no solution after {steps} steps")
print(model["Structure"].ProcessInfo[kratos.NL_ITERATION_NUMBER])
print(max(abs(node.GetValue(contact.AUGMENTED_NORMAL_CONTACT_PRESSURE)) for node in model["Structure.Arc"].Nodes))
