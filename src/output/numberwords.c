/* numberwords.c -- numbers in sentences. */
#include <string.h>
#include "base/compat.h"
#include "output/numberwords.h"

PetscErrorCode NumberWordsVector(PetscInt dim, const PetscReal v[], char text[], size_t len)
{
  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(text, "(", len));
  for (PetscInt k = 0; k < dim; k++) {
    const size_t used = strlen(text);

    PetscCall(PetscSNPrintf(text + used, len - used, "%s%.6g%s", k ? ", " : "", (double)v[k], k == dim - 1 ? ")" : ""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
