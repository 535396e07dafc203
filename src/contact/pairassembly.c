/* pairassembly.c -- see the header. */
#include "base/compat.h"
#include "contact/pairassembly.h"

PetscErrorCode PairAssemblyDestroy(PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(MortarIntegralsDestroy(&assembly->sums));
  PetscCall(VecDestroy(&assembly->normals));
  PetscCall(VecDestroy(&assembly->directions));
  PetscCall(SideShapeDestroy(&assembly->shape));
  PetscCall(PetscFree(assembly->rises));
  PetscCall(FacetsDestroy(&assembly->nonmortar));
  PetscCall(PetscFree(assembly->status));
  PetscFunctionReturn(PETSC_SUCCESS);
}
