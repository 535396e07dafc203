/* factorization.h -- factorization of a part of a symmetric positive definite matrix, and the Schur
   complement of the rest. */
#ifndef MORTISE_FACTORIZATION_H
#define MORTISE_FACTORIZATION_H

#include "base/compat.h"
#include <petscsnes.h>

typedef struct _n_Factor *Factorization;

/* A_II = L L' and S = A_CC - A_CI A_II^-1 A_IC by MUMPS. Its controls are PETSc's options
   -mat_mumps_icntl_<n> and -mat_mumps_cntl_<n>, behind the prefix. Collective.
   [in] C - ascending, the same on all ranks [num]; [out] S - on the first rank [num][num];
   PETSC_ERR_MEM if the system has no memory left; a workspace of MUMPS that is too small is no such error.
   [out] error - the same on all ranks; after an error only FactorizationDestroy() is allowed */
PetscErrorCode FactorizationCreate(Mat A, PetscInt num, const PetscInt C[], const char prefix[], PetscScalar S[],
                                   Factorization *factor, MatFactorError *error);
/* Fills the other triangle of S. MUMPS gives one triangle: the lower one on one rank, the upper one on
   several. Next to the diagonal the other one has parts of sums, so the fuller triangle is copied as a whole.
   Not collective.
   [in,out] S - of FactorizationCreate(), which was zero before [num][num] */
void FactorizationFillSchur(PetscInt num, PetscScalar S[]);
/* The predicted cost of a factorization. */
typedef struct {
  PetscBool known;      /* whether MUMPS could analyse the matrix */
  PetscReal operations; /* of all ranks */
  PetscReal bytes;      /* of this rank */
} FactorizationCost;

/* Predicts the cost from the pattern, without values. Collective. [in] A - its pattern matters; [in] num - 0
   for a factorization of all of A */
PetscErrorCode FactorizationPredict(Mat A, PetscInt num, const PetscInt C[], const char prefix[],
                                    FactorizationCost *cost);
/* x_I = A_II^-1 b_I, 0 on C. Collective. */
PetscErrorCode FactorizationSolve(Factorization factor, Vec b, Vec x);
PetscErrorCode FactorizationDestroy(Factorization *factor);

/* Whether INFOG(1) of MUMPS says that its workspace was too small (not collective). FactorizationCheckInfo()
   raises PETSC_ERR_MEM if the system has no memory left (collective). */
PetscBool      FactorizationIsShort(PetscInt info);
PetscErrorCode FactorizationCheckInfo(MPI_Comm comm, PetscInt info);

/* Raises PETSC_ERR_MEM if a factorization within a solver of PETSc failed because the system has no memory
   left. Collective. */
PetscErrorCode MumpsMemoryCheck(KSP ksp);

/* After a failed solve: whether to try again, because the workspace of MUMPS within PETSc's solver was too
   small. Then the option -mat_mumps_icntl_14 is set to more, until it is reset, and the factors are
   destroyed. Collective. */
PetscErrorCode MumpsMemoryIncrease(SNES snes, PetscBool *again);

/* An ordering of pivots by nested dissection of the graph of A's blocks, with C last. It takes half the
   operations of a minimum degree ordering in 3D. Collective.
   [in] C - the same on all ranks [num];
   [out] position - from 1, of every unknown, on the first rank [N of A] */
PetscErrorCode DissectionOrder(Mat A, PetscInt num, const PetscInt C[], PetscInt position[]);

#endif
