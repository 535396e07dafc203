/* run.h -- one problem from its mesh to its certificate. */
#ifndef MORTISE_RUN_H
#define MORTISE_RUN_H

#include "result/certificate.h"
#include "result/energybalance.h"
#include "result/errors.h"
#include "result/fields.h"
#include "result/setupcheck.h"
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
  cJSON        *estimate, *bars; /* of the summary, with adaptive meshes, or NULL */
  SetupCheck    setup;           /* with -check */
  PetscBool     checked;         /* with -check: nothing was solved, and there are no fields */
  PetscBool     refused;         /* there is no solution: nothing was solved, and there are no fields */
  PetscBool     solved;          /* converged, certified, and not contradicted by a second solver */
};
typedef struct _n_Run *Run;

/* Condenses, solves and judges on the finest level of a mesh; prints the model where -scene_view asks for it. Faults on
   options that nothing has read. Collective.
   [in] guess - displacement to begin with (ghosted, dim per node of that level), or NULL; [out] run - owned by the caller */
PetscErrorCode RunCreate(Scene scene, Mesh mesh, Vec guess, Run *run);
PetscErrorCode RunDestroy(Run *run);
/* The same after a load step of another run, of the same mesh. Collective. [in] last - its displacement, ghosted; t - its time */
PetscErrorCode RunCreateAfter(Scene scene, Mesh mesh, Vec last, PetscReal t, Run *run);
/* The same with bolts as they are: pretensions keep the strains that earlier solutions have found. Collective. */
PetscErrorCode RunCreateTightened(Scene scene, Mesh mesh, Vec guess, Run *run);
/* The run on the new finest level that MeshAdapt() has given the mesh: scales, coarser levels of multigrid with their matrices, smoothers and
   transfer stay; what only the old level had goes. Collective. [in] guess - as of RunCreate(), not a Vec of the run; [in,out] run */
PetscErrorCode RunExtend(Vec guess, Run *run);
/* Solves and judges once more, when the scene has another time or other data (SceneSetTime(), SceneSetDatum()): matrices, factors,
   levels and contact stay as far as scene->changed allows. Where -<pair>_reach turns out too small, or the stiffness changes, it is
   RunCreate(). Collective. [in] guess - displacement to begin with; NULL: extrapolated from the last solutions; [in,out] run */
PetscErrorCode RunAdvance(Vec guess, Run *run);
/* Drops the blocks "estimate" and "bars". Not collective. */
void RunForgetBlocks(Run run);
/* What the summary tells of; borrows from the run. Not collective. */
SummaryInput RunSummary(Run run);

#endif
