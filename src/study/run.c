/* run.c -- one problem from its mesh to its certificate. */
#include "base/compat.h"
#include "base/log.h"
#include "study/run.h"
#include "base/warning.h"
#include "study/reachcheck.h"

enum {
  MAX_TRIES = 4
}; /* a wider reach has the bodies move less or somewhere else; four times somewhere else is not to be expected */

/* Solves and judges. [out] again - whether a wider reach is needed */
static PetscErrorCode RunSolve_Private(Run run, Vec guess, PetscBool *again)
{
  const Scene scene = run->scene;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SOLVE));
  PetscCall(VecDuplicate(run->vi->b, &run->y));
  PetscCall(SolverSolve(run->solver, guess, run->y, &run->report));
  if (scene->cross_check && run->report.converged)
    PetscCall(SolverCrossCheck(run->solver, run->y, &run->report, &run->check));
  PetscCall(LogStageEnd(STAGE_SOLVE));
  if (scene->measure_linear && run->report.converged) PetscCall(SolverSolveLinear(run->solver, run->y, &run->report));
  PetscCall(SceneCheckUnused(scene, PETSC_FALSE));

  PetscCall(LogStageBegin(STAGE_OUTPUT));
  PetscCall(FieldsCreate(run->vi, run->solvability, run->y, &run->fields));
  PetscCall(CertificateCompute(run->fields, &run->certificate, &run->reactions));
  PetscCall(LogStageEnd(STAGE_OUTPUT));
  if (run->certificate.holds) PetscCall(ReachCheckRun(run, again));
  PetscCall(ErrorsCompute(run->fields, &run->errors)); // in no stage: it is not part of a solution
  /* a second solver that finds nothing says nothing against the first, which has its certificate: that is a warning */
  run->solved = (PetscBool)(run->report.converged && run->certificate.holds &&
                            (!run->check.done || !run->check.other.converged || run->check.agree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nothing is solved where there is no solution, and nothing is known. */
static PetscErrorCode RunRefuse_Private(Run run)
{
  const Solvability s = run->solvability;
  Certificate      *c = &run->certificate;

  PetscFunctionBeginUser;
  c->equilibrium = c->gap = c->pressure = c->complementarity = c->force = c->moment = c->pair_moment = c->pull =
      c->energy_norm = c->limit = NAN;
  run->report.linear_residual = run->report.bound.value = NAN;
  PetscCall(PetscSNPrintf(run->report.reason, sizeof(run->report.reason), "there is no solution%s: %s",
                          s->coarse ? " on this mesh" : "", s->motion.sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One try, with pairs that reach as far as the scene says. */
static PetscErrorCode RunCreateOnce_Private(Scene scene, Mesh mesh, Vec guess, Run *run_out, PetscBool *again)
{
  Run run;

  PetscFunctionBeginUser;
  *again = PETSC_FALSE;
  WarningBeginRun();
  PetscCall(PetscNew(&run));
  run->scene = scene;
  run->mesh  = mesh;
  PetscCall(VICreate(scene, mesh, &run->vi));
  PetscCall(SolvabilityCreate(run->vi, &run->solvability));
  PetscCall(SolverCreate(run->vi, run->solvability, &run->solver));
  if (scene->view) {
    PetscCall(SceneView(scene));
    PetscCall(MeshViewPrint(run->vi, run->solvability));
    PetscCall(SolverView(run->solver));
  }
  PetscCall(ErrorsCheck(run->vi));
  run->refused = (PetscBool)(run->solvability && run->solvability->status == SOLVABLE_NOT);
  if (run->refused)
    PetscCall(RunRefuse_Private(run));
  else
    PetscCall(RunSolve_Private(run, guess, again));
  *run_out = run;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunCreate(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  SummaryInput known;
  PetscBool    again;

  PetscFunctionBeginUser;
  PetscCall(RunCreateOnce_Private(scene, mesh, guess, run, &again));
  for (PetscInt tries = 1; again && tries < MAX_TRIES; tries++) {
    PetscCall(RunDestroy(run));
    PetscCall(RunCreateOnce_Private(scene, mesh, guess, run, &again));
  }
  if (again) {
    (*run)->solved            = PETSC_FALSE;
    (*run)->certificate.holds = PETSC_FALSE;
    PetscCall(PetscStrncpy((*run)->certificate.failure,
                           "contact was missed: bodies moved farther than -<pair>_reach in each of 4 attempts; give "
                           "the pairs a larger -<pair>_reach",
                           sizeof((*run)->certificate.failure)));
  }
  known = RunSummary(*run);
  PetscCall(SummaryWarn(&known));
  WarningEndRun();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunDestroy(Run *run)
{
  PetscFunctionBeginUser;
  if (!*run) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDestroy(&(*run)->reactions));
  PetscCall(VecDestroy(&(*run)->y));
  PetscCall(ErrorsDestroy(&(*run)->errors));
  PetscCall(FieldsDestroy(&(*run)->fields));
  PetscCall(SolverDestroy(&(*run)->solver));
  PetscCall(SolvabilityDestroy(&(*run)->solvability));
  PetscCall(VIDestroy(&(*run)->vi));
  PetscCall(PetscFree(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

SummaryInput RunSummary(Run run)
{
  return (SummaryInput){.scene       = run->scene,
                        .mesh        = run->mesh,
                        .vi          = run->vi,
                        .solvability = run->solvability,
                        .fields      = run->fields,
                        .report      = &run->report,
                        .check       = &run->check,
                        .certificate = &run->certificate,
                        .errors      = &run->errors,
                        .reactions   = run->reactions,
                        .solved      = run->solved};
}
