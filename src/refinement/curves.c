/* curves.c -- positions of middle nodes on the points of a DM. */
#include "refinement/curves.h"
#include "level/plexpoints.h"
#include "base/compat.h"

PetscErrorCode CurvesDestroy(Curves *curves)
{
  PetscFunctionBeginUser;
  PetscCall(PetscSectionDestroy(&curves->section));
  PetscCall(VecDestroy(&curves->positions));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CurvesGetSize(const Curves *curves, PetscInt *size)
{
  PetscFunctionBeginUser;
  *size = 0;
  if (curves->section) PetscCall(PetscSectionGetStorageSize(curves->section, size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CurvesDistribute(DM dm, PetscSF sf, Curves *curves)
{
  Curves spread;

  PetscFunctionBeginUser;
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &spread.section));
  PetscCall(VecCreate(PETSC_COMM_SELF, &spread.positions));
  PetscCall(DMPlexDistributeField(dm, sf, curves->section, curves->positions, spread.section, spread.positions));
  PetscCall(CurvesDestroy(curves));
  *curves = spread;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CurvesGetNodes(const Curves *curves, const Level *level, PetscReal X[])
{
  const PetscScalar *x;
  PetscInt           begin, end;

  PetscFunctionBeginUser;
  if (!curves->section) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSectionGetChart(curves->section, &begin, &end));
  PetscCall(VecGetArrayRead(curves->positions, &x));
  for (PetscInt p = PetscMax(begin, level->point_begin); p < PetscMin(end, level->point_end); p++) {
    const PetscInt node = PointGetNode(level, p);
    PetscInt       num, offset;

    PetscCall(PetscSectionGetDof(curves->section, p, &num));
    PetscCall(PetscSectionGetOffset(curves->section, p, &offset));
    for (PetscInt d = 0; d < num && node >= 0; d++) X[node * level->dim + d] = PetscRealPart(x[offset + d]);
  }
  PetscCall(VecRestoreArrayRead(curves->positions, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}
