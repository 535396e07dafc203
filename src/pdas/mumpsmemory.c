/* mumpsmemory.c -- a factorization of MUMPS within a solver of PETSc that ran out of workspace.

   MUMPS allocates what its analysis predicts plus ICNTL(14) percent. If pivots need more it gives up, and
   PETSc's factors stay invalid. They must be created anew with another ICNTL(14), which PETSc reads only from
   its options. */
#include "pdas/factorization.h"

/* Largest extra memory that is tried, in percent: beyond it, a lack of memory has another cause. */
static const PetscInt MAX_ROOM = 5000;

/* The factors of a PC whose MUMPS ran out of memory, and its INFOG(1); NULL otherwise. */
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
  *again = (PetscBool)(room < MAX_ROOM);
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PetscSNPrintf(option, sizeof(option), "-%smat_mumps_icntl_14", prefix ? prefix : ""));
  PetscCall(PetscSNPrintf(value, sizeof(value), "%" PetscInt_FMT, 2 * PetscMax(room, 0) + WHOLE));
  PetscCall(PetscInfo(snes, "%s %s, for %" PetscInt_FMT " was not enough\n", option, value, room));
  PetscCall(PetscOptionsSetValue(NULL, option, value));
  PetscCall(KSPReset(ksp));
  PetscFunctionReturn(PETSC_SUCCESS);
}
