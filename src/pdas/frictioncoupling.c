/* frictioncoupling.c -- how much a force of friction changes limits of friction elsewhere, by pressures (eq.
   16.8b): the largest sum of sizes in a column of a linear map, by Hager's method [1].

   References: [1] Hager, Condition estimates, 1984. */
#include "pdas/frictionimpl.h"

/* Images of the map. Two or three are enough as a rule. */
enum { COUPLING_IMAGES = 5 };

/* Sum over all ranks. */
static PetscErrorCode FrictionCouplingSum_Private(const FrictionUnits *units, PetscReal *value)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, 1, MPIU_REAL, MPI_SUM, units->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = the unit vector of the largest component of z, unless z.x is as large. [out] last - whether it is */
static PetscErrorCode FrictionCouplingMove_Private(const FrictionUnits *units, const PetscReal z[], PetscReal x[],
                                                   PetscBool *last)
{
  PetscReal   along = 0;
  PetscInt    at    = 0;
  PetscMPIInt rank;
  struct {
    double value;
    int    rank;
  } largest = {.value = -1};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(units->comm, &rank));
  largest.rank = rank;
  for (PetscInt a = 0; a < units->num; a++) {
    along += z[a] * x[a];
    if (PetscAbsReal(z[a]) <= largest.value) continue;
    largest.value = (double)PetscAbsReal(z[a]);
    at            = a;
  }
  PetscCall(FrictionCouplingSum_Private(units, &along));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, units->comm));
  *last = (PetscBool)(largest.value <= along);
  if (*last) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArrayzero(x, units->num));
  if (largest.rank == rank) x[at] = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Decisions by which all units are closed, and slip. [in] turned - across the direction of their slip: in
   space alone */
static void FrictionCouplingPress_Private(FrictionUnits *units, PetscBool turned)
{
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];
    PetscReal     s[FRICTION_TANGENTS], size = 0;

    unit->closed = PETSC_TRUE;
    if (!unit->num) continue;
    for (PetscInt i = 0; i < unit->num; i++) {
      s[i] = units->y[unit->tangent[i]] - unit->origin[i];
      size += PetscSqr(s[i]);
    }
    size = PetscSqrtReal(size);
    for (PetscInt i = 0; i < unit->num && size > 0; i++) unit->direction[i] = s[i] / size;
    if (turned && unit->num > 1) {
      const PetscReal first = unit->direction[0];

      unit->direction[0] = -unit->direction[1];
      unit->direction[1] = first;
    }
    unit->status  = UNIT_SLIP;
    unit->turning = 0;
  }
}

/* The norm of the map of the present decisions. [in,out] coupling - the largest one so far */
static PetscErrorCode FrictionCouplingEstimate_Private(FrictionMethod method, FrictionMap map, FrictionMap transposed,
                                                       PetscReal *coupling)
{
  const FrictionUnits *units = &method->units;
  PetscReal           *x, *y, *z, count = 0;
  PetscBool            last = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(units->num, &x, units->num, &y, units->num, &z));
  for (PetscInt a = 0; a < units->num; a++) count += units->unit[a].num > 0;
  PetscCall(FrictionCouplingSum_Private(units, &count));
  for (PetscInt a = 0; a < units->num; a++) x[a] = units->unit[a].num > 0 ? 1 / count : 0;
  for (PetscInt k = 0; k < COUPLING_IMAGES && !last; k++) {
    PetscReal sum = 0;

    PetscCall((*map)(method, x, y));
    for (PetscInt a = 0; a < units->num; a++) sum += PetscAbsReal(y[a]);
    PetscCall(FrictionCouplingSum_Private(units, &sum));
    *coupling = PetscMax(*coupling, sum);
    for (PetscInt a = 0; a < units->num; a++) y[a] = y[a] < 0 ? -1 : 1;
    PetscCall((*transposed)(method, y, z));
    PetscCall(FrictionCouplingMove_Private(units, z, x, &last));
  }
  PetscCall(PetscFree3(x, y, z));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionCoupling(FrictionMethod method, PetscErrorCode (*prepare)(FrictionMethod), FrictionMap map,
                                FrictionMap transposed, FrictionReport *report)
{
  FrictionUnits *units    = &method->units;
  PetscInt       tangents = 1;

  PetscFunctionBeginUser;
  report->coupling = PETSC_MAX_REAL;
  if (!method->pdas->coupling_needed) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt a = 0; a < units->num; a++) tangents = PetscMax(tangents, units->unit[a].num);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &tangents, 1, MPIU_INT, MPI_MAX, units->comm));
  report->coupling = 0;
  for (PetscInt k = 0; k < tangents; k++) {
    FrictionCouplingPress_Private(units, (PetscBool)(k > 0));
    PetscCall((*prepare)(method));
    PetscCall(FrictionCouplingEstimate_Private(method, map, transposed, &report->coupling));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
