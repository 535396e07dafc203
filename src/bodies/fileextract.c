/* fileextract.c -- see the header. */
#include "base/compat.h"
#include "bodies/fileextract.h"
#include "kernel/vector.h"

PetscErrorCode LabelGetPoints(DM dm, const char name[], PetscInt tag, PetscInt *num, PetscInt **points)
{
  const PetscInt *indices;
  DMLabel         label;
  IS              is = NULL;

  PetscFunctionBeginUser;
  *num    = 0;
  *points = NULL;
  PetscCall(DMGetLabel(dm, name, &label));
  if (label && tag < 0)
    PetscCall(DMLabelGetValueIS(label, &is));
  else if (label)
    PetscCall(DMLabelGetStratumIS(label, tag, &is));
  if (!is) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ISGetLocalSize(is, num));
  PetscCall(PetscMalloc1(*num, points));
  PetscCall(ISGetIndices(is, &indices));
  PetscCall(PetscArraycpy(*points, indices, *num));
  PetscCall(ISRestoreIndices(is, &indices));
  PetscCall(ISDestroy(&is));
  PetscCall(PetscSortInt(*num, *points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractFindOther(const Extract *x, PetscInt wanted, const char group[], const char **kind)
{
  static const char *const kinds[] = {"point", "curve", "surface", "volume"}; /* by dimension, as Gmsh calls them */
  const PetscInt           dim     = x->level.dim;

  PetscFunctionBeginUser;
  *kind = NULL;
  for (PetscInt d = 0; d <= dim; d++) {
    PetscInt tag, size = 0;

    if (d == wanted || !GmshNamesFindGroup(x->names, d, group, &tag)) continue;
    if (d >= dim - 1) PetscCall(DMGetStratumSize(x->level.dm, d == dim ? "Cell Sets" : "Face Sets", tag, &size));
    if (size || GmshNamesHas(x->names, d, group)) *kind = kinds[d];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
