/* errorbound.c -- bound on the distance of a displacement from the solution, in the energy norm (eq. 11.2).

   y^ is y moved to the bounds where eq. 10.1 requires it, and below them elsewhere. A is the set of the
   former, F all others. Let d vanish on A. Let nonnegative pressures on A balance A (y^ + d), with none on F:

       b - A (y^ + d) = 0 on F,   >= 0 on A.

   Then the distance of the solution from y^ is at most that of y^ + d. The solution d of the set's own system
   qualifies unless a pressure is negative; then its node leaves A. So the factors of the last step serve once
   more. No norm of the inverse of A is needed.

   With a proximal term the factors are those of A + W. Then d is the limit of corrections, each with the term
   W d of the previous one. The remaining residual is a force along free motions. The exact problem would have
   no solution with it: it is roundoff, and is ignored.

   With friction of given limits (Tresca), tangents that stick are fixed as well, and those that slip carry a
   load at the limit. A tangent beyond its limit is released, with its force cut to the limit (eq. 16.10).

   An iterative solver has no d. Its preconditioner B and the smallest Ritz value alpha of B A_FF from
   conjugate gradients estimate |d|_A^2 by f.B f / alpha. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "pdas/pdasimpl.h"
#include "problem/frictionlaw.h"
#include "solve/errorbound.h"

/* Largest number of sets; the last one is empty, without negative pressures. Largest number of corrections
   for a proximal term. */
enum { BOUND_SETS = 4, MAX_CORRECTIONS = 50 };
/* A traction counts as at its limit within this part of it: the tolerance of ties of the solver. */
static const PetscReal AT_LIMIT = 1e-11;
/* Tolerance of the corrections relative to the residual: the bound needs few digits. */
static const PetscReal CORRECTION_RTOL = 1e-6;
/* Tolerance of a solve that only computes factors or Ritz values. */
static const PetscReal FACTOR_RTOL = 1e-3;

typedef struct {
  ActiveSolver       solver;
  Mat                A; /* without proximal term */
  Vec                b;
  Vec                r;       /* b - A y^ */
  Vec                f, d;    /* right-hand side of d, 0 on A, in place of r where there are no factors; d */
  Vec                s, c;    /* its residual, NULL where there are no factors; its next correction, scratch */
  const FrictionLaw *law;     /* of given limits, or NULL; borrowed */
  PetscInt          *tangent; /* where its tangents stand among the unknowns of the set, -1 for none [law->n][2] */
  PetscReal         *start;   /* values of fixed unknowns: upper, of tangents the origin [n] */
  PetscBool         *fixed;
  PetscReal         *values, *forces; /* of bounded unknowns [n] */
} Bound;

static PetscErrorCode ErrorBoundBoundCreate_Private(ActiveSolver solver, Mat A, Vec b, const FrictionLaw *law, Bound *m)
{
  const PetscInt n = solver->set->n;

  PetscFunctionBeginUser;
  *m = (Bound){.solver = solver, .A = A, .b = b, .law = law};
  PetscCall(VecDuplicate(b, &m->r));
  PetscCall(VecDuplicate(b, &m->d));
  PetscCall(VecDuplicate(b, &m->c));
  if (solver->factored) { // a preconditioner needs less: here a large run takes most memory
    PetscCall(VecDuplicate(b, &m->f));
    PetscCall(VecDuplicate(b, &m->s));
  } else {
    PetscCall(PetscObjectReference((PetscObject)m->r));
    m->f = m->r;
  }
  PetscCall(PetscMalloc4(n, &m->fixed, n, &m->values, n, &m->forces, n, &m->start));
  PetscCall(PetscArraycpy(m->start, solver->set->upper, n));
  if (!law) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(FRICTION_TANGENTS * law->n, &m->tangent));
  for (PetscInt i = 0; i < FRICTION_TANGENTS * law->n; i++) {
    m->tangent[i] = -1;
    if (law->tangent[i] >= 0) PetscCall(PetscFindInt(law->tangent[i], n, solver->set->dof, &m->tangent[i]));
    if (m->tangent[i] >= 0) m->start[m->tangent[i]] = law->origin[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ErrorBoundBoundDestroy_Private(Bound *m)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&m->r));
  PetscCall(VecDestroy(&m->f));
  PetscCall(VecDestroy(&m->d));
  PetscCall(VecDestroy(&m->s));
  PetscCall(VecDestroy(&m->c));
  PetscCall(PetscFree4(m->fixed, m->values, m->forces, m->start));
  PetscCall(PetscFree(m->tangent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A force of node a at its limit along a vector of its tangents, or none: the load of a slipping node.
   [in] along - [2], [in,out] m->r, by r of the set [n] */
static void ErrorBoundLoadNode_Private(Bound *m, PetscInt a, const PetscReal along[], PetscReal r[])
{
  const PetscInt *t    = &m->tangent[FRICTION_TANGENTS * a];
  const PetscReal size = VectorNorm(t[1] < 0 ? 1 : FRICTION_TANGENTS, along);

  for (PetscInt i = 0; i < FRICTION_TANGENTS && t[i] >= 0; i++) {
    m->fixed[t[i]] = PETSC_FALSE;
    if (size > 0) r[t[i]] -= m->law->bound[a] * along[i] / size;
  }
}

/* Tangents that stick are fixed at their origin. [in,out] m->values, m->forces - of y [n]; [out] slips -
   whether a node slips [law->n] */
static void ErrorBoundStick_Private(Bound *m, PetscBool slips[])
{
  for (PetscInt a = 0; m->law && a < m->law->n; a++) {
    const PetscInt *t    = &m->tangent[FRICTION_TANGENTS * a];
    const PetscInt  num  = t[1] < 0 ? 1 : FRICTION_TANGENTS;
    PetscReal       q[2] = {0, 0};

    for (PetscInt i = 0; i < num; i++)
      q[i] = m->forces[t[i]] + m->solver->set->diag[t[i]] * (m->values[t[i]] - m->start[t[i]]);
    slips[a] = (PetscBool)(VectorNorm(num, q) > m->law->bound[a]);
    for (PetscInt i = 0; i < num; i++) {
      m->fixed[t[i]] = (PetscBool)!slips[a];
      if (!slips[a]) m->values[t[i]] = m->start[t[i]];
    }
  }
}

/* Loads of slipping nodes, along their slip; r becomes the residual with them. [in] m->values - of y^;
   slips - of ErrorBoundStick_Private() */
static PetscErrorCode ErrorBoundLoad_Private(Bound *m, const PetscBool slips[])
{
  const ActiveSet *set = m->solver->set;

  PetscFunctionBeginUser;
  if (!m->law) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ActiveSetGather(set, m->r, m->forces));
  for (PetscInt a = 0; a < m->law->n; a++) {
    const PetscInt *t    = &m->tangent[FRICTION_TANGENTS * a];
    PetscReal       s[2] = {0, 0};

    for (PetscInt i = 0; i < FRICTION_TANGENTS && t[i] >= 0; i++) s[i] = m->values[t[i]] - m->start[t[i]];
    if (slips[a]) ErrorBoundLoadNode_Private(m, a, s, m->forces);
  }
  PetscCall(ActiveSetScatter(set, m->forces, m->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y^: y with the values of the set. [out] at - y^ */
static PetscErrorCode ErrorBoundMove_Private(const Bound *m, Vec y, Vec at)
{
  PetscFunctionBeginUser;
  PetscCall(VecCopy(y, at));
  PetscCall(ActiveSetScatter(m->solver->set, m->values, at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Computes the set of y^ and its residual. [out] moved - |y^ - y|_A; m->values - of y^ */
static PetscErrorCode ErrorBoundFeasible_Private(Bound *m, Vec y, PetscReal *moved)
{
  const ActiveSet *set = m->solver->set;
  PetscScalar      square;
  PetscBool       *slips;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m->law ? m->law->n : 0, &slips));
  PetscCall(CompensatedResidual(m->A, m->b, y, m->r));
  PetscCall(ActiveSetGather(set, y, m->values));
  PetscCall(ActiveSetGather(set, m->r, m->forces));
  for (PetscInt i = 0; i < set->n; i++) {
    m->fixed[i]  = (PetscBool)(m->forces[i] + set->diag[i] * (m->values[i] - set->upper[i]) > 0);
    m->values[i] = m->fixed[i] ? set->upper[i] : PetscMin(m->values[i], set->upper[i]);
  }
  ErrorBoundStick_Private(m, slips);
  PetscCall(ErrorBoundMove_Private(m, y, m->c));
  PetscCall(VecWAXPY(m->d, -1, y, m->c));
  PetscCall(MatMult(m->A, m->d, m->c));
  PetscCall(VecDot(m->c, m->d, &square));
  *moved = PetscSqrtReal(PetscMax(PetscRealPart(square), 0));
  if (*moved > 0) {
    PetscCall(ErrorBoundMove_Private(m, y, m->c));
    PetscCall(CompensatedResidual(m->A, m->b, m->c, m->r));
  }
  PetscCall(ErrorBoundLoad_Private(m, slips));
  PetscCall(PetscFree(slips));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* |v| in the norm of diag(A)^-1 */
static PetscErrorCode ErrorBoundSize_Private(Bound *m, Vec v, PetscReal *size)
{
  PetscScalar square;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseDivide(m->c, v, m->solver->diag));
  PetscCall(VecDot(v, m->c, &square));
  *size = PetscSqrtReal(PetscRealPart(square));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* f: the residual without the part that pressures balance: all of it on the set, or the nonnegative part. */
static PetscErrorCode ErrorBoundUnbalanced_Private(Bound *m, PetscBool all)
{
  const ActiveSet *set = m->solver->set;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(m->r, m->f));
  PetscCall(ActiveSetGather(set, m->r, m->forces));
  for (PetscInt i = 0; i < set->n; i++) {
    if (m->fixed[i]) m->forces[i] = all ? 0 : PetscMin(m->forces[i], 0);
  }
  PetscCall(ActiveSetScatter(set, m->forces, m->f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* s = f - A d but for the set; m->forces = its values on the set. */
static PetscErrorCode ErrorBoundRest_Private(Bound *m)
{
  const ActiveSet *set = m->solver->set;

  PetscFunctionBeginUser;
  PetscCall(MatMult(m->A, m->d, m->s));
  PetscCall(VecAYPX(m->s, -1, m->f));
  PetscCall(ActiveSetGather(set, m->s, m->forces));
  for (PetscInt i = 0; i < set->n; i++) m->values[i] = m->fixed[i] ? 0 : m->forces[i];
  PetscCall(ActiveSetScatter(set, m->values, m->s));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d with A d = f but for the set, up to forces along free motions. [out] square - |d|_A^2, NAN if there is
   none; m->values = A d on the set */
static PetscErrorCode ErrorBoundCorrect_Private(Bound *m, PetscReal *square)
{
  PetscReal   size, left, change, alpha;
  PetscScalar work;

  PetscFunctionBeginUser;
  *square = NAN;
  PetscCall(VecZeroEntries(m->d));
  PetscCall(ErrorBoundRest_Private(m));
  PetscCall(ErrorBoundSize_Private(m, m->f, &size));
  left = change = size;
  for (PetscInt k = 0; k < MAX_CORRECTIONS && PetscMin(left, change) > CORRECTION_RTOL * size; k++) {
    Vec before;

    PetscCall((*m->solver->correct)(m->solver, m->s, m->c, &alpha));
    PetscCall(VecAXPY(m->d, 1, m->c));
    PetscCall(VecDuplicate(m->s, &before));
    PetscCall(VecCopy(m->s, before));
    PetscCall(ErrorBoundRest_Private(m));
    PetscCall(VecAXPY(before, -1, m->s));
    PetscCall(ErrorBoundSize_Private(m, before, &change));
    PetscCall(ErrorBoundSize_Private(m, m->s, &left));
    PetscCall(VecDestroy(&before));
    PetscCall(PetscInfo(m->A, "unbalanced %g, changed by %g, of %g\n", (double)left, (double)change, (double)size));
  }
  if (PetscMin(left, change) > CORRECTION_RTOL * size) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecWAXPY(m->c, -1, m->s, m->f));
  PetscCall(VecDot(m->c, m->d, &work));
  *square = PetscAbsReal(PetscRealPart(work)); // negative by roundoff, whose size it shows
  PetscCall(MatMult(m->A, m->d, m->c));
  PetscCall(ActiveSetGather(m->solver->set, m->c, m->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Releases tangents that stick by more than their limit; from then on they carry the limit.
   [in] m->forces, m->values - as in ErrorBoundRelease_Private(); [in,out] num */
static PetscErrorCode ErrorBoundReleaseTangents_Private(Bound *m, PetscInt *num)
{
  PetscFunctionBeginUser;
  if (!m->law) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt a = 0; a < m->law->n; a++) {
    const PetscInt *t    = &m->tangent[FRICTION_TANGENTS * a];
    PetscReal       q[2] = {0, 0};

    if (!m->fixed[t[0]]) continue;
    for (PetscInt i = 0; i < FRICTION_TANGENTS && t[i] >= 0; i++) q[i] = m->forces[t[i]] - m->values[t[i]];
    if (VectorNorm(FRICTION_TANGENTS, q) <= m->law->bound[a] * (1 + AT_LIMIT)) continue;
    ErrorBoundLoadNode_Private(m, a, q, m->forces);
    ++*num;
  }
  PetscCall(ActiveSetScatter(m->solver->set, m->forces, m->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes nodes with negative pressure from the set: b - A (y^ + d) < 0. [out] num - of all ranks */
static PetscErrorCode ErrorBoundRelease_Private(Bound *m, PetscInt *num)
{
  const ActiveSet *set = m->solver->set;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetGather(set, m->r, m->forces));
  *num = 0;
  for (PetscInt i = 0; i < set->n; i++) {
    if (!m->fixed[i] || set->upper[i] == PETSC_INFINITY || m->forces[i] >= m->values[i]) continue;
    m->fixed[i] = PETSC_FALSE;
    ++*num;
  }
  PetscCall(ErrorBoundReleaseTangents_Private(m, num));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_INT, MPI_SUM, set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Computes factors for the set. [out] done - whether they exist */
static PetscErrorCode ErrorBoundFactor_Private(Bound *m, PetscBool *done)
{
  const ActiveSet *set = m->solver->set;
  ActiveSolution   solution;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(set, &solution));
  PetscCall((*m->solver->solve)(m->solver, m->fixed, m->start, &solution));
  *done = (PetscBool)!solution.failure;
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The smallest |d|_A. [in] ready - whether the solver has factors for its own set */
static PetscErrorCode ErrorBoundDistance_Private(Bound *m, PetscBool ready, PetscReal *square)
{
  const ActiveSet *set     = m->solver->set;
  PetscInt         pulling = 1;

  PetscFunctionBeginUser;
  *square = NAN;
  for (PetscInt i = 0; i < set->n; i++) ready = (PetscBool)(ready && m->fixed[i] == set->active[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &ready, 1, MPIU_BOOL, MPI_LAND, set->comm));
  for (PetscInt k = 0; k < BOUND_SETS && pulling; k++) {
    if (k == BOUND_SETS - 1) PetscCall(PetscArrayzero(m->fixed, set->n));
    if (!ready) PetscCall(ErrorBoundFactor_Private(m, &ready));
    if (!ready) PetscFunctionReturn(PETSC_SUCCESS);
    PetscCall(ErrorBoundUnbalanced_Private(m, PETSC_TRUE));
    if (m->solver->measure && m->solver->A == m->A)
      PetscCall((*m->solver->measure)(m->solver, m->f, square, m->values));
    else
      PetscCall(ErrorBoundCorrect_Private(m, square));
    if (PetscIsNanReal(*square)) PetscFunctionReturn(PETSC_SUCCESS);
    PetscCall(ErrorBoundRelease_Private(m, &pulling));
    ready = PETSC_FALSE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The estimate by a preconditioner. */
static PetscErrorCode ErrorBoundEstimate_Private(Bound *m, PetscBool ready, PetscReal *square)
{
  PetscScalar work;
  PetscReal   alpha;

  PetscFunctionBeginUser;
  *square = NAN;
  if (!ready) PetscCall(ErrorBoundFactor_Private(m, &ready));
  if (!ready) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ErrorBoundUnbalanced_Private(m, PETSC_FALSE));
  PetscCall(VecDestroy(&m->c)); // room for the preconditioner
  PetscCall((*m->solver->correct)(m->solver, m->f, m->d, &alpha));
  PetscCall(VecDot(m->f, m->d, &work));
  if (alpha > 0 && PetscRealPart(work) >= 0) *square = PetscRealPart(work) / alpha;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The bound with a given solver. */
static PetscErrorCode ErrorBoundApply_Private(ActiveSolver solver, PetscBool ready, const VI vi, Vec y,
                                              EnergyBound *bound)
{
  Bound     m;
  PetscReal moved = 0, square = NAN;

  PetscFunctionBeginUser;
  PetscCall(ErrorBoundBoundCreate_Private(solver, vi->A, vi->b, vi->friction, &m));
  PetscCall(ErrorBoundFeasible_Private(&m, y, &moved));
  bound->estimated = (PetscBool)!solver->factored;
  if (solver->factored)
    PetscCall(ErrorBoundDistance_Private(&m, ready, &square));
  else
    PetscCall(ErrorBoundEstimate_Private(&m, ready, &square));
  bound->value = moved + PetscSqrtReal(square);
  PetscCall(ErrorBoundBoundDestroy_Private(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorBoundCompute(const Proximal *proximal, SNES snes, Vec y, EnergyBound *bound)
{
  const Inequality   *solved = &proximal->solved;
  const VI            vi     = solved->vi;
  SNESConvergedReason reason;
  ActiveSolver        solver;
  ActiveSet           set;
  PetscReal           size;
  const char         *failure;
  PetscBool           given = PETSC_TRUE;

  PetscFunctionBeginUser;
  *bound = (EnergyBound){.value = NAN};
  if (vi->friction) PetscCall(FrictionLawIsGiven(vi, &given));
  if (!given) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCall(VecNorm(y, NORM_2, &size));
  if (reason == SNES_DIVERGED_LINEAR_SOLVE || PetscIsInfOrNanReal(size)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASGetSolver(snes, &solver));
  if (solver) {
    PetscCall(ErrorBoundApply_Private(solver, (PetscBool)!vi->friction, vi, y, bound));
  } else {
    PetscCall(vi->friction ? ActiveSetCreateWithTangents(solved->upper, solved->A, vi->friction, &set)
                           : ActiveSetCreate(solved->upper, solved->A, &set));
    PetscCall(PDASCreateSolver(snes, &set, solved->A, solved->b, FACTOR_RTOL, &solver, &failure));
    if (!failure) PetscCall(ErrorBoundApply_Private(solver, PETSC_FALSE, vi, y, bound));
    PetscCall(ActiveSolverDestroy(&solver));
    PetscCall(ActiveSetDestroy(&set));
  }
  bound->value *= PetscSqrtReal(vi->stiffness) * vi->length;
  PetscFunctionReturn(PETSC_SUCCESS);
}
