/* stiffness.h -- the stiffness K of all bodies as a Mat that keeps half of it. */
#ifndef MORTISE_STIFFNESSMAT_H
#define MORTISE_STIFFNESSMAT_H

#include <petscmat.h>
#include "problem/symmetricblocks.h"

/* Blocks of K in rows of this rank and columns of others. */
typedef struct {
  PetscInt     num, *node;     /* nodes of other ranks, global numbers, ascending [num] */
  PetscInt    *start, *column; /* places of the nodes of every row, ascending [rows of blocks + 1], [start[rows]] */
  PetscScalar *value;          /* [start[rows]][bs][bs] */
} GhostBlocks;

/* K knows products, rows, its diagonal and its infinity norm; MatConvert() makes an AIJ matrix of it.
   Collective.
   [in] blocks - between nodes of this rank, taken over; [in] others - NULL on one process, else taken over;
   [out] K - a shell, owned by the caller */
PetscErrorCode StiffnessCreate(MPI_Comm comm, SymmetricBlocks *blocks, GhostBlocks *others, Mat *K);
/* The same of an AIJ matrix. Collective.
   [in] A - symmetric, in full blocks of its block size; copied */
PetscErrorCode StiffnessCreateOfMatrix(Mat A, Mat *K);
/* The rows of this rank. Not collective. [out] blocks, others - borrowed; others without nodes, which
   MatGetGhosts() has, and without start on one process */
PetscErrorCode StiffnessGetBlocks(Mat K, const SymmetricBlocks **blocks, GhostBlocks *others);
/* factor K for products alone, of the same entries. Collective. [out] S - a shell, owned by the caller */
PetscErrorCode StiffnessCreateScaled(Mat K, PetscReal factor, Mat *S);
/* The same with numbers in single precision, for a preconditioner. Collective.
   [out] S - owned by the caller */
PetscErrorCode StiffnessCreateSingle(Mat K, PetscReal factor, Mat *S);
/* y = S x. Not collective.
   [in] own, others - x of this rank's unknowns, and of the ghosts of K; others are not read on one process */
PetscErrorCode StiffnessMultLocal(Mat S, const PetscScalar own[], const PetscScalar others[], PetscScalar y[]);
/* Restricts products with S: from now on they are right in a region, and everywhere for vectors that are 0
   outside of it. Collective. [in] region - not 0 at all unknowns of its nodes, 0 at others; or NULL for
   all; [out] part - of the entries that a product reads */
PetscErrorCode StiffnessRestrict(Mat S, Vec region, PetscReal *part);

#endif
