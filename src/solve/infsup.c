/* infsup.c -- the discrete inf-sup number of the mortar pairing.

   The condensed matrix has the relative displacements w of a pair as unknowns, b(v, mu) = mu'D w. Their Schur
   complement S, the energy of the least displacement with a given w, therefore gives the supremum in closed
   form,

       sup_v b(v, mu)^2 / a(v, v) = mu'D S^-1 D mu,

   and with the multipliers' norm of eq. 11.9, a diagonal N, beta^-2 is the largest eigenvalue of N^(1/2) D^-1
   S D^-1 N^(1/2). The largest one is that of the shortest waves, so that rigid motions, for which the
   supremum is infinite, do no harm. */
#include <petscsys.h>
#include <petscblaslapack.h>
#include "base/compat.h"
#include "base/warning.h"
#include "side/sidemeasure.h"
#include "pdas/factorization.h"
#include "solve/infsup.h"

/* Multipliers up to which S is a dense eigenvalue problem: 72 MB on the first rank, and some seconds. */
enum { INFSUP_MAX = 3000 };

/* The rows of one pair, on all ranks. */
typedef struct {
  PetscInt   num;    /* [num] */
  PetscInt  *dof;    /* unknowns, ascending */
  PetscReal *weight; /* (N_a / D_a^2)^(1/2), for the dimensionless S */
} PairRows;

/* E* of a pair, 1/E* the sum of the compliances of both sides; an obstacle has none. */
static PetscErrorCode PairGetModulus_Private(VI vi, const ScenePair *pair, PetscReal *modulus)
{
  SideMeasure side;

  PetscFunctionBeginUser;
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &pair->nonmortar, &side));
  *modulus = side.modulus;
  if (pair->obstacle.kind != OBSTACLE_NONE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &pair->mortar, &side));
  *modulus = 1 / (1 / *modulus + 1 / side.modulus);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists the rows of a pair on this rank. [out] dof, weight - [vi->num_rows] */
static PetscErrorCode PairListRows_Private(VI vi, PetscInt p, PetscInt *num, PetscInt dof[], PetscReal weight[])
{
  const PetscScalar *h;
  PetscReal          modulus = 0;
  Vec                sizes;

  PetscFunctionBeginUser;
  PetscCall(PairGetModulus_Private(vi, vi->pairs[p]->spec, &modulus));
  PetscCall(SideMeasureNodeSizes(vi->scene, vi->level, &vi->pairs[p]->spec->nonmortar, &sizes));
  PetscCall(VecGetArrayRead(sizes, &h));
  *num = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    PetscReal size;

    if (vi->row_pair[r] != p) continue;
    size             = PetscRealPart(h[vi->pairs[p]->nodes[vi->row_node[r]]]);
    dof[*num]        = vi->row_dof[r];
    weight[(*num)++] = PetscSqrtReal(vi->stiffness * size / (modulus * vi->row_D[r]));
  }
  PetscCall(VecRestoreArrayRead(sizes, &h));
  PetscCall(VecDestroy(&sizes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PairRowsCreate_Private(VI vi, PetscInt p, PairRows *rows)
{
  const MPI_Comm comm = vi->level->comm;
  PetscInt      *dof, own = 0;
  PetscReal     *weight;
  PetscMPIInt    size, num, *counts, *offsets;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(vi->num_rows, &dof, vi->num_rows, &weight));
  PetscCall(PairListRows_Private(vi, p, &own, dof, weight));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size, &offsets));
  PetscCall(PetscMPIIntCast(own, &num));
  PetscCallMPI(MPI_Allgather(&num, 1, MPI_INT, counts, 1, MPI_INT, comm));
  rows->num = 0;
  for (PetscMPIInt i = 0; i < size; i++) {
    offsets[i] = (PetscMPIInt)rows->num;
    rows->num += counts[i];
  }
  PetscCall(PetscMalloc2(rows->num, &rows->dof, rows->num, &rows->weight));
  PetscCallMPI(MPI_Allgatherv(dof, num, MPIU_INT, rows->dof, counts, offsets, MPIU_INT, comm));
  PetscCallMPI(MPI_Allgatherv(weight, num, MPIU_REAL, rows->weight, counts, offsets, MPIU_REAL, comm));
  PetscCall(PetscFree2(counts, offsets));
  PetscCall(PetscFree2(dof, weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The ends of the spectrum of the scaled S. First rank only. [in,out] S - [rows->num][rows->num], one
   triangle; overwritten */
static PetscErrorCode InfSupEigenvalues_Private(const PairRows *rows, PetscScalar S[], PetscReal *least,
                                                PetscReal *largest)
{
  const PetscInt n = rows->num;
  PetscReal     *values;
  PetscScalar   *work, room;
  PetscBLASInt   order, size = -1, info;

  PetscFunctionBeginUser;
  FactorizationFillSchur(n, S);
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt j = 0; j < n; j++) S[i * n + j] *= rows->weight[i] * rows->weight[j];
  PetscCall(PetscBLASIntCast(n, &order));
  PetscCall(PetscMalloc1(n, &values));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("N", "U", &order, S, &order, values, &room, &size, &info));
  size = (PetscBLASInt)PetscRealPart(room);
  PetscCall(PetscMalloc1(size, &work));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("N", "U", &order, S, &order, values, work, &size, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKsyev failed with %d", (int)info);
  *least   = values[0];
  *largest = values[n - 1];
  PetscCall(PetscFree(work));
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One pair. [in] definite - whether supports hold all bodies */
static PetscErrorCode InfSupComputePair_Private(Mat A, const PairRows *rows, PetscBool definite, InfSup *number)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)A);
  Factorization  factor;
  MatFactorError error;
  PetscScalar   *S = NULL;
  PetscReal      ends[2];
  PetscMPIInt    rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) PetscCall(PetscCalloc1(rows->num * rows->num, &S));
  PetscCall(FactorizationCreate(A, rows->num, rows->dof, "", S, &factor, &error));
  PetscCall(FactorizationDestroy(&factor));
  if (!error) {
    if (!rank) PetscCall(InfSupEigenvalues_Private(rows, S, &ends[0], &ends[1]));
    PetscCallMPI(MPI_Bcast(ends, 2, MPIU_REAL, 0, comm));
    number->number = 1 / PetscSqrtReal(ends[1]);
    if (definite) number->condition = ends[1] / ends[0];
  }
  PetscCall(PetscFree(S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The reason why a pair has no number, or NULL. */
static PetscErrorCode InfSupWarn_Private(const ScenePair *pair, PetscInt num, const InfSup *number)
{
  const Warning about = {.code   = "inf_sup_unknown",
                         .pair   = pair->name,
                         .advice = "compute it on a coarser mesh: it does not depend on the mesh size"};

  PetscFunctionBeginUser;
  if (num > INFSUP_MAX) {
    PetscCall(WarningAdd(&about,
                         "-infsup: the pair %s has %" PetscInt_FMT " multipliers, more than the %d of a dense "
                         "eigenvalue problem",
                         pair->name, num, INFSUP_MAX));
  } else if (num && PetscIsNanReal(number->number)) {
    PetscCall(WarningAdd(&about, "-infsup: the matrix of the pair %s could not be factored", pair->name));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode InfSupCompute(VI vi, Solvability solvability, InfSup numbers[])
{
  PairRows rows;
  Mat      A;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    numbers[p] = (InfSup){.number = NAN, .condition = NAN};
    PetscCall(PairRowsCreate_Private(vi, p, &rows));
    if (rows.num && rows.num <= INFSUP_MAX) {
      PetscCall(VICreateUntied(vi, p, solvability ? solvability->regularization : NULL, &A));
      PetscCall(InfSupComputePair_Private(A, &rows, (PetscBool)!solvability, &numbers[p]));
      PetscCall(MatDestroy(&A));
    }
    PetscCall(InfSupWarn_Private(vi->pairs[p]->spec, rows.num, &numbers[p]));
    PetscCall(PetscFree2(rows.dof, rows.weight));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
