/* adaptiveimpl.h -- declarations that the files of the adaptive loop share. */
#ifndef MORTISE_ADAPTIVEIMPL_H
#define MORTISE_ADAPTIVEIMPL_H

#include "study/adaptive.h"
#include "study/costforecast.h"
#include "study/envelope.h"

enum {
  ADAPTIVE_TEXT = 512, /* of a sentence */
  KEPT_RUNS     = 4    /* meshes of a load step beside the latest one: bars compare five */
};

/* A run on an earlier mesh. */
typedef struct {
  Run      run;
  PetscInt num_levels; /* of its mesh */
} OlderRun;

struct _n_Adaptive {
  Scene        scene; /* borrowed */
  Mesh         mesh;  /* borrowed */
  MeshHistory  own;
  Envelope     envelope; /* with load steps that are all solved on each mesh, else empty */
  MeshHistory *history;  /* own, or that of the envelope's worst step */
  PetscInt     first;    /* meshes before those of the history */
  PetscInt     num_older;
  OlderRun     older[KEPT_RUNS]; /* with load steps, coarse first */
  CostPoint    cost[2];          /* of the latest two meshes, the latest first */
  PetscReal    memory;           /* of all ranks, at most: as asked for, or what the system has */
  PetscReal    rate;             /* of errors in the number of unknowns */
  PetscBool    quiet;
  PetscInt     levels;                 /* with an envelope: of the mesh that all steps were solved on last */
  PetscReal    end;                    /* time at which the last step of the envelope ended, or all work before */
  PetscReal    kept;                   /* time at which files were written last */
  PetscReal   *indicators;             /* of goals on the latest mesh, GoalsSolve() */
  PetscBool    dual;                   /* whether their dual problems are solved */
  PetscInt    *marked;                 /* cells of the latest mesh that the next one refines */
  PetscReal    growth;                 /* expected with them, of the number of cells */
  char         failure[ADAPTIVE_TEXT]; /* why the mesh after the latest one was not solved; "" where none failed */
};

/* --- adaptiveend.c: when the loop ends, and with what --- */

/* The latest solved mesh. Not collective. Borrowed. */
const SolvedMesh *AdaptiveGetLast(const struct _n_Adaptive *adaptive);
/* Whether the error in the energy norm is as small as asked for; whether all errors are. Not collective. */
PetscBool AdaptiveEnergyIsMet(const struct _n_Adaptive *adaptive);
PetscBool AdaptiveIsMet(const struct _n_Adaptive *adaptive);
/* Whether the latest mesh is the last one. Not collective.
   [out] why - "" where the error is small enough [ADAPTIVE_TEXT] */
PetscBool AdaptiveIsOver(const struct _n_Adaptive *adaptive, char why[]);
/* Writes the reason why errors are larger than asked for to the report. Not collective.
   [in] why - "" where they are not */
PetscErrorCode AdaptiveSetVerdict(const struct _n_Adaptive *adaptive, Run run, const char why[]);
/* Sets the sentence of an interruption. Not collective. [in] kept - whether files have the latest mesh */
void AdaptiveSetInterruptSentence(const struct _n_Adaptive *adaptive, PetscBool kept);
/* Writes the files of a mesh that is not the last one, unless little work would be lost without them.
   Collective. */
PetscErrorCode AdaptiveKeep(Adaptive adaptive, Run run);
/* Ends an attempt on a new mesh, begun by UserErrorMute(). A user error, which all ranks know of, is
   forgiven; others are raised. Collective. [out] failed - whether there was a user error */
PetscErrorCode AdaptiveForgive(PetscErrorCode error, PetscBool *failed);
/* Keeps the reason why a new mesh was not solved. Not collective.
   [in] number - of that mesh, from 1;
   [in] run - on that mesh, or NULL: the last user error is the reason */
void AdaptiveSetFailure(Adaptive adaptive, PetscInt number, Run run);
/* After a failure: makes the run of the latest solved mesh once more, from its solution, with the blocks
   "estimate" and "bars" and the failure as its verdict. Collective.
   [in] last - that solution; [in] levels - of its mesh;
   [in,out] run - on the new mesh, or NULL; the run of the latest solved mesh is kept */
PetscErrorCode AdaptiveReturn(Adaptive adaptive, Vec last, PetscInt levels, Run *run);

#endif
