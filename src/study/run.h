/* run.h -- one problem from its mesh to its certificate. */
#ifndef MORTISE_RUN_H
#define MORTISE_RUN_H

#include "result/certificate.h"
#include "result/energybalance.h"
#include "result/errors.h"
#include "result/fields.h"
#include "checks/setupcheck.h"
#include "solve/infsup.h"
#include "solve/solver.h"
#include "output/summary.h"

struct _n_Run {
  Scene       scene; /* borrowed */
  Mesh        mesh;  /* borrowed */
  VI          vi;
  Solvability solvability; /* NULL where supports hold all bodies */
  Solver      solver;
  Vec         y;
  struct {
    Vec       u; /* displacement, or NULL */
    Vec       b; /* right-hand side of the inequality, with friction, or NULL */
    PetscReal t;
  } past[2];             /* the last solutions, the latest first */
  EnergyState   energy;  /* with friction and load steps: the end of the last solved step */
  EnergyBalance balance; /* of the present step */
  SolverReport  report;
  CrossCheck    check;
  InfSup       *inf_sup; /* with -infsup [vi->num_pairs], else NULL */
  Fields        fields;
  Certificate   certificate;
  Vec           reactions;
  Errors        errors;
  cJSON        *estimate, *bars; /* blocks of the summary, or NULL */
  SetupCheck    setup;           /* with -check */
  PetscBool     checked;         /* with -check: nothing is solved, and there are no fields */
  PetscBool     refused;         /* there is no solution: nothing is solved, and there are no fields */
  PetscBool     solved;          /* converged, certified, and not contradicted by a second solver */
};
typedef struct _n_Run *Run;

/* Condenses, solves and judges on the finest level of a mesh; prints the model where -scene_view asks for it.
   User errors: options that nothing has read; a pair without partner; those of VICreate() and of exact
   solutions. Collective.
   [in] guess - initial guess of the displacement (ghosted, dim per node of that level), or NULL;
   [out] run - owned by the caller */
PetscErrorCode RunCreate(Scene scene, Mesh mesh, Vec guess, Run *run);
/* Collective. */
PetscErrorCode RunDestroy(Run *run);
/* RunCreate() after a load step of another run of the same mesh: slip counts from there. Collective.
   [in] last - displacement of that step, ghosted; [in] t - its time */
PetscErrorCode RunCreateAfter(Scene scene, Mesh mesh, Vec last, PetscReal t, Run *run);
/* RunCreate(), but pretensions keep the strains of earlier solutions. Collective. */
PetscErrorCode RunCreateTightened(Scene scene, Mesh mesh, Vec guess, Run *run);
/* Replaces the run by one on the new finest level of MeshAdapt(). It takes over the scales, and the coarser
   levels of multigrid with their matrices, smoothers and transfer. Collective.
   [in] guess - as of RunCreate(), not a Vec of the run;
   [in,out] run */
PetscErrorCode RunExtend(Vec guess, Run *run);
/* Solves and judges once more, after a change of time or data of the scene (SceneSetTime(), SceneSetDatum()).
   Keeps matrices, factors, levels and contact as far as scene->changed allows. If the stiffness changes, or
   -<pair>_reach is too small, it is RunCreate(). Collective.
   [in] guess - initial guess of the displacement; NULL: extrapolated from the last solutions;
   [in,out] run */
PetscErrorCode RunAdvance(Vec guess, Run *run);
/* Why a run is not solved, as a sentence. Not collective. Borrowed from the run */
const char *RunGetFailure(Run run);
/* Deletes the blocks "estimate" and "bars". Not collective. */
void RunForgetBlocks(Run run);
/* The input of the summary, borrowed from the run. Not collective. */
SummaryInput RunSummary(Run run);

#endif
