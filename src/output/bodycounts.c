/* bodycounts.c -- cells and nodes of each body. */
#include "base/compat.h"
#include "output/bodycounts.h"

PetscErrorCode BodyCountsCompute(const Level *level, PetscInt num_bodies, BodyCount counts[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(counts, num_bodies));
  for (PetscInt c = 0; c < level->num_cells; c++) counts[level->cell_body[c]].cells++;
  for (PetscInt a = 0; a < level->num_owned; a++) counts[level->node_body[a]].nodes++;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, (PetscMPIInt)(2 * num_bodies), MPIU_INT, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
