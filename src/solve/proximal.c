/* proximal.c -- weak springs that come to rest at the solution.

   min 1/2 y'A y - b'y + 1/2 (y - y_j)'W (y - y_j),  y <= upper,   has one solution y_(j+1), which is nearer to those without the last
   term [1]: where nothing but the springs resists a motion they have no work to do, since the loads do none on it, and everything else
   is so much stiffer that one or two repetitions leave nothing of them. What they still pull is the residual of the original problem,
   and ends the iteration: the distance of y_(j+1) from y_j does not, along a free motion it is rounding divided by W.

   Where gaps are wide, bodies cross them rigidly before anything is solved, and y is counted from there: what is solved for is of the
   size of the strains, and not lost in the way bodies went.

   References: [1] Rockafellar, Monotone operators and the proximal point algorithm, 1976. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "solve/proximal.h"

/* The pull of springs that does not matter, in parts of the forces, and in parts of the residual that an iteration may leave. */
static const PetscReal RELAXED = 1e-13, BESIDE = 1e-2;
/* In the norm of energy, the part of the solution that springs may keep from it. */
static const PetscReal KEPT = 1e-9;
/* What inexact solves leave may be as large, or what meshes of round surfaces do not decide about: a sweep that does not halve it will not
   help. */
static const PetscReal TOLERATED = 1e-8, HALVED = 0.5;
/* Forces that are nothing but rounding, in parts of those that would move every node alone as far as it moves: bodies that overlap are
   pushed apart where nothing presses them together again. */
static const PetscReal ROUNDING = 1e-13;
/* Sweeps after which something is wrong: two or three are usual. */
enum { MAX_SWEEPS = 50 };
/* A body that bends easily may resist a motion no more than springs do: where a sweep leaves more than this part of what they pull, and it was not
   one of the first, which look for contacts, springs get weaker by that factor, so many times. */
static const PetscReal SLOW = 0.1, WEAKER = 1e-2;
enum { SEARCHING = 3, MOST_WEAKER = 3 };

PetscErrorCode SpringsBegin(VI vi, Solvability solvability, Springs *springs)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(springs, sizeof(*springs)));
  springs->solved      = (Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper};
  springs->solvability = solvability;
  if (!solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(vi->upper, &springs->rest));
  PetscCall(VecDuplicate(vi->upper, &springs->pull));
  PetscCall(VecDuplicate(vi->upper, &springs->scale));
  PetscCall(VecDuplicate(vi->b, &springs->solved.b));
  PetscCall(VecDuplicate(vi->upper, &springs->solved.upper));
  PetscCall(VecWAXPY(springs->solved.upper, -1, solvability->approach, vi->upper));
  PetscCall(VICreateRegularized(vi, solvability->regularization, &springs->solved.A));
  PetscCall(MatGetDiagonal(vi->A, springs->scale));
  PetscCall(VecSqrtAbs(springs->scale));
  PetscCall(VecReciprocal(springs->scale));
  springs->last = 1;
  PetscCall(VecZeroEntries(springs->rest));
  PetscCall(VecCopy(vi->b, springs->solved.b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Springs rest at y. */
static PetscErrorCode RestAt_Private(Springs *springs, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(VecCopy(y, springs->rest));
  PetscCall(VecPointwiseMult(springs->solved.b, springs->solvability->regularization, y));
  PetscCall(VecAXPY(springs->solved.b, 1, springs->solved.vi->b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SpringsFollow(Springs *springs, Vec y)
{
  PetscFunctionBeginUser;
  if (!springs->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecAXPY(y, -1, springs->solvability->approach));
  PetscCall(RestAt_Private(springs, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The pull that does not matter beside what the linear solver leaves. */
static PetscErrorCode Relaxed_Private(SNES snes, PetscReal *relaxed)
{
  KSP       ksp;
  PetscBool direct;
  PetscReal rtol;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct));
  PetscCall(KSPGetTolerances(ksp, &rtol, NULL, NULL, NULL));
  *relaxed = direct ? RELAXED : PetscMax(RELAXED, BESIDE * rtol);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SpringsSet(Springs *springs, Vec guess, SNES snes, PetscBool pdas)
{
  const Solvability s = springs->solvability;

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Relaxed_Private(snes, &springs->relaxed));
  if (guess) PetscCall(RestAt_Private(springs, guess));
  if (pdas && !guess) PetscCall(PDASSetStart(snes, s->start));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* |v| in the norm of diag(A)^-1 */
static PetscErrorCode Size_Private(const Springs *springs, Vec v, PetscReal *size)
{
  Vec scaled;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(v, &scaled));
  PetscCall(VecPointwiseMult(scaled, v, springs->scale));
  PetscCall(VecNorm(scaled, NORM_2, size));
  PetscCall(VecDestroy(&scaled));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the springs pull, in parts of the forces: of the loads, or of the stresses where there are none, or so that rounding is tolerated where
   there is nothing else; and how far the sweep went, in the norm
   of energy and in parts of the solution. */
static PetscErrorCode Measure_Private(Springs *springs, Vec y, PetscReal *part, PetscReal *way)
{
  const Mat   A = springs->solved.vi->A;
  Vec         d, forces;
  PetscReal   loads, stresses, pull, alone, forced;
  PetscScalar all, last;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &d));
  PetscCall(VecDuplicate(y, &forces));
  PetscCall(Size_Private(springs, springs->solved.vi->b, &loads));
  PetscCall(MatMult(A, y, forces));
  PetscCall(VecDot(y, forces, &all));
  PetscCall(Size_Private(springs, forces, &stresses));
  PetscCall(VecWAXPY(d, -1, springs->rest, y));
  PetscCall(VecPointwiseMult(springs->pull, d, springs->solvability->regularization));
  PetscCall(Size_Private(springs, springs->pull, &pull));
  PetscCall(MatMult(A, d, forces));
  PetscCall(VecDot(d, forces, &last));
  PetscCall(VecPointwiseDivide(forces, y, springs->scale)); // y in the norm of diag(A)
  PetscCall(VecNorm(forces, NORM_2, &alone));
  forced = PetscMax(loads, stresses);
  *part  = pull > 0 ? pull / (forced > ROUNDING * alone ? forced : ROUNDING / TOLERATED * alone) : 0;
  *way =
      PetscRealPart(last) > 0 && PetscRealPart(all) > 0 ? PetscSqrtReal(PetscRealPart(last) / PetscRealPart(all)) : 0;
  PetscCall(VecDestroy(&d));
  PetscCall(VecDestroy(&forces));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is solved from now on has weaker springs. */
static PetscErrorCode Weaken_Private(Springs *springs, SNES snes, PetscBool pdas)
{
  const Vec w = springs->solvability->regularization;

  PetscFunctionBeginUser;
  springs->weaker++;
  PetscCall(VecCopy(w, springs->pull));
  PetscCall(VecScale(w, WEAKER));
  PetscCall(VecAYPX(springs->pull, -1, w));
  if (springs->solved.vi->assembled) {
    PetscCall(MatDiagonalSet(springs->solved.A, springs->pull, ADD_VALUES));
  } else { // products see w itself, and nobody else knows that it has changed
    PetscCall(MatAssemblyBegin(springs->solved.A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(springs->solved.A, MAT_FINAL_ASSEMBLY));
  }
  if (pdas) { // what it has factored
    PetscCall(PDASSetKeep(snes, PETSC_FALSE));
    PetscCall(PDASSetKeep(snes, PETSC_TRUE));
  }
  PetscCall(PetscInfo(snes, "springs are weaker by %g\n", (double)WEAKER));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SpringsRelax(Springs *springs, SNES snes, Vec y, SolveReport *report, PetscBool *done)
{
  PetscReal part = 0, way = 0, tolerated;
  PetscBool pdas;
  Vec       active;

  PetscFunctionBeginUser;
  *done = PETSC_TRUE;
  if (!springs->solvability || !report->converged) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Measure_Private(springs, y, &part, &way));
  PetscCall(PetscInfo(snes, "sweep %" PetscInt_FMT ": springs pull %g of the forces, and gave %g of the solution\n",
                      report->sweeps, (double)part, (double)way));
  /* what the next sweep would give is as much less as the springs pull less; a first one does not tell */
  if (report->sweeps > 1) way *= part / springs->last;
  if (part <= springs->relaxed && way <= KEPT) PetscFunctionReturn(PETSC_SUCCESS);
  tolerated = PetscMax(TOLERATED, springs->solvability->undecided);
  if (part <= tolerated &&
      part > HALVED * springs->last) { // roundoff: the better one of the two last sweeps is as good as it gets
    if (part > springs->last) PetscCall(VecCopy(springs->rest, y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (report->sweeps == MAX_SWEEPS) {
    report->converged = PETSC_FALSE;
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                            "after %d sweeps the springs that hold bodies meanwhile still pull %.1e of the forces: is "
                            "contact near to letting a body go?",
                            MAX_SWEEPS, (double)part));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (report->sweeps >= SEARCHING && part > PetscMax(SLOW * springs->last, tolerated) && springs->weaker < MOST_WEAKER)
    PetscCall(Weaken_Private(springs, snes, pdas));
  springs->last = part;
  *done         = PETSC_FALSE;
  PetscCall(RestAt_Private(springs, y));
  if (pdas) {
    PetscCall(PDASGetActive(snes, &active));
    PetscCall(PDASSetStart(snes, active));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SpringsEnd(Springs *springs, Vec y)
{
  PetscFunctionBeginUser;
  if (!springs->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecAXPY(y, 1, springs->solvability->approach));
  PetscCall(VecDestroy(&springs->solved.upper));
  PetscCall(MatDestroy(&springs->solved.A));
  PetscCall(VecDestroy(&springs->solved.b));
  PetscCall(VecDestroy(&springs->rest));
  PetscCall(VecDestroy(&springs->pull));
  PetscCall(VecDestroy(&springs->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}
