/* apiimpl.h -- the data of a handle, and the frame of every call of the public interface. */
#ifndef API_IMPL_H
#define API_IMPL_H

#include <cjson/cJSON.h>
#include <mortise.h>
#include "base/usererror.h"
#include "base/warning.h"
#include "study/run.h"

/* Values of one pair at the nodes of this rank, made when they are asked for. */
typedef struct {
  PetscBool  known;
  PairFields nodal;
  Vec        pressure, gap;
} PairValues;

/* Everything behind `options` is empty where there is nothing yet. */
struct _p_Mortise {
  MPI_Comm     comm;
  char        *prefix;  /* NULL without one */
  PetscOptions options; /* with a prefix: those of the handle, without it; else NULL: PETSc's own */
  PetscReal    time;
  Scene        scene;
  Mesh         mesh; /* NULL for a study */
  Vec          coordinates;
  Run          run;
  PetscBool    solved_once; /* whether there was a solve: verdict counts */
  PetscBool    guess_given; /* whether guess counts instead of the last solutions, NULL for zero */
  PetscBool    several;     /* whether further solutions are to be expected: solvers keep their factors */
  Vec          guess;
  MortiseExit  verdict;
  PairValues  *pairs;   /* [num_pairs] */
  char        *summary; /* malloc() */
  cJSON       *numbers; /* of it */
  WarningLists warnings;
};

/* Surround the body of every public function: errors are reported as in the program, options and warnings are
   those of the handle. ApiEnd() returns error, and ends log stages that an error has left open.
   Not collective. */
PetscErrorCode ApiBegin(Mortise m);
PetscErrorCode ApiEnd(Mortise m, PetscErrorCode error);
/* User error: MortiseInitialize() was not called before, or MortiseFinalize() was. Not collective. */
PetscErrorCode ApiNeedLibrary(const char function[]);
/* The same; or the handle is NULL. Not collective. */
PetscErrorCode ApiNeedHandle(Mortise m, const char function[]);
/* Leaves a public function by that error. PetscCall() would print it where PETSc does not run. */
#define API_VALID(m)                                                                                                   \
  do {                                                                                                                 \
    const PetscErrorCode valid_ = ApiNeedHandle(m, __func__);                                                          \
    if (valid_) PetscFunctionReturn(valid_);                                                                           \
  } while (0)
/* User error: a name is NULL. Collective. [in] what - is named */
PetscErrorCode ApiNeedName(Mortise m, const char function[], const char name[], const char what[]);
/* Whether the caller started PETSc, which then has read its options. Not collective. */
PetscBool ApiJoined(void);
/* User error: MortiseSetFromOptions() was not called. Collective. */
PetscErrorCode ApiNeedScene(Mortise m, const char function[]);
/* User error: MortiseSolve() was not called, or has no single answer. Collective. */
PetscErrorCode ApiNeedRun(Mortise m, const char function[]);

#endif
