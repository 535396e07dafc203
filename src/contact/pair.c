/* pair.c -- see the header. */
#include "base/compat.h"
#include "contact/pair.h"
#include "contact/pairpoints.h"

PetscErrorCode PairDestroy(Pair *pair)
{
  PetscFunctionBeginUser;
  if (!*pair) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PairPointsDestroy(&(*pair)->points));
  PetscCall(MatDestroy(&(*pair)->M));
  PetscCall(MatDestroy(&(*pair)->arm));
  PetscCall(MatDestroy(&(*pair)->passed));
  PetscCall(MatDestroy(&(*pair)->D_other));
  PetscCall(MatDestroy(&(*pair)->to_nodal));
  PetscCall(MatDestroy(&(*pair)->from_nodal));
  PetscCall(PetscFree4((*pair)->partly_covered, (*pair)->fully_covered, (*pair)->overlap, (*pair)->cover));
  PetscCall(PetscFree((*pair)->share));
  PetscCall(PetscFree((*pair)->slides));
  PetscCall(PetscFree((*pair)->beyond));
  PetscCall(PetscFree((*pair)->boundary));
  PetscCall(PetscFree((*pair)->oblique));
  PetscCall(PetscFree5((*pair)->nodes, (*pair)->D, (*pair)->gap, (*pair)->normal, (*pair)->frame));
  PetscCall(PetscFree(*pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}
