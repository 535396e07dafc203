/* axis.c -- the axis of revolution, x = 0 of an axisymmetric scene. */
#include "refinement/refinementimpl.h"
#include "base/compat.h"
#include "base/usererror.h"

/* Roundoff of maps and files at r = 0, as a part of the largest radius of the scene. */
static const PetscReal AXIS_ROUNDOFF = 1e-10;

PetscErrorCode LevelSetAxis(Level *level)
{
  const PetscInt dim                         = level->dim;
  char           sentence[USER_ERROR_LENGTH] = "";
  PetscReal      largest                     = 0;

  PetscFunctionBeginUser;
  if (level->scene->model != MODEL_AXISYMMETRIC) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt node = 0; node < level->num_nodes; node++)
    largest = PetscMax(largest, PetscAbsReal(level->coords[node * dim]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, level->comm));
  for (PetscInt node = 0; node < level->num_nodes && !sentence[0]; node++) {
    PetscReal *x = &level->coords[node * dim];

    if (PetscAbsReal(x[0]) <= AXIS_ROUNDOFF * largest) x[0] = 0;
    if (x[0] >= 0) continue;
    snprintf(sentence, sizeof(sentence),
             "-model axisymmetric: body '%s' crosses the axis of revolution, to r = %g at z = %g; bodies lie in r >= "
             "0, where r is x and z is y",
             level->scene->bodies[level->node_body[node]].name, (double)x[0], (double)x[1]);
  }
  PetscCall(UserErrorCheck(level->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}
