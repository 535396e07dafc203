/* factorization.h -- the factors of a part of a symmetric positive definite matrix, and the Schur complement of the rest. */
#ifndef MORTISE_FACTORIZATION_H
#define MORTISE_FACTORIZATION_H

#include "base/compat.h"
#include <petscsnes.h>

typedef struct _n_Factor *Factorization;

/* A_II = L L' and S = A_CC - A_CI A_II^-1 A_IC by MUMPS. Its controls are PETSc's options -mat_mumps_icntl_<n> and
   -mat_mumps_cntl_<n>, behind the prefix. Collective.
   [in] C - ascending, the same on all ranks [num]; [out] S - on the first rank [num][num];
   PETSC_ERR_MEM if the system has no memory left, which is told from a workspace that MUMPS took too small.
   [out] error - the same on all ranks; but for MAT_FACTOR_NOERROR nothing but FactorizationDestroy() is allowed then */
PetscErrorCode FactorizationCreate(Mat A, PetscInt num, const PetscInt C[], const char prefix[], PetscScalar S[],
                                   Factorization *factor, MatFactorError *error);
/* What that would take. */
typedef struct {
  PetscBool known;      /* whether there is an order of pivots at all */
  PetscReal operations; /* of all ranks */
  PetscReal bytes;      /* of this rank */
} FactorizationCost;

/* Orders pivots and counts, without values. Collective. [in] A - its pattern matters; [in] num - or 0, if no unknown is left to the end */
PetscErrorCode FactorizationPredict(Mat A, PetscInt num, const PetscInt C[], const char prefix[],
                                    FactorizationCost *forecast);
/* x_I = A_II^-1 b_I, 0 on C. Collective. */
PetscErrorCode FactorizationSolve(Factorization factor, Vec b, Vec x);
PetscErrorCode FactorizationDestroy(Factorization *factor);

/* What INFOG(1) of MUMPS means: that the workspace it took was too small (not collective); PETSC_ERR_MEM if it asked the system for memory
   in vain (collective). */
PetscBool      FactorizationIsShort(PetscInt info);
PetscErrorCode FactorizationCheckInfo(MPI_Comm comm, PetscInt info);

/* PETSC_ERR_MEM if a factorisation within a solver of PETSc has failed because the system has no memory left. Collective. */
PetscErrorCode MumpsMemoryCheck(KSP ksp);

/* After a solve that failed: whether it is worth another try because MUMPS, within PETSc's solver, ran short of its workspace; the option
   -mat_mumps_icntl_14 then stands for more of it, until somebody puts it back, and the factors are forgotten. Collective. */
PetscErrorCode MumpsMemoryIncrease(SNES snes, PetscBool *again);

/* A pivot order by nested dissection of the graph of A's blocks, with C behind all others: half the operations of a
   minimum degree order in 3D. Collective.
   [in] C - the same on all ranks [num]; [out] position - from 1, of every unknown, on the first rank [N of A] */
PetscErrorCode DissectionOrder(Mat A, PetscInt num, const PetscInt C[], PetscInt position[]);

#endif
