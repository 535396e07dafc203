/* proximal.c -- the proximal point iteration.

   min 1/2 y'A y - b'y + 1/2 (y - y_j)'W (y - y_j), y <= upper, has one solution y_(j+1). It is closer to the
   solutions without the last term [1]. Along motions that only W resists the loads do no work. All else is so
   much stiffer than W that one or two steps suffice. The remaining term W (y_(j+1) - y_j) is the residual of
   the original problem and ends the iteration. The distance of y_(j+1) from y_j does not: along a free motion
   it is roundoff divided by W.

   For wide gaps a rigid motion first brings bodies together, and y is counted from there. Then y has the size
   of the strains and is not lost in the digits of that motion.

   References: [1] Rockafellar, Monotone operators and the proximal point algorithm, 1976. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "problem/frictionlaw.h"
#include "solve/proximal.h"

/* Tolerance of the proximal term relative to the forces, and relative to the tolerance of an iterative
   solver. */
static const PetscReal TERM_RTOL = 1e-13, TERM_PER_RTOL = 1e-2;
/* Tolerance of the last step in the energy norm, relative to the solution. */
static const PetscReal STEP_RTOL = 1e-9;
/* Inexact solves, or undecided forces on meshes of round surfaces, may leave a term of this size. A step that
   does not halve it will not reduce it further. */
static const PetscReal TERM_LIMIT = 1e-8, TERM_STAGNATION = 0.5;
/* Roundoff of forces relative to the diagonal times the displacements: bodies that overlap are pushed apart
   with nothing to press them together again. */
static const PetscReal FORCE_ROUNDOFF = 1e-13;
/* With friction a step may leave this part of the proximal term of the step before it, and the first one
   FIRST_LOOSE of the forces. Newton's method on the law takes a step less then, or two. */
static const PetscReal LOOSE_PART = 1e-2, FIRST_LOOSE = 1e-6;
/* Residual of a solution by a direct solver, relative to the forces. */
static const PetscReal LAW_RTOL = 1e-10;
/* Largest number of steps: two or three are usual. */
enum { PROXIMAL_MAX_STEPS = 50 };
/* A body that bends easily may resist a motion no more than W. A step that leaves more than SLOW_STEP of the
   term scales W by WEIGHT_REDUCTION, at most MAX_REDUCTIONS times. The first SEARCH_STEPS steps, which look
   for contacts, do not; but those with friction do that change no decision. */
static const PetscReal SLOW_STEP = 0.1, WEIGHT_REDUCTION = 1e-2;
enum { SEARCH_STEPS = 3, MAX_REDUCTIONS = 3 };
/* With friction, two steps have one direction if this part of the later term is across the earlier one. */
static const PetscReal OFF_DIRECTION = 1e-2;
/* After these reductions bodies still slide if a step leaves more than this part of the term. */
static const PetscReal STILL_SLIDES = 0.9;

PetscErrorCode ProximalBegin(VI vi, Solvability solvability, Proximal *proximal)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(proximal, sizeof(*proximal)));
  proximal->solved      = (Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper};
  proximal->solvability = solvability;
  if (!solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(vi->upper, &proximal->rest));
  PetscCall(VecDuplicate(vi->upper, &proximal->pull));
  PetscCall(VecDuplicate(vi->upper, &proximal->scale));
  if (vi->friction) PetscCall(VecDuplicate(vi->upper, &proximal->before));
  PetscCall(VecDuplicate(vi->b, &proximal->solved.b));
  PetscCall(VecDuplicate(vi->upper, &proximal->solved.upper));
  PetscCall(VICreateRegularized(vi, solvability->regularization, &proximal->solved.A));
  PetscCall(MatGetDiagonal(vi->A, proximal->scale));
  PetscCall(VecSqrtAbs(proximal->scale));
  PetscCall(VecReciprocal(proximal->scale));
  PetscCall(ProximalUpdate(proximal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalUpdate(Proximal *proximal)
{
  const VI vi = proximal->solved.vi;

  PetscFunctionBeginUser;
  if (!proximal->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecWAXPY(proximal->solved.upper, -1, proximal->solvability->approach, vi->upper));
  PetscCall(FrictionLawSetApproach(vi, proximal->solvability->approach));
  proximal->last = 1;
  PetscCall(VecZeroEntries(proximal->rest));
  PetscCall(VecCopy(vi->b, proximal->solved.b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the centre to y. */
static PetscErrorCode ProximalSetCenter_Private(Proximal *proximal, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(VecCopy(y, proximal->rest));
  PetscCall(VecPointwiseMult(proximal->solved.b, proximal->solvability->regularization, y));
  PetscCall(VecAXPY(proximal->solved.b, 1, proximal->solved.vi->b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalSetCenter(Proximal *proximal, Vec y)
{
  PetscFunctionBeginUser;
  if (!proximal->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecAXPY(y, -1, proximal->solvability->approach));
  PetscCall(ProximalSetCenter_Private(proximal, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the tolerance of the proximal term by that of the linear solver. */
static PetscErrorCode ProximalSetTolerance_Private(SNES snes, PetscReal *tolerance)
{
  KSP       ksp;
  PetscBool direct;
  PetscReal rtol;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct));
  PetscCall(KSPGetTolerances(ksp, &rtol, NULL, NULL, NULL));
  *tolerance = direct ? TERM_RTOL : PetscMax(TERM_RTOL, TERM_PER_RTOL * rtol);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets what the next solve may leave of the law of friction; nothing more than a solution, if that is about
   the same. */
static PetscErrorCode ProximalLoosen_Private(Proximal *proximal, SNES snes, PetscReal loose)
{
  PetscFunctionBeginUser;
  proximal->loose = loose > PetscMax(LAW_RTOL, proximal->tolerance / TERM_PER_RTOL) ? loose : 0;
  PetscCall(PDASSetFrictionTolerance(snes, proximal->loose));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalSetStart(Proximal *proximal, Vec guess, SNES snes, PetscBool pdas)
{
  const Solvability s = proximal->solvability;

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ProximalSetTolerance_Private(snes, &proximal->tolerance));
  if (guess) PetscCall(ProximalSetCenter_Private(proximal, guess));
  if (pdas && !guess) PetscCall(PDASSetStart(snes, s->start));
  if (!pdas || !proximal->solved.vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASSetFrictionCoupling(snes, PETSC_FALSE));
  PetscCall(ProximalLoosen_Private(proximal, snes, FIRST_LOOSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* |v| in the norm of diag(A)^-1 */
static PetscErrorCode ProximalSize_Private(const Proximal *proximal, Vec v, PetscReal *size)
{
  Vec scaled;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(v, &scaled));
  PetscCall(VecPointwiseMult(scaled, v, proximal->scale));
  PetscCall(VecNorm(scaled, NORM_2, size));
  PetscCall(VecDestroy(&scaled));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Measures the proximal term relative to the forces. These are those of the loads, or of the stresses without
   loads, or such that roundoff is limit without either. Measures the step in the energy norm relative to the
   solution. */
static PetscErrorCode ProximalMeasure_Private(Proximal *proximal, Vec y, PetscReal *part, PetscReal *way)
{
  const Mat   A = proximal->solved.vi->A;
  Vec         d, forces;
  PetscReal   loads, stresses, pull, alone, forced;
  PetscScalar all, last;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &d));
  PetscCall(VecDuplicate(y, &forces));
  PetscCall(ProximalSize_Private(proximal, proximal->solved.vi->b, &loads));
  PetscCall(MatMult(A, y, forces));
  PetscCall(VecDot(y, forces, &all));
  PetscCall(ProximalSize_Private(proximal, forces, &stresses));
  PetscCall(VecWAXPY(d, -1, proximal->rest, y));
  PetscCall(VecPointwiseMult(proximal->pull, d, proximal->solvability->regularization));
  PetscCall(ProximalSize_Private(proximal, proximal->pull, &pull));
  PetscCall(MatMult(A, d, forces));
  PetscCall(VecDot(d, forces, &last));
  PetscCall(VecPointwiseDivide(forces, y, proximal->scale)); // y in the norm of diag(A)
  PetscCall(VecNorm(forces, NORM_2, &alone));
  forced = PetscMax(loads, stresses);
  *part  = pull > 0 ? pull / (forced > FORCE_ROUNDOFF * alone ? forced : FORCE_ROUNDOFF / TERM_LIMIT * alone) : 0;
  *way =
      PetscRealPart(last) > 0 && PetscRealPart(all) > 0 ? PetscSqrtReal(PetscRealPart(last) / PetscRealPart(all)) : 0;
  PetscCall(VecDestroy(&d));
  PetscCall(VecDestroy(&forces));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forgets the step before, as the first step of all and the first one with another W do. */
static PetscErrorCode ProximalForget_Private(Proximal *proximal)
{
  PetscFunctionBeginUser;
  proximal->ratio = 0;
  if (proximal->before) PetscCall(VecZeroEntries(proximal->before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Scales W down. */
static PetscErrorCode ProximalReduceWeight_Private(Proximal *proximal, SNES snes, PetscBool pdas)
{
  const Vec w = proximal->solvability->regularization;

  PetscFunctionBeginUser;
  proximal->num_reductions++;
  PetscCall(ProximalForget_Private(proximal));
  PetscCall(VecCopy(w, proximal->pull));
  PetscCall(VecScale(w, WEIGHT_REDUCTION));
  PetscCall(VecAYPX(proximal->pull, -1, w));
  if (proximal->solved.vi->assembled) {
    PetscCall(MatDiagonalSet(proximal->solved.A, proximal->pull, ADD_VALUES));
  } else { // products use w itself, but the shell must be marked as changed
    PetscCall(MatAssemblyBegin(proximal->solved.A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(proximal->solved.A, MAT_FINAL_ASSEMBLY));
  }
  if (pdas) { // destroys the factors
    PetscCall(PDASSetKeep(snes, PETSC_FALSE));
    PetscCall(PDASSetKeep(snes, PETSC_TRUE));
  }
  if (pdas && proximal->solved.vi->friction && proximal->num_reductions == MAX_REDUCTIONS)
    PetscCall(PDASSetFrictionCoupling(snes, PETSC_TRUE)); // of states that may slide on
  PetscCall(PetscInfo(snes, "the proximal term is scaled by %g\n", (double)WEIGHT_REDUCTION));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the ratio of the last two terms if both have one direction. It then holds for further steps, also for
   those from a centre that is not the end of the step before. */
static PetscErrorCode ProximalCompare_Private(Proximal *proximal)
{
  PetscScalar square, product, own;
  PetscReal   ratio = 0;

  PetscFunctionBeginUser;
  PetscCall(VecDot(proximal->before, proximal->before, &square));
  PetscCall(VecDot(proximal->pull, proximal->before, &product));
  PetscCall(VecDot(proximal->pull, proximal->pull, &own));
  if (PetscRealPart(square) > 0) ratio = PetscRealPart(product) / PetscRealPart(square);
  if (PetscRealPart(own) - ratio * PetscRealPart(product) > PetscSqr(OFF_DIRECTION) * PetscRealPart(own)) {
    proximal->ratio = 0;
  } else if (proximal->ratio == 0 && ratio > 0 && ratio <= SLOW_STEP) {
    proximal->ratio = ratio;
  }
  PetscCall(VecCopy(proximal->pull, proximal->before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The next centre is y. Where bodies slide on in one direction, it is the limit of the steps. */
static PetscErrorCode ProximalAdvance_Private(Proximal *proximal, Vec y)
{
  Vec limit;

  PetscFunctionBeginUser;
  if (proximal->ratio == 0) {
    PetscCall(ProximalSetCenter_Private(proximal, y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecDuplicate(y, &limit));
  PetscCall(VecWAXPY(limit, -1, proximal->rest, y));
  PetscCall(VecAYPX(limit, proximal->ratio / (1 - proximal->ratio), y));
  PetscCall(ProximalSetCenter_Private(proximal, limit));
  PetscCall(VecDestroy(&limit));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gives up after too many steps, or where friction does not hold bodies: they slide as far as W lets them,
   and what W takes of the forces hardly falls. [in] part - what W takes; [out] failed */
static PetscErrorCode ProximalGiveUp_Private(const Proximal *proximal, PetscReal part, SolverReport *report,
                                             PetscBool *failed)
{
  PetscFunctionBeginUser;
  report->slid = (PetscBool)(proximal->solved.vi->friction && proximal->num_reductions == MAX_REDUCTIONS &&
                             part > STILL_SLIDES * proximal->last);
  *failed      = (PetscBool)(report->slid || report->proximal_steps == PROXIMAL_MAX_STEPS);
  if (!*failed) PetscFunctionReturn(PETSC_SUCCESS);
  report->converged = PETSC_FALSE;
  if (report->slid) {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                            "the bodies slide on and on, and %.1e of the forces stay without balance: friction may "
                            "not hold these loads",
                            (double)part));
  } else {
    PetscCall(
        PetscSNPrintf(report->reason, sizeof(report->reason),
                      "the proximal point iteration did not converge in %d steps: its term is %.1e of the forces; "
                      "does contact hold every body?",
                      PROXIMAL_MAX_STEPS, (double)part));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the step looked for contacts: one of the first, unless it has friction and changed no decision. */
static PetscErrorCode ProximalSearches_Private(const Proximal *proximal, SNES snes, PetscBool pdas, PetscInt steps,
                                               PetscBool *searches)
{
  const PetscInt *changed;
  PetscInt        num, sum = 0;

  PetscFunctionBeginUser;
  *searches = (PetscBool)(steps < SEARCH_STEPS);
  if (steps == 1 || !*searches || !pdas || !proximal->solved.vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASGetHistory(snes, &num, NULL, &changed, NULL));
  for (PetscInt k = 0; k < num; k++) sum += changed[k];
  *searches = (PetscBool)(sum > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalCheck(Proximal *proximal, SNES snes, Vec y, SolverReport *report, PetscBool *done)
{
  PetscReal part = 0, way = 0, left = 0, limit;
  PetscBool pdas, failed, searches;
  Vec       active;

  PetscFunctionBeginUser;
  *done = PETSC_TRUE;
  if (!proximal->solvability || !report->converged) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ProximalMeasure_Private(proximal, y, &part, &way));
  PetscCall(PetscInfo(
      snes, "proximal point step %" PetscInt_FMT ": the term is %g of the forces, the step %g of the solution\n",
      report->proximal_steps, (double)part, (double)way));
  /* the next step is smaller by the same factor as the term; the first one does not tell */
  if (report->proximal_steps > 1) way *= PetscMax(part / proximal->last, proximal->ratio);
  if (proximal->loose > 0) PetscCall(PDASGetLinear(snes, NULL, &left, NULL));
  if (part <= proximal->tolerance && way <= STEP_RTOL && left <= LAW_RTOL) PetscFunctionReturn(PETSC_SUCCESS);
  limit = PetscMax(TERM_LIMIT, proximal->solvability->undecided);
  if (proximal->loose == 0 && part <= limit &&
      part > TERM_STAGNATION * proximal->last) { // roundoff: the better one of the last two steps is final
    if (part > proximal->last) PetscCall(VecCopy(proximal->rest, y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(ProximalGiveUp_Private(proximal, part, report, &failed));
  if (failed) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (report->proximal_steps == 1) {
    PetscCall(ProximalForget_Private(proximal));
  } else if (proximal->before) {
    PetscCall(ProximalCompare_Private(proximal));
  }
  PetscCall(ProximalSearches_Private(proximal, snes, pdas, report->proximal_steps, &searches));
  if (!searches && part > PetscMax(SLOW_STEP * proximal->last, limit) && proximal->num_reductions < MAX_REDUCTIONS)
    PetscCall(ProximalReduceWeight_Private(proximal, snes, pdas));
  proximal->last = part;
  *done          = PETSC_FALSE;
  PetscCall(ProximalAdvance_Private(proximal, y));
  if (pdas) {
    PetscCall(PDASGetActive(snes, &active));
    PetscCall(PDASSetStart(snes, active));
    if (proximal->solved.vi->friction)
      PetscCall(ProximalLoosen_Private(proximal, snes, PetscMin(FIRST_LOOSE, LOOSE_PART * part)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalTestSliding(const Proximal *proximal, const FrictionReport *friction, Vec y)
{
  Vec forces, step;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &forces));
  PetscCall(VecDuplicate(y, &step));
  PetscCall(MatMult(proximal->solved.A, y, forces));
  PetscCall(VecAYPX(forces, -1, proximal->solved.b)); // without the proximal term
  PetscCall(VecWAXPY(step, -1, proximal->rest, y));
  PetscCall(SolvabilityTestSliding(proximal->solved.vi, proximal->solvability, friction, forces, step));
  PetscCall(VecDestroy(&forces));
  PetscCall(VecDestroy(&step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalFinish(const Proximal *proximal, Vec y)
{
  PetscFunctionBeginUser;
  if (proximal->solvability) PetscCall(VecAXPY(y, 1, proximal->solvability->approach));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProximalEnd(Proximal *proximal, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(ProximalFinish(proximal, y));
  /* another solver begins with the whole W: under less, bodies slide so far that roundoff balances loads */
  if (proximal->num_reductions)
    PetscCall(VecScale(proximal->solvability->regularization,
                       PetscPowReal(WEIGHT_REDUCTION, -(PetscReal)proximal->num_reductions)));
  if (!proximal->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDestroy(&proximal->solved.upper));
  PetscCall(MatDestroy(&proximal->solved.A));
  PetscCall(VecDestroy(&proximal->solved.b));
  PetscCall(VecDestroy(&proximal->rest));
  PetscCall(VecDestroy(&proximal->pull));
  PetscCall(VecDestroy(&proximal->before));
  PetscCall(VecDestroy(&proximal->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}
