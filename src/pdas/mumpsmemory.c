/* mumpsmemory.c -- what becomes of a factorisation of MUMPS within a solver of PETSc that had too little memory.

   MUMPS takes what its analysis foretells and ICNTL(14) percent more. Where pivots need more than that it gives up, and PETSc's factors
   stay given up: they have to be made anew, with another ICNTL(14), which PETSc reads from its options and nowhere else. */
#include "pdas/factorization.h"

/* Percent beyond which it is something else that is wrong. */
static const PetscInt MOST = 5000;

/* The factors of a PC whose MUMPS has failed for want of memory, and its INFOG(1); NULL where that is not what happened. */
static PetscErrorCode MumpsMemoryGetFailed_Private(PC pc, Mat *F, PetscInt *info)
{
  PCFailedReason failed;
  MatSolverType  type  = NULL;
  PetscBool      mumps = PETSC_FALSE;

  PetscFunctionBeginUser;
  *F    = NULL;
  *info = 0;
  PetscCall(PCGetFailedReason(pc, &failed));
  if (failed != PC_FACTOR_OUTMEMORY) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCFactorGetMatSolverType(pc, &type));
  if (type) PetscCall(PetscStrcmp(type, MATSOLVERMUMPS, &mumps));
  if (!mumps) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCFactorGetMatrix(pc, F));
  PetscCall(MatMumpsGetInfog(*F, 1, info));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MumpsMemoryCheck(KSP ksp)
{
  PC       pc;
  Mat      F;
  PetscInt info;

  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(MumpsMemoryGetFailed_Private(pc, &F, &info));
  PetscCall(FactorizationCheckInfo(PetscObjectComm((PetscObject)ksp), info));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MumpsMemoryIncrease(SNES snes, PetscBool *again)
{
  enum { ICNTL_ROOM = 14 };
  static const PetscInt WHOLE = 100;
  char                  option[128], value[16];
  const char           *prefix;
  PetscInt              info, room;
  Mat                   F;
  KSP                   ksp;
  PC                    pc;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(MumpsMemoryGetFailed_Private(pc, &F, &info));
  *again = FactorizationIsShort(info);
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMumpsGetIcntl(F, ICNTL_ROOM, &room));
  PetscCallMPI(MPI_Bcast(&room, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)snes)));
  *again = (PetscBool)(room < MOST);
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PetscSNPrintf(option, sizeof(option), "-%smat_mumps_icntl_14", prefix ? prefix : ""));
  PetscCall(PetscSNPrintf(value, sizeof(value), "%" PetscInt_FMT, 2 * PetscMax(room, 0) + WHOLE));
  PetscCall(PetscInfo(snes, "%s %s, for %" PetscInt_FMT " was not enough\n", option, value, room));
  PetscCall(PetscOptionsSetValue(NULL, option, value));
  PetscCall(KSPReset(ksp));
  PetscFunctionReturn(PETSC_SUCCESS);
}
