/* frictionimpl.h -- the reduced problem with friction, on the first rank (eq. 16.3).

   All other unknowns are eliminated. Then r = g - S y at the bounded unknowns and their tangents, with S
   dense, symmetric and positive definite. A unit is one bounded unknown with its tangents; without friction
   it has no tangents. */
#ifndef MORTISE_FRICTIONIMPL_H
#define MORTISE_FRICTIONIMPL_H

#include "pdas/friction.h"
#include "pdas/pdasimpl.h"

#define FAILURE_FRICTION                                                                                               \
  "contact with friction did not converge: take smaller -load_steps; the coefficient may be so large that there are "  \
  "several solutions, or none"

/* Residual of the law, relative to the forces, that a solution may have. */
static const PetscReal FRICTION_RTOL = 1e-10;
/* rho below this needs few digits: what matters is whether it is below 1. */
static const PetscReal RHO_SMALL = 0.15;

typedef enum { UNIT_FREE, UNIT_STICK, UNIT_SLIP } UnitStatus;

typedef struct {
  PetscInt   normal;                          /* position in y */
  PetscInt   num, tangent[FRICTION_TANGENTS]; /* tangents, their positions */
  PetscReal  upper, coefficient, bound, origin[FRICTION_TANGENTS];
  PetscReal  place;                        /* of the law */
  PetscReal  stiffness, resistance;        /* diagonal of A, normal and the largest tangential one */
  PetscBool  closed;                       /* y_n = upper */
  UnitStatus status;                       /* of the tangents; UNIT_FREE: no force */
  PetscReal  direction[FRICTION_TANGENTS]; /* of slip, unit */
  PetscBool  ended;                        /* the step ended where slip does: it sticks next */
  PetscReal  turning;                      /* resistance to turning: force over slip, across that direction */
} FrictionUnit;

/* Units with the values and forces of their unknowns: all units on one rank, or each rank's own units. */
typedef struct {
  MPI_Comm      comm;     /* of the ranks that share them */
  PetscInt      n, num;   /* unknowns; units */
  FrictionUnit *unit;     /* [num] */
  PetscReal    *y, *r;    /* [n] */
  PetscReal     least;    /* residual so far */
  PetscReal     fewest;   /* decisions changed by a step so far */
  PetscInt      waiting;  /* steps since the last one that descended */
  PetscInt      stalled;  /* of these, steps in a row that change no fewer decisions */
  PetscReal     roundoff; /* of a value, in units of the largest */
} FrictionUnits;

/* The reduced problem, on the first rank. */
typedef struct {
  FrictionUnits *units; /* borrowed */
  PetscScalar   *S;     /* borrowed [n][n] */
  PetscReal     *g;     /* [n] */
  PetscInt      *place; /* of an unknown among the free ones, -1 where it is fixed [n] */
  PetscInt       num_free;
  PetscScalar   *M;     /* the system of the free unknowns, then its factors [n][n] */
  PetscBLASInt  *pivot; /* [n] */
  PetscScalar   *x;     /* [n] */
} FrictionProblem;

/* Limit of |r_t|. */
static inline PetscReal FrictionUnitLimit(const FrictionUnit *unit, PetscReal pressing)
{
  return unit->bound + unit->coefficient * PetscMax(pressing, 0);
}

/* The units of this rank; positions count from its first unknown of the set. Values are not set. Not
   collective. [out] units - to be destroyed by FrictionUnitsDestroy() */
PetscErrorCode FrictionUnitsCreate(const ActiveSet *set, const FrictionLaw *law, FrictionUnits *units);
/* The units of all ranks, on the first one. Collective. */
PetscErrorCode FrictionUnitsGather(const ActiveSet *set, const FrictionLaw *law, FrictionUnits *units);
PetscErrorCode FrictionUnitsDestroy(FrictionUnits *units);
/* Decides from y and r what every unit does. Collective.
   [out] changed - units that do something else than before */
PetscErrorCode FrictionUnitsDecide(FrictionUnits *units, PetscInt *changed);
/* Counts the units that would do something else, and changes none. Collective. */
PetscErrorCode FrictionUnitsCompare(const FrictionUnits *units, PetscInt *changed);
/* Forgets the decisions. The next ones follow from values and forces alone. Not collective. */
void FrictionUnitsForget(FrictionUnits *units);
/* Initial decisions from a given set. Units of the set are closed. They stick if their tangents are in the
   set, too, and slip in their direction of motion otherwise. Not collective.
   [in] given - 1 in the set, else 0 [n] */
void FrictionUnitsBegin(FrictionUnits *units, const PetscReal given[]);
/* Sets the unknowns that the decisions fix: y_n = upper of closed units, s = 0 of sticking units.
   Not collective. */
void FrictionUnitsPrescribe(FrictionUnits *units);
/* Marks the unknowns that the decisions fix. Not collective. [out] fixed - [n] */
void FrictionUnitsMark(const FrictionUnits *units, PetscBool fixed[]);
/* The residual of the law, in the norm of diag(A)^-1, and its reference. Collective.
   [in] rtol - tolerance of their ratio;
   [out] size - of the forces, with what makes roundoff rtol times it */
PetscErrorCode FrictionUnitsResidual(const FrictionUnits *units, PetscReal rtol, PetscReal *residual, PetscReal *size);
/* Counts units. Collective. [out] report - slipping and sticking; [out] closed */
PetscErrorCode FrictionUnitsCount(const FrictionUnits *units, FrictionReport *report, PetscInt *closed);

/* y^, the proximal step of the decisions: onto bounds, s = 0 of sticking units, along the slip of others (eq.
   16.4). Not collective. [out] to - [n] */
void FrictionUnitsProject(const FrictionUnits *units, PetscReal to[]);
/* The part alpha of a step that minimizes the energy with the limits of the end of the step. alpha is 1
   unless slip reverses during the step, above 1 where slip grows in space, and negative if the energy rises.
   Collective. [in] from - y at the
   begin of the step; units have y and r of its end [n]; [in] slope - of the energy without friction, at both
   ends; [out] energy - change of the energy by that part, if alpha is not 1 */
PetscErrorCode FrictionUnitsSearch(FrictionUnits *units, const PetscReal from[], const PetscReal slope[2],
                                   PetscReal *alpha, PetscReal *energy);
/* The end of the step, with no slip where it turned back. Collective. [in] from - as above; [out] to - y [n];
   [out] work - change of sum G |s| */
PetscErrorCode FrictionUnitsClip(const FrictionUnits *units, const PetscReal from[], PetscReal to[], PetscReal *work);
/* Slipping units whose slip ended in the step stick next. Collective. [in] from - as above;
   [out] all - whether it ended at all of them */
PetscErrorCode FrictionUnitsEnd(FrictionUnits *units, const PetscReal from[], PetscBool *all);

/* The last iterates of the fixed point iteration, for Anderson's acceleration. */
enum { ANDERSON_DEPTH = 5 };
typedef struct {
  PetscInt   num, count; /* units; iterates so far */
  PetscReal *values;     /* g and f of each kept iterate [ANDERSON_DEPTH + 1][2][num] */
} FrictionAnderson;

/* Not collective.
   [in] num - of units of this rank; [out] anderson - to be destroyed by FrictionAndersonDestroy() */
PetscErrorCode FrictionAndersonCreate(PetscInt num, FrictionAnderson *anderson);
PetscErrorCode FrictionAndersonDestroy(FrictionAnderson *anderson);
/* The next iterate. Collective. [in] x - the iterate [num]; [in,out] g - its image, the next iterate [num] */
PetscErrorCode FrictionAndersonApply(MPI_Comm comm, FrictionAnderson *anderson, const PetscReal x[], PetscReal g[]);

/* Limits of Tresca's problems instead of those that follow the pressure. Collective. [out] mu, given - the
   coefficients and bounds, owned by the caller [num] */
PetscErrorCode FrictionUnitsBeginFixedPoint(FrictionUnits *units, PetscReal **mu, PetscReal **given);
/* Sets the limit of every unit from its present force. Collective.
   [in,out] anderson - accelerates, NULL for not; [out] settled - whether limits no longer change */
PetscErrorCode FrictionUnitsFreeze(FrictionUnits *units, const PetscReal mu[], const PetscReal given[],
                                   FrictionAnderson *anderson, PetscBool *settled);

/* Memory for the units of the first rank; of no others. Not collective.
   [in] units - borrowed; [in] S - borrowed */
PetscErrorCode FrictionProblemCreate(FrictionUnits *units, PetscScalar S[], FrictionProblem *problem);
PetscErrorCode FrictionProblemDestroy(FrictionProblem *problem);
/* r = g - S y. First rank, as all below. */
PetscErrorCode FrictionProblemSetForces(FrictionProblem *problem);
/* g += S y. */
PetscErrorCode FrictionProblemAddProduct(FrictionProblem *problem);
/* Whether the state without contact satisfies the law, too. Without bounds of friction alone. Replaces the
   factors. [out] opens */
PetscErrorCode FrictionProblemOpens(FrictionProblem *problem, PetscBool *opens);
/* Sweeps over the units, unless the last steps did not descend. Each unit satisfies its law, with the others
   as they are. */
PetscErrorCode FrictionProblemSweep(FrictionProblem *problem);
/* Solves a problem in a plane by complementary pivoting, with the decisions of the solution. [in] last -
   whether other ways were tried: then for larger problems; [out] done - whether that was possible: no
   solution is found of problems in space, or of very large ones */
PetscErrorCode FrictionProblemPivot(FrictionProblem *problem, PetscBool last, PetscBool *done);
/* One Newton step: y and r of the decisions. */
PetscErrorCode FrictionSystemSolve(FrictionProblem *problem);
/* Factors the system of the decisions with given limits, for FrictionSystemGrow(). */
PetscErrorCode FrictionSystemFactorGiven(FrictionProblem *problem);
/* w = coefficient d r_n / d G v at the units that slip. [in] v - [num]; [out] w - [num] */
PetscErrorCode FrictionSystemGrow(FrictionProblem *problem, const PetscReal v[], PetscReal w[]);

/* Result of a Newton step, the same on all ranks. */
typedef struct {
  PetscReal residual, size; /* of the law, and of other unknowns unless these are eliminated; its reference */
  PetscInt  changed, closed, iterations;
  PetscBool shortened; /* the step was shortened, or made longer */
  PetscBool turned;    /* where all slip turned back */
  PetscBool done;      /* the law holds */
} FrictionStep;

/* A way to make Newton steps. All functions are collective. */
typedef struct _n_FrictionMethod *FrictionMethod;
struct _n_FrictionMethod {
  PDAS         *pdas;
  ActiveSolver  solver;  /* borrowed */
  FrictionUnits units;   /* all on the first rank, or of each rank its own */
  PetscReal     rtol;    /* residual that may be left, if it is more than that of a solution */
  PetscBool     plain;   /* decisions follow from the last step alone: no sweeps or proximal steps before them */
  PetscBool     grows;   /* a smaller coefficient was solved: never goes on from elsewhere */
  PetscBool     decided; /* the next step takes the decisions as they are */
  void         *data;
  /* Forgets the steps before; NULL where there is nothing to forget. */
  PetscErrorCode (*restart)(FrictionMethod);
  PetscErrorCode (*step)(FrictionMethod, FrictionStep *step);
  /* Solves by complementary pivoting, if that is possible; NULL for never.
     [in] last - of FrictionProblemPivot() */
  PetscErrorCode (*pivot)(FrictionMethod, PetscBool last, PetscBool *done);
  /* All unknowns. [out] y */
  PetscErrorCode (*get)(FrictionMethod, Vec y);
  PetscErrorCode (*set)(FrictionMethod, Vec y);
  /* [out] y - all unknowns; pdas->friction_report; pdas->set.active: closed and sticking unknowns */
  PetscErrorCode (*finish)(FrictionMethod, Vec y);
  PetscErrorCode (*destroy)(FrictionMethod);
  /* Whether the state without contact satisfies the law, too. Without bounds of friction alone.
     [out] opens */
  PetscErrorCode (*opens)(FrictionMethod, PetscBool *opens);
};

/* Resets the history of steps, for other limits. Collective. */
PetscErrorCode FrictionIterationRestart(FrictionMethod method);
/* One Newton step, recorded in method->pdas. Collective. */
PetscErrorCode FrictionIterationStep(SNES snes, FrictionMethod method, FrictionStep *step);
/* Newton steps until the law holds; where they stall the iteration goes on from elsewhere, once. Collective.
   [in] start - initial guess; [in] stops - gives up where steps stall then */
PetscErrorCode FrictionIterationNewton(SNES snes, FrictionMethod method, Vec start, PetscBool stops);
/* Newton's method with smaller coefficients that grow. Collective.
   [in] largest - coefficient, above 1; [in] start - initial guess */
PetscErrorCode FrictionGrow(SNES snes, FrictionMethod method, PetscReal largest, Vec start);
/* Sets values and decisions to those of the first step after the solution without friction, if this descends.
   Collective. [in] start - initial guess; [in] residual - of the last step */
PetscErrorCode FrictionRelease(SNES snes, FrictionMethod method, Vec start, PetscReal residual);

/* Whether all gaps are open. Collective. [in] y - values [n]; [out] open */
PetscErrorCode FrictionUnitsAreOpen(const FrictionUnits *units, const PetscReal y[], PetscBool *open);
/* Looks for a solution beside that of the method, of bodies that supports hold. Where a coarser mesh gave the
   initial states, it has looked. Collective. [out] found */
PetscErrorCode FrictionFindOther(SNES snes, FrictionMethod method, PetscBool *found);

/* w = M v at the units of this rank [num]; collective. */
typedef PetscErrorCode (*FrictionMap)(FrictionMethod, const PetscReal v[], PetscReal w[]);
/* rho = max |eigenvalue of M|, by Arnoldi's method. Collective.
   [in] correct - error of the last image M v, NULL where it has none; [in] part - of the error at which rho
   has settled; 0: takes all steps; [in] most - gives up above it;
   [out] report - rho, its error, and what eigenvalues tell */
PetscErrorCode FrictionSpectralRadius(FrictionMethod method, FrictionMap map, FrictionMap correct, PetscReal part,
                                      PetscReal most, FrictionReport *report);

/* How much friction that becomes less at some nodes adds to friction at others (eq. 16.8d): dense matrices of
   twice the memory of the reduced problem. Not collective: on its first rank. [in,out] report - coupling and
   turning, left as they are where there is no bound */
PetscErrorCode FrictionCoupling(const FrictionProblem *problem, FrictionReport *report);

/* Steps on the Schur complement of the unknowns with bounds and tangents, of a SchurSolver. Collective. [in]
   y - initial guess */
PetscErrorCode FrictionReducedCreate(FrictionMethod method, Vec y);
/* Steps at full size by GMRES, preconditioned by the multigrid of a FullSolver. Collective.
   [in] y - initial guess */
PetscErrorCode FrictionKrylovCreate(FrictionMethod method, Vec y);

/* Solves contact with friction: sets pdas->converged or pdas->failure, and the results of PDASGetFriction().
   Collective. [in,out] y - initial guess, solution */
PetscErrorCode FrictionIterate(SNES snes, PDAS *pdas, ActiveSolver solver, Vec y);

#endif
