/* patchlinks.c -- nodes that join the patches of mortar nodes.

   A node of a mortar side moves nodes of the nonmortar side, and the volume of cells there changes. With
   these nodes alone a patch can hardly keep it: they are fixed to the mortar side where they touch. With all
   nodes of these cells it can. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "multigrid/patchlinks.h"

/* A graph of nodes, as a matrix of ones. Collective. [in] start, column - its rows, which are freed [n + 1];
   [out] graph - AIJ, owned by the caller */
static PetscErrorCode PatchLinksCreateGraph_Private(MPI_Comm comm, PetscInt n, PetscInt *start, PetscInt *column,
                                                    Mat *graph)
{
  PetscFunctionBeginUser;
  PetscCall(CSRMatrixCreate(comm, &(CSRRows){1, n, n, start, column, NULL}, graph));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(column));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Other nodes that own nodes depend on by T. [out] sources - row for row; AIJ, owned by the caller */
static PetscErrorCode PatchLinksCreateSources_Private(const Operator *op, PetscInt n, Mat *sources)
{
  const PetscInt dim = op->dim;
  PetscInt      *start, *column = NULL, begin, max = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + 1, &start));
  PetscCall(MatGetOwnershipRange(op->T, &begin, NULL));
  start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    start[i + 1] = start[i];
    for (PetscInt k = 0; k < dim; k++) {
      PetscInt        num;
      const PetscInt *columns;

      PetscCall(MatGetRow(op->T, begin + dim * i + k, &num, &columns, NULL));
      if (start[i + 1] + num > max) {
        max = 2 * (start[i + 1] + num);
        PetscCall(PetscRealloc((size_t)max * sizeof(PetscInt), &column));
      }
      for (PetscInt j = 0; j < num; j++)
        if (columns[j] / dim != begin / dim + i) column[start[i + 1]++] = columns[j] / dim;
      PetscCall(MatRestoreRow(op->T, begin + dim * i + k, &num, &columns, NULL));
    }
    max = PetscMax(max, start[i + 1]);
    start[i + 1] -= start[i];
    if (start[i + 1]) PetscCall(PetscSortRemoveDupsInt(&start[i + 1], &column[start[i]]));
    start[i + 1] += start[i];
  }
  PetscCall(PatchLinksCreateGraph_Private(PetscObjectComm((PetscObject)op->T), n, start, column, sources));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Mean number of unknowns around a node between which patches beyond contact are widened. In the plane cells
   of order 1 have 14 or 18, of order 2 23 or 32. Two plates of order 1, nu = 0.4999, take 74 iterations with
   wide patches and 63 without. In space cells have 81 and more: inverses cost more than is gained. */
static const PetscReal WIDENED_FROM = 20, WIDENED_UP_TO = 50;

/* Whether widened patches gain. Collective.
   [out] start - of the rows of nodes and those that share a cell with them, owned by the caller [n + 1] */
static PetscErrorCode PatchLinksGain_Private(const Operator *op, PetscInt n, PetscInt **start, PetscBool *gain)
{
  PetscInt  begin;
  PetscReal size[2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + 1, start));
  PetscCall(MatGetOwnershipRange(op->K, &begin, NULL));
  (*start)[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    PetscInt num;

    PetscCall(MatGetRow(op->K, begin + op->dim * i, &num, NULL, NULL));
    (*start)[i + 1] = (*start)[i] + num / op->dim;
    PetscCall(MatRestoreRow(op->K, begin + op->dim * i, &num, NULL, NULL));
  }
  size[0] = (PetscReal)(op->dim * (*start)[n]);
  size[1] = (PetscReal)n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 2, MPIU_REAL, MPI_SUM, PetscObjectComm((PetscObject)op->K)));
  *gain = (PetscBool)(size[0] >= WIDENED_FROM * size[1] && size[0] <= WIDENED_UP_TO * size[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the nodes that share a cell with those that a node moves: a patch can then keep the volume of these
   cells. Collective. [in,out] links - nodes (rows) and those that they move (columns) */
static PetscErrorCode PatchLinksWiden_Private(const Operator *op, PetscInt n, Mat *links)
{
  const PetscInt dim = op->dim;
  PetscInt      *start, *column, begin;
  PetscBool      gain;
  Mat            graph, product;

  PetscFunctionBeginUser;
  PetscCall(PatchLinksGain_Private(op, n, &start, &gain));
  if (!gain) {
    PetscCall(PetscFree(start));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(start[n], &column));
  PetscCall(MatGetOwnershipRange(op->K, &begin, NULL));
  for (PetscInt i = 0; i < n; i++) {
    PetscInt        num;
    const PetscInt *columns;

    PetscCall(MatGetRow(op->K, begin + dim * i, &num, &columns, NULL));
    for (PetscInt j = 0; j < num / dim; j++) column[start[i] + j] = columns[dim * j] / dim;
    PetscCall(MatRestoreRow(op->K, begin + dim * i, &num, &columns, NULL));
  }
  PetscCall(PatchLinksCreateGraph_Private(PetscObjectComm((PetscObject)op->K), n, start, column, &graph));
  PetscCall(MatMatMult(*links, graph, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatDestroy(&graph));
  PetscCall(MatDestroy(links));
  *links = product;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchLinksCreate(const Operator *op, PetscInt n, Mat *links)
{
  Mat sources;

  PetscFunctionBeginUser;
  PetscCall(PatchLinksCreateSources_Private(op, n, &sources));
  PetscCall(MatTranspose(sources, MAT_INITIAL_MATRIX, links));
  PetscCall(MatDestroy(&sources));
  PetscCall(PatchLinksWiden_Private(op, n, links));
  PetscFunctionReturn(PETSC_SUCCESS);
}
