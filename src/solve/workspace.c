/* workspace.c -- more workspace for a factorisation of MUMPS within a solver of PETSc, which has no way to ask for it.

   MUMPS takes what its analysis foretells and ICNTL(14) percent more. Where pivots need more than that it gives up, and PETSc's factors
   stay given up: they have to be made anew, with another ICNTL(14). */
#include "factor.h"

/* Percent beyond which it is something else that is wrong. */
static const PetscInt MOST = 5000;

/* Whether the PC factors by MUMPS, and failed for such a reason. [out] room - what it had, in percent */
static PetscErrorCode Short_Private(PC pc, PetscBool *is_short, PetscInt *room)
{
  enum { INTEGERS = -8, REALS = -9, SEND_BUFFER = -17, RECEIVE_BUFFER = -20, ICNTL_ROOM = 14 };
  PCFailedReason failed;
  MatSolverType  type = NULL;
  Mat            F;
  PetscInt       info;

  PetscFunctionBeginUser;
  *is_short = PETSC_FALSE;
  PetscCall(PCGetFailedReason(pc, &failed));
  if (failed != PC_FACTOR_OUTMEMORY) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCFactorGetMatSolverType(pc, &type));
  if (type) PetscCall(PetscStrcmp(type, MATSOLVERMUMPS, is_short));
  if (!*is_short) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCFactorGetMatrix(pc, &F));
  PetscCall(MatMumpsGetInfog(F, 1, &info));
  PetscCall(MatMumpsGetIcntl(F, ICNTL_ROOM, room));
  PetscCallMPI(MPI_Bcast(room, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)pc)));
  *is_short = (PetscBool)(info == INTEGERS || info == REALS || info == SEND_BUFFER || info == RECEIVE_BUFFER);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FactorMoreRoom(SNES snes, PetscBool *again)
{
  static const PetscInt WHOLE = 100;
  char                  option[128], value[16];
  const char           *prefix;
  PetscInt              room;
  KSP                   ksp;
  PC                    pc;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(Short_Private(pc, again, &room));
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
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
