/* solverchoice.c -- the choice of solvers: by the user, else by size and dimension. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "problem/frictionlaw.h"
#include "base/usererror.h"
#include "pdas/pdas.h"
#include "base/warning.h"
#include <string.h>
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"
#include "solve/meshlevels.h"
#include "solve/thinbodies.h"
#include "solve/solverimpl.h"

/* Unknowns up to which factorizations are faster than iterations. In 2D that is without coarser meshes for
   multigrid, in 3D where it needs many iterations (nearly incompressible bodies). Triangles from a file,
   10 sets, 414000 unknowns: 7.1 s and 1.0 GB by factorization, 20 s and 0.8 GB by iterations. In 3D one
   factorization per active set costs as much as its iterations much earlier than one for all sets. */
static const PetscInt DIRECT_2D = 1000000, DIRECT_3D = 150000, DIRECT_3D_EACH = 40000;

PetscBool SolverChoiceFactors(const char pc[])
{
  return (PetscBool)(!strcmp(pc, PCCHOLESKY) || !strcmp(pc, PCLU));
}

PetscErrorCode SolverChoiceDescribe(const char ksp[], const char pc[], const char package[], char words[], size_t len)
{
  PetscFunctionBeginUser;
  if (SolverChoiceFactors(pc) && !strcmp(ksp, KSPPREONLY)) {
    PetscCall(PetscSNPrintf(words, len, "%s factorization%s%s", strcmp(pc, PCLU) ? "Cholesky" : "LU",
                            package ? " by " : "", package ? package : ""));
  } else {
    PetscCall(PetscSNPrintf(words, len, "%s with %s", ksp, pc));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks the name of a type; an error suggests the nearest one. Collective. */
static PetscErrorCode SolverChoiceCheckName_Private(MPI_Comm comm, const char option[], const char type[],
                                                    PetscFunctionList types)
{
  const char **names, *nearest;
  int          num;
  PetscBool    known = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscFunctionListGet(types, &names, &num));
  while (num && !names[num - 1]) num--; // PETSc counts the terminator of the list
  for (int i = 0; i < num; i++) known = (PetscBool)(known || !strcmp(names[i], type));
  nearest = UserErrorNearest(type, num, names);
  if (!known && nearest) {
    PetscCall(UserErrorRaise(comm, "%s %s: there is no such type; did you mean %s?", option, type, nearest));
  } else if (!known) {
    PetscCall(UserErrorRaise(comm, "%s %s: there is no such type in this PETSc", option, type));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks that a SNES type accepts bounds: such types implement SNESVISetVariableBounds(). */
static PetscErrorCode SolverChoiceCheckBounds_Private(MPI_Comm comm, const char type[])
{
  void (*answer)(void);
  SNES snes;

  PetscFunctionBeginUser;
  PetscCall(SNESCreate(comm, &snes)); // with it PETSc has its types
  PetscCall(SolverChoiceCheckName_Private(comm, "-snes_type", type, SNESList));
  PetscCall(SNESSetType(snes, type));
  PetscCall(PetscObjectQueryFunction((PetscObject)snes, "SNESVISetVariableBounds_C", &answer));
  PetscCall(SNESDestroy(&snes));
  if (!answer) {
    PetscCall(UserErrorRaise(comm, "-snes_type %s: ignores bounds, so contact has no effect; use %s or %s", type,
                             SNESPDAS, SNESVINEWTONRSLS));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts bounded unknowns; whether one factorization serves all active sets. */
static PetscErrorCode SolverChoiceReducible_Private(VI vi, PetscInt *num_out, PetscBool *reducible)
{
  const PetscScalar *upper;
  PetscInt           n, num = 0;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(vi->upper, &n));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  for (PetscInt i = 0; i < n; i++) num += PetscRealPart(upper[i]) < PETSC_INFINITY;
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &num, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)vi->upper)));
  *num_out   = num;
  *reducible = (PetscBool)(num <= ACTIVE_MAX_SCHUR);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Limit of Poisson's ratio for iterations without coarser meshes, whose number grows with the root of bulk
   over shear modulus. CG with GAMG on two plates: 104 iterations at 0.3, 890 at 0.49, 2369 at 0.499, 6344 at
   0.4999. */
static const PetscReal ITERABLE = 0.499;

/* The largest Poisson's ratio of bodies with mean dilatation, or 0. */
static PetscErrorCode SolverChoiceLargestPoisson_Private(VI vi, PetscReal *poisson)
{
  DilatationCount *counts;

  PetscFunctionBeginUser;
  *poisson = 0;
  PetscCall(PetscMalloc1(vi->scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(vi->scene, vi->level, counts));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) *poisson = PetscMax(*poisson, counts[b].poisson);
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether multigrid knows which unknowns a type leaves free. */
static PetscBool SolverChoiceTruncatable_Private(const char snes[])
{
  return (PetscBool)(!strcmp(snes, SNESPDAS) || !strcmp(snes, SNESVINEWTONRSLS));
}

/* Whether the convergence test of pdas with multigrid works: it needs residuals and steps of conjugate
   gradients. */
static PetscBool SolverChoiceHasTest_Private(const char snes[], const char ksp[])
{
  return (PetscBool)(strcmp(snes, SNESPDAS) || !strcmp(ksp, KSPCG));
}

/* Preconditioner of matrices that change their size, which PETSc's GAMG does not take. */
#if defined(PETSC_HAVE_HYPRE)
static const char *const RESIZABLE = PCHYPRE;
#else
static const char *const RESIZABLE = PCCHOLESKY;
#endif

/* The preconditioner of an iteration. */
static const char *SolverChoiceIterative_Private(VI vi, const char snes[], const char ksp[])
{
  if (vi->mesh && SolverChoiceTruncatable_Private(snes) && SolverChoiceHasTest_Private(snes, ksp)) return PCTRUNCATEDMG;
  return strcmp(snes, SNESPDAS) ? RESIZABLE : PCGAMG;
}

/* Unknowns up to which a factorization is chosen. */
static PetscErrorCode SolverChoiceLargestDirect_Private(VI vi, const char snes[], PetscInt *limit)
{
  const PetscBool solid = (PetscBool)(vi->level->dim == 3), pdas = (PetscBool)!strcmp(snes, SNESPDAS);
  PetscBool       reducible, nested;
  PetscInt        num;

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceReducible_Private(vi, &num, &reducible));
  *limit = DIRECT_2D;
  if (solid) *limit = pdas && reducible ? DIRECT_3D : DIRECT_3D_EACH;
  if (!vi->mesh || !SolverChoiceTruncatable_Private(snes)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshLevelsAreNested(vi, &nested));
  if (nested && solid) *limit = PetscMin(*limit, MESH_LEVELS_3D);
  if (nested && !solid && vi->mesh->num_levels > 1) *limit = PetscMin(*limit, MESH_LEVELS_2D);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Chooses a factorization. */
static PetscErrorCode SolverChoiceFactor_Private(SolverChoice *choice)
{
  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(choice->ksp, KSPPREONLY, sizeof(choice->ksp)));
  PetscCall(PetscStrncpy(choice->pc, PCCHOLESKY, sizeof(choice->pc)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether bodies are so thin that the size is no criterion. */
static PetscErrorCode SolverChoiceTestThin_Private(VI vi, PetscBool floating, const SolverChoice *choice,
                                                   PetscBool *thin)
{
  PetscInt  num;
  PetscBool reducible;

  PetscFunctionBeginUser;
  *thin = PETSC_FALSE;
  if (!vi->mesh || strcmp(choice->pc, PCTRUNCATEDMG)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolverChoiceReducible_Private(vi, &num, &reducible));
  PetscCall(ThinBodiesAreCheap(vi, floating, num, (PetscBool)(reducible && !strcmp(choice->snes, SNESPDAS)), thin));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The default linear solver: by size, except for nearly incompressible or thin bodies. */
static PetscErrorCode SolverChoiceChooseBySize_Private(VI vi, PetscBool floating, SolverChoice *choice)
{
  const char *iterative = SolverChoiceIterative_Private(vi, choice->snes, KSPCG);
  PetscInt    size, limit = 0;
  PetscReal   poisson;
  PetscBool   thin;

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceLargestDirect_Private(vi, choice->snes, &limit));
  PetscCall(VecGetSize(vi->b, &size));
  PetscCall(PetscStrncpy(choice->ksp, size <= limit ? KSPPREONLY : KSPCG, sizeof(choice->ksp)));
  PetscCall(PetscStrncpy(choice->pc, size <= limit ? PCCHOLESKY : iterative, sizeof(choice->pc)));
  PetscCall(PetscSNPrintf(choice->why, sizeof(choice->why), "%" PetscInt_FMT " unknowns in %dD, %s than %" PetscInt_FMT,
                          size, (int)vi->level->dim, size <= limit ? "not more" : "more", limit));
  PetscCall(SolverChoiceLargestPoisson_Private(vi, &poisson));
  choice->nearly = (PetscBool)(poisson > ITERABLE && !(vi->mesh && vi->mesh->num_levels > 1 && !vi->mesh->forest));
  if (choice->nearly && size > limit) {
    PetscCall(SolverChoiceFactor_Private(choice));
    PetscCall(
        PetscSNPrintf(choice->why, sizeof(choice->why), "a Poisson's ratio above %g, for any size", (double)ITERABLE));
  }
  PetscCall(SolverChoiceTestThin_Private(vi, floating, choice, &thin));
  if (thin) {
    PetscCall(SolverChoiceFactor_Private(choice));
    PetscCall(
        PetscStrncpy(choice->why, "thin bodies: a factorization costs less than an iteration", sizeof(choice->why)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stopping at the discretization error needs nested iteration from a coarser level. */
static PetscErrorCode SolverChoiceChooseStop_Private(VI vi, Solvability solvability, SolverChoice *choice)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)vi->b);

  PetscFunctionBeginUser;
  choice->stop = (PetscBool)(vi->scene->stop == STOP_DISCRETISATION);
  if (!choice->stop) PetscFunctionReturn(PETSC_SUCCESS);
  if (solvability) {
    PetscCall(UserErrorRaise(
        comm,
        "-stop discretisation: supports must hold all bodies, and contact alone holds some here; omit the option"));
  }
  if (choice->own) {
    PetscCall(PetscStrncpy(choice->ksp, KSPCG, sizeof(choice->ksp)));
    PetscCall(PetscStrncpy(choice->pc, PCTRUNCATEDMG, sizeof(choice->pc)));
    PetscCall(PetscStrncpy(choice->why, "-stop discretisation", sizeof(choice->why)));
  }
  if (strcmp(choice->snes, SNESPDAS) || strcmp(choice->ksp, KSPCG) || strcmp(choice->pc, PCTRUNCATEDMG)) {
    PetscCall(UserErrorRaise(comm,
                             "-stop discretisation: needs -snes_type " SNESPDAS ", -ksp_type " KSPCG
                             " and -pc_type " PCTRUNCATEDMG ", not %s, %s and %s; omit these options",
                             choice->snes, choice->ksp, choice->pc));
  }
  if (!(vi->mesh && vi->mesh->num_levels > 1)) {
    PetscCall(UserErrorRaise(comm,
                             "-stop discretisation: needs a coarser level of the mesh, and the mesh has one level; "
                             "refine with -dm_refine 1 or more"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks combinations of types. */
static PetscErrorCode SolverChoiceCheckTogether_Private(MPI_Comm comm, const SolverChoice *choice)
{
  const PetscBool multigrid = (PetscBool)!strcmp(choice->pc, PCTRUNCATEDMG);

  PetscFunctionBeginUser;
  if (multigrid && !SolverChoiceTruncatable_Private(choice->snes)) {
    PetscCall(UserErrorRaise(comm,
                             "-%spc_type " PCTRUNCATEDMG ": does not work with -snes_type %s; use -snes_type " SNESPDAS
                             ", -pc_type cholesky or -pc_type hypre",
                             choice->prefix, choice->snes));
  }
  if (multigrid && !SolverChoiceHasTest_Private(choice->snes, choice->ksp)) {
    PetscCall(UserErrorRaise(comm,
                             "-%sksp_type %s: does not work with -pc_type " PCTRUNCATEDMG
                             ", whose convergence test needs conjugate gradients; use -ksp_type " KSPCG
                             " or -pc_type " PCGAMG,
                             choice->prefix, choice->ksp));
  }
  if (strcmp(choice->snes, SNESPDAS) && !strcmp(choice->pc, PCGAMG)) {
    PetscCall(UserErrorRaise(
        comm,
        "-%spc_type gamg: does not work with -snes_type %s, whose systems change their size; use -snes_type pdas, "
        "-pc_type cholesky or -pc_type hypre",
        choice->prefix, choice->snes));
  }
  if (!strcmp(
          choice->ksp,
          KSPFCG)) // PETSc 3.18 reads eigenvalues from memory that was not allocated, and keeps vectors of another size
    PetscCall(UserErrorRaise(comm,
                             "-%sksp_type " KSPFCG ": this type of PETSc fails on these systems; use -ksp_type " KSPCG,
                             choice->prefix));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether nested iteration is possible, or contact can be predicted on the only mesh. */
static PetscBool SolverChoiceNested_Private(VI vi, const char snes[], const char pc[])
{
  return (PetscBool)(!strcmp(pc, PCTRUNCATEDMG) && vi->mesh && (vi->mesh->num_levels > 1 || !strcmp(snes, SNESPDAS)));
}

/* Unknowns with bounds and tangents up to which the dense system of friction can be solved: one takes 0.5 GB.
   Up to which it is where an iteration is possible: a dozen systems take two seconds. */
enum { MAX_FRICTION = 8000, DENSE_FRICTION = 1500 };

/* Unknowns with bounds and tangents. */
static PetscErrorCode SolverChoiceCountFriction_Private(VI vi, PetscInt *num)
{
  PetscBool reducible;
  PetscInt  tangents = 0;

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceReducible_Private(vi, num, &reducible));
  for (PetscInt i = 0; i < FRICTION_TANGENTS * vi->friction->n; i++) tangents += vi->friction->tangent[i] >= 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &tangents, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)vi->b)));
  *num += tangents;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* User errors for a choice that cannot solve friction. [in] num - unknowns of contact and friction;
   [in] dense - whether their dense system is solved; [in] iterable - whether multigrid could solve it */
static PetscErrorCode SolverChoiceCheckFriction_Private(MPI_Comm comm, const SolverChoice *choice, PetscInt num,
                                                        PetscBool dense, PetscBool iterable)
{
  PetscFunctionBeginUser;
  if (choice->stop) PetscCall(UserErrorRaise(comm, "-stop discretisation: not with friction; omit the option"));
  if (dense && num > MAX_FRICTION) {
    PetscCall(UserErrorRaise(comm,
                             "-<pair>_friction: the sides have %" PetscInt_FMT
                             " unknowns of contact and friction, and a factorization takes at most %d; %s",
                             num, (int)MAX_FRICTION,
                             iterable ? "use -pc_type " PCTRUNCATEDMG
                                      : "refine less, or make the sides of the pairs smaller"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Friction is solved on the Schur complement of its unknowns, or at full size by multigrid. */
static PetscErrorCode SolverChoiceChooseFriction_Private(VI vi, SolverChoice *choice)
{
  const MPI_Comm  comm     = PetscObjectComm((PetscObject)vi->b);
  const PetscBool iterable = (PetscBool)(vi->mesh && !choice->nearly);
  PetscBool       dense, multigrid;
  PetscInt        num, size;

  PetscFunctionBeginUser;
  if (!vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolverChoiceCountFriction_Private(vi, &num));
  if (choice->own && num > DENSE_FRICTION && iterable) {
    PetscCall(PetscStrncpy(choice->ksp, KSPCG, sizeof(choice->ksp)));
    PetscCall(PetscStrncpy(choice->pc, PCTRUNCATEDMG, sizeof(choice->pc)));
    PetscCall(PetscSNPrintf(choice->why, sizeof(choice->why), "friction at %" PetscInt_FMT " unknowns, more than %d",
                            num, (int)DENSE_FRICTION));
  } else if (choice->own && strcmp(choice->pc, PCTRUNCATEDMG)) {
    PetscCall(SolverChoiceFactor_Private(choice));
    PetscCall(PetscStrncpy(choice->why, "friction", sizeof(choice->why)));
  }
  dense     = (PetscBool)(!strcmp(choice->ksp, KSPPREONLY) && !strcmp(choice->pc, PCCHOLESKY));
  multigrid = (PetscBool)((!strcmp(choice->ksp, KSPCG) || !strcmp(choice->ksp, KSPGMRES)) &&
                          !strcmp(choice->pc, PCTRUNCATEDMG));
  if (multigrid)
    PetscCall(PetscStrncpy(choice->ksp, KSPCG, sizeof(choice->ksp))); // of levels; systems of friction take GMRES
  if (strcmp(choice->snes, SNESPDAS) || !(dense || multigrid)) {
    PetscCall(UserErrorRaise(comm,
                             "-<pair>_friction: needs -snes_type " SNESPDAS " and -pc_type " PCCHOLESKY
                             " or " PCTRUNCATEDMG ", not %s, %s and %s; omit these options",
                             choice->snes, choice->ksp, choice->pc));
  }
  PetscCall(SolverChoiceCheckFriction_Private(comm, choice, num, dense, iterable));
  PetscCall(FrictionLawIsGiven(vi, &choice->bound));
  PetscCall(VecGetSize(vi->b, &size));
  choice->reducible = (PetscBool)(multigrid && num <= MAX_FRICTION);
  choice->stalls    = (PetscBool)(multigrid && num <= DENSE_FRICTION && vi->level->dim == 2 && size <= DIRECT_2D);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes -ksp_type and -pc_type in place of the default. One of the two implies the other: a factorization
   needs no iteration, other preconditioners do. */
static PetscErrorCode SolverChoiceTakeLinear_Private(VI vi, SolverChoice *choice)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)vi->b);
  PetscBool      ksp, pc;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetString(NULL, NULL, "-ksp_type", choice->ksp, sizeof(choice->ksp), &ksp));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-pc_type", choice->pc, sizeof(choice->pc), &pc));
  choice->own = (PetscBool)(!ksp && !pc);
  PetscCall(KSPInitializePackage()); // with them PETSc has its types
  PetscCall(PCInitializePackage());
  PetscCall(SolverChoiceCheckName_Private(comm, "-ksp_type", choice->ksp, KSPList));
  PetscCall(SolverChoiceCheckName_Private(comm, "-pc_type", choice->pc, PCList));
  if (choice->own) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(
      PetscStrncpy(choice->why, ksp ? (pc ? "-ksp_type and -pc_type" : "-ksp_type") : "-pc_type", sizeof(choice->why)));
  if (!ksp) {
    PetscCall(PetscStrncpy(choice->ksp, SolverChoiceFactors(choice->pc) ? KSPPREONLY : KSPCG, sizeof(choice->ksp)));
  } else if (!pc) {
    const char *iterative = SolverChoiceIterative_Private(vi, choice->snes, choice->ksp);

    PetscCall(PetscStrncpy(choice->pc, strcmp(choice->ksp, KSPPREONLY) ? iterative : PCCHOLESKY, sizeof(choice->pc)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverChoiceSet(Solver solver, SolverChoice *choice)
{
  const VI          vi          = solver->vi;
  const Solvability solvability = solver->solvability;
  MPI_Comm          comm;
  PetscInt          size;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectGetComm((PetscObject)vi->A, &comm));
  *choice = (SolverChoice){.prefix = "", .bound = PETSC_TRUE};
  PetscCall(PetscStrncpy(choice->snes, SNESPDAS, sizeof(choice->snes)));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-snes_type", choice->snes, sizeof(choice->snes), NULL));
  PetscCall(SolverChoiceCheckBounds_Private(comm, choice->snes));
  PetscCall(SolverChoiceChooseBySize_Private(vi, (PetscBool)(solvability != NULL), choice));
  PetscCall(SolverChoiceTakeLinear_Private(vi, choice));
  PetscCall(SolverChoiceChooseStop_Private(vi, solvability, choice));
  PetscCall(SolverChoiceChooseFriction_Private(vi, choice));
  PetscCall(VecGetSize(vi->b, &size)); // above these sizes even the ordering costs too much
  choice->yields = (PetscBool)(choice->own && !choice->stop && !strcmp(choice->snes, SNESPDAS) &&
                               size <= (vi->level->dim == 3 ? DIRECT_3D : DIRECT_2D));
  choice->nested = SolverChoiceNested_Private(vi, choice->snes, choice->pc);
  PetscCall(SolverChoiceCheckTogether_Private(comm, choice));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Iterations of the second solver. Where contact moves along a side from node to node, both need many. One
   cell on 2000 takes 174 steps of pdas and 161 of vinewtonrsls, on 4000 366 and 317. PETSc's default is
   100. */
enum { SECOND_MAX_IT = 500, SECOND_PER_FIRST = 2 };

PetscErrorCode SolverChoiceSetSecond(VI vi, const SolverReport *first, const char prefix[], SolverChoice *choice)
{
  const PetscBool multigrid = (PetscBool)!strcmp(first->pc, PCTRUNCATEDMG),
                  pdas      = (PetscBool)!strcmp(first->type, SNESPDAS);
  PetscBool set;

  PetscFunctionBeginUser;
  *choice = (SolverChoice){.prefix = prefix, .max_it = PetscMax(SECOND_MAX_IT, SECOND_PER_FIRST * first->iterations)};
  PetscCall(PetscStrncpy(choice->snes, pdas ? SNESVINEWTONRSLS : SNESPDAS, sizeof(choice->snes)));
  PetscCall(PetscStrncpy(choice->pc, multigrid ? PCTRUNCATEDMG : PCCHOLESKY, sizeof(choice->pc)));
  PetscCall(PetscOptionsGetString(NULL, prefix, "-pc_type", choice->pc, sizeof(choice->pc), &set));
  PetscCall(PetscStrncpy(choice->ksp, SolverChoiceFactors(choice->pc) ? KSPPREONLY : KSPCG, sizeof(choice->ksp)));
  PetscCall(PetscOptionsGetString(NULL, prefix, "-ksp_type", choice->ksp, sizeof(choice->ksp), NULL));
  choice->own = (PetscBool)!set;
  if (vi->friction) {
    PetscCall(PetscStrncpy(choice->snes, SNESPDAS, sizeof(choice->snes)));
    choice->fixed_point = PETSC_TRUE;
  }
  choice->nested = SolverChoiceNested_Private(vi, choice->snes, choice->pc);
  PetscCall(SolverChoiceCheckTogether_Private(PetscObjectComm((PetscObject)vi->b), choice));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverChoiceSetFallback(const SolverReport *report, SolverChoice *choice, PetscBool *again)
{
  const PetscBool costly = (PetscBool)!strcmp(report->reason, FAILURE_COST);
  char            words[128], why[160];

  PetscFunctionBeginUser;
  *again = (PetscBool)(!report->converged &&
                       (choice->reducible || (choice->own && (costly || !strcmp(report->reason, FAILURE_ITERATIVE)))));
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolverChoiceDescribe(choice->ksp, choice->pc, NULL, words, sizeof(words)));
  if (costly) {
    PetscCall(PetscSNPrintf(why, sizeof(why),
                            "has cost %.0f products with the matrix, over a quarter of a factorization (about %.0f)",
                            (double)report->work, (double)report->predicted_cost));
  } else {
    PetscCall(PetscStrncpy(why, "did not converge", sizeof(why)));
  }
  PetscCall(WarningAdd(&(Warning){.code = "solver_replaced", .advice = "-pc_type cholesky selects it at once"},
                       "%s %s; factorizing instead", words, why));
  choice->nested = choice->stop = PETSC_FALSE; // a factorization has no error estimate to stop at
  choice->reducible             = PETSC_FALSE;
  choice->replaces              = PETSC_TRUE;
  PetscCall(SolverChoiceFactor_Private(choice));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverView(Solver solver)
{
  SolverChoice choice;
  MPI_Comm     comm;
  char         words[128];
  const char  *levels = "";

  PetscFunctionBeginUser;
  PetscCall(PetscObjectGetComm((PetscObject)solver->vi->A, &comm));
  PetscCall(SolverChoiceSet(solver, &choice));
  if (!strcmp(choice.pc, PCTRUNCATEDMG) && solver->vi->mesh->num_levels == 1)
    levels = "; coarse levels consist of nodes, since the mesh has one level";
  PetscCall(SolverChoiceDescribe(choice.ksp, choice.pc, NULL, words, sizeof(words)));
  PetscCall(PetscPrintf(comm, "  solver %s: linear systems by %s (%s%s)\n", choice.snes, words, choice.why, levels));
  PetscFunctionReturn(PETSC_SUCCESS);
}
