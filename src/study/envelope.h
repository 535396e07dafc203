/* envelope.h -- the largest errors of all load steps on the same mesh. */
#ifndef MORTISE_ENVELOPE_H
#define MORTISE_ENVELOPE_H

#include "study/meshhistory.h"

/* Zero means empty. */
typedef struct {
  PetscInt     num;   /* load steps */
  MeshHistory *step;  /* the meshes of each [num], or NULL */
  PetscInt     worst; /* step with the largest relative error on the latest mesh */
  PetscReal   *cell;  /* eta_T^2 / |u|_a^2, the largest of all steps on the latest mesh [num_cells], or NULL */
  Vec         *u;     /* displacements of steps on the latest mesh, NULL where there is none [num] */
} Envelope;

/* Collective. [in] num - of load steps */
PetscErrorCode EnvelopeCreate(PetscInt num, Envelope *envelope);
PetscErrorCode EnvelopeDestroy(Envelope *envelope);
/* Adds a solved step on the latest mesh, and gives its run the blocks "estimate" and "bars". Collective.
   [in] i - index of the step; each mesh begins with step 0; [in] seconds - of the step so far */
PetscErrorCode EnvelopeAdd(Envelope *envelope, PetscInt i, Run run, PetscReal seconds);
/* Forgets the latest mesh, on which not all steps were solved, and the one before, which is to be solved on
   again. Not collective. [out] meshes - before the latest one; if 0, nothing is forgotten */
PetscErrorCode EnvelopeReturn(Envelope *envelope, PetscInt *meshes);
/* Relative error of a step in the energy norm on the latest mesh. Not collective. */
PetscReal EnvelopeGetError(const Envelope *envelope, PetscInt i);
/* Seconds of all steps on the latest mesh. Not collective. */
PetscReal EnvelopeGetSeconds(const Envelope *envelope);
/* Marks cells where the error of any step is large. Collective.
   [in] level - the latest mesh; [in] share, [out] marked, growth - as of MarkingCreate() */
PetscErrorCode EnvelopeMark(const Envelope *envelope, const Level *level, PetscReal share, PetscInt **marked,
                            PetscReal *growth);

#endif
