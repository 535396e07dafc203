/* gatherarrays.c -- arrays of all ranks, concatenated on the first rank. */
#include "result/gatherarrays.h"
#include "base/compat.h"

static PetscErrorCode GatherArraysGather_Private(MPI_Comm comm, MPI_Datatype type, size_t size, PetscInt n,
                                                 const void *mine, PetscInt *total, void **all)
{
  PetscMPIInt ranks, rank, count, *counts = NULL, *starts = NULL;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscMPIIntCast(n, &count));
  if (rank == 0) PetscCall(PetscCalloc2(ranks, &counts, ranks + 1, &starts));
  PetscCallMPI(MPI_Gather(&count, 1, MPI_INT, counts, 1, MPI_INT, 0, comm));
  *all = NULL;
  if (total) *total = 0;
  if (rank == 0) {
    for (PetscMPIInt r = 0; r < ranks; r++) starts[r + 1] = starts[r] + counts[r];
    PetscCall(PetscMalloc(PetscMax((size_t)starts[ranks], 1) * size, all));
    if (total) *total = starts[ranks];
  }
  PetscCallMPI(MPI_Gatherv(mine, count, type, *all, counts, starts, type, 0, comm));
  if (rank == 0) PetscCall(PetscFree2(counts, starts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GatherArraysReal(MPI_Comm comm, PetscInt n, const PetscReal mine[], PetscInt *total, PetscReal **all)
{
  void *result;

  PetscFunctionBeginUser;
  PetscCall(GatherArraysGather_Private(comm, MPIU_REAL, sizeof(PetscReal), n, mine, total, &result));
  *all = (PetscReal *)result;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GatherArraysInt(MPI_Comm comm, PetscInt n, const PetscInt mine[], PetscInt *total, PetscInt **all)
{
  void *result;

  PetscFunctionBeginUser;
  PetscCall(GatherArraysGather_Private(comm, MPIU_INT, sizeof(PetscInt), n, mine, total, &result));
  *all = (PetscInt *)result;
  PetscFunctionReturn(PETSC_SUCCESS);
}
