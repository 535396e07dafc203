/* numberwords.c -- numbers in sentences. */
#include <string.h>
#include "base/compat.h"
#include "output/numberwords.h"

/* Components below this part of a size are roundoff, and are shown as 0. */
static const PetscReal ROUNDING = 1e-12;

PetscErrorCode NumberWordsVectorBeside(PetscInt dim, const PetscReal v[], PetscReal size, char text[], size_t len)
{
  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(text, "(", len));
  for (PetscInt k = 0; k < dim; k++) {
    const size_t    used  = strlen(text);
    const PetscReal value = PetscAbsReal(v[k]) > ROUNDING * size ? v[k] : 0;

    PetscCall(
        PetscSNPrintf(text + used, len - used, "%s%.6g%s", k ? ", " : "", (double)value, k == dim - 1 ? ")" : ""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NumberWordsVector(PetscInt dim, const PetscReal v[], char text[], size_t len)
{
  PetscReal size = 0;

  for (PetscInt k = 0; k < dim; k++) size = PetscMax(size, PetscAbsReal(v[k]));
  return NumberWordsVectorBeside(dim, v, size, text, len);
}
