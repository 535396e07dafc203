/* main.c -- the life of one problem: scene, mesh, inequality, solve, judge, write. */
#include <mortise.h>

static const char help[] = "Mortise: frictionless contact of linearly elastic bodies.\n";

/* Solves the scene of the options; *verdict is the exit code of a run without faults. */
static PetscErrorCode Run(MortiseExit *verdict)
{
  Scene        scene = NULL;
  Mesh         mesh  = NULL;
  VI           vi    = NULL;
  Fields       fields;
  SolveReport  report;
  CrossCheck   check = {.done = PETSC_FALSE};
  Certificate  certificate;
  SummaryInput input;
  Vec          y, reactions;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(SceneCheckUnused(scene, PETSC_TRUE));
  PetscCall(OutputCheck(scene));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(ProbesCheck(scene, mesh));
  PetscCall(LogStageEnd(STAGE_SETUP));

  PetscCall(VICreate(scene, mesh, &vi));
  if (scene->view) {
    PetscCall(SceneView(scene));
    PetscCall(SolveView(vi));
  }
  PetscCall(LogStageBegin(STAGE_SOLVE));
  PetscCall(VecDuplicate(vi->b, &y));
  PetscCall(VISolve(vi, y, &report));
  if (scene->cross_check && report.converged) PetscCall(VICrossCheck(vi, y, &report, &check));
  PetscCall(LogStageEnd(STAGE_SOLVE));
  PetscCall(SceneCheckUnused(scene, PETSC_FALSE));

  PetscCall(LogStageBegin(STAGE_OUTPUT));
  PetscCall(FieldsCreate(vi, y, &fields));
  PetscCall(CertificateCompute(fields, &certificate, &reactions));
  if (scene->output) PetscCall(OutputWrite(fields));
  PetscCall(LogStageEnd(STAGE_OUTPUT));
  input = (SummaryInput){scene, mesh, vi, fields, &report, &check, &certificate, reactions};
  PetscCall(SummaryWrite(&input));
  *verdict = report.converged && certificate.holds && (!check.done || check.agree) ? MORTISE_SOLVED : MORTISE_NOT_CONVERGED;

  PetscCall(VecDestroy(&reactions));
  PetscCall(VecDestroy(&y));
  PetscCall(FieldsDestroy(&fields));
  PetscCall(VIDestroy(&vi));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}
