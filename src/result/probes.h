/* probes.h -- displacement and stress at probes. */
#ifndef MORTISE_PROBES_H
#define MORTISE_PROBES_H

#include "result/fields.h"

/* Displacement and averaged stress at a probe, interpolated by the shape functions of the cell that holds it.
   Collective; the same on all ranks. [out] u - [3], absent components 0; [out] stress - [6] */
PetscErrorCode ProbesEvaluate(Fields fields, const SceneProbe *probe, PetscReal u[3], PetscReal stress[6]);
/* The same at any place of a body. [out] found - whether the body has it; else numbers are 0. Collective. */
PetscErrorCode ProbesTry(Fields fields, PetscInt body, const PetscReal at[], PetscReal u[3], PetscReal stress[6],
                         PetscBool *found);
/* User errors: a path or a probe outside its body. Call it before the solve, so that no work is lost.
   Collective. */
PetscErrorCode ProbesCheck(Scene scene, Mesh mesh);

#endif
