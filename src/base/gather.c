/* gather.c -- see the header. */
#include "base/gather.h"
#include "base/compat.h"

PetscErrorCode GatherEntries(Vec x, PetscInt num, const PetscInt entry[], Vec *some)
{
  IS         which;
  VecScatter scatter;

  PetscFunctionBeginUser;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num, some));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, entry, PETSC_USE_POINTER, &which));
  PetscCall(VecScatterCreate(x, which, *some, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, x, *some, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, x, *some, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(ISDestroy(&which));
  PetscFunctionReturn(PETSC_SUCCESS);
}
