/* steadysliding.c -- bodies that slide on and on: whether that shows that there is no equilibrium.

   Statics refuse nothing where bodies are pressed together whatever the loads are, as in a press fit: the
   cones of friction hold any force then. What friction can take follows from the pressures, and these come
   from a solve. Where it is too small, the steps of the proximal point iteration repeat a rigid motion, and
   pressures no longer change. Let q be that motion, p these pressures, and s(q) the slip. If q closes no gap,
   and if

       phi.q  >  sum p n.q + sum (bound + mu p) |s(q)|,

   the loads do more work on it than contact can take. The state goes on for ever, and friction is already at
   its limit in it (eq. 16.8a).

   Another state may have larger pressures, since friction changes them. The coupling bounds that: so much of
   what friction has less at some nodes it may have more at others. Nodes that do not slip could change
   theirs at no cost, so all nodes must slip. In space friction may also turn (eq. 16.8e). */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "problem/frictionlaw.h"
#include "rigid/rigidimpl.h"
#include <math.h>

/* Part of a step that may be no rigid motion, as a part of the step: roundoff of far ways. */
static const PetscReal NOT_RIGID = 1e-3;
/* Gaps that close by less than this part of the slip stay as they are. */
static const PetscReal CLOSES_NOT = 1e-6;
/* Least difference of both works, as a part of what contact takes: the proximal term presses, too. */
static const PetscReal SURPLUS_STEADY = 1e-3;
/* Eigenvalues below this part of the largest are roundoff. */
static const PetscReal SINGULAR_MODES = 1e-10;

PetscErrorCode SolvabilityFindModes(Solvability s, const PetscReal products[], PetscReal part[])
{
  const PetscInt m = s->m;
  PetscReal     *gram, *values, *V, largest = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(m * m, &gram, m, &values, m * m, &V));
  for (PetscInt i = 0; i < m; i++) PetscCall(VecMDot(s->modes[i], m, s->modes, &gram[i * m]));
  DenseEigen(m, gram, values, V);
  PetscCall(PetscArrayzero(part, m));
  for (PetscInt i = 0; i < m; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < m; i++) {
    PetscReal along = 0;

    for (PetscInt k = 0; k < m; k++) along += V[k * m + i] * products[k];
    for (PetscInt k = 0; k < m && values[i] > SINGULAR_MODES * largest; k++)
      part[k] += V[k * m + i] * along / values[i];
  }
  PetscCall(PetscFree3(gram, values, V));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rigid motion of a step. Collective. [out] q - [m]; [out] rigid - whether the step is nothing else */
static PetscErrorCode SteadySlidingSetMotion_Private(Solvability s, Vec step, PetscReal q[], PetscBool *rigid)
{
  PetscReal *products, whole, rest;
  Vec        left;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->m, &products));
  PetscCall(VecMDot(step, s->m, s->modes, products));
  PetscCall(SolvabilityFindModes(s, products, q));
  PetscCall(VecDuplicate(step, &left));
  PetscCall(VecCopy(step, left));
  for (PetscInt k = 0; k < s->m; k++) PetscCall(VecAXPY(left, -q[k], s->modes[k]));
  PetscCall(VecNorm(step, NORM_2, &whole));
  PetscCall(VecNorm(left, NORM_2, &rest));
  *rigid = (PetscBool)(whole > 0 && rest <= NOT_RIGID * whole);
  PetscCall(VecDestroy(&left));
  PetscCall(PetscFree(products));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a motion does to contacts. */
typedef struct {
  PetscReal work;    /* that they can take */
  PetscReal fastest; /* slip of nodes with friction */
  PetscReal closing; /* the fastest one */
  PetscReal moving;  /* the fastest closing or opening */
  PetscBool coupled; /* some node has a coefficient */
} SteadySliding;

/* Collective. [in] r - of contact, dimensionless */
static PetscErrorCode SteadySlidingMeasure_Private(VI vi, const struct _n_Solvability *s, const PetscScalar r[],
                                                   const PetscReal q[], SteadySliding *sliding)
{
  const FrictionLaw *law   = vi->friction;
  const PetscInt     first = vi->level->dim * vi->level->node_begin, m = s->m;
  SteadySliding      own = {.work = 0};

  PetscFunctionBeginUser;
  for (PetscInt row = 0; row < vi->num_rows; row++) {
    const PetscInt  a       = s->tangent[row] ? -1 : FrictionLawFind(law, vi->row_dof[row]);
    const PetscInt  num     = a < 0 ? 0 : law->tangent[FRICTION_TANGENTS * a + 1] < 0 ? 1 : 2;
    const PetscReal pressed = PetscMax(PetscRealPart(r[vi->row_dof[row] - first]), 0);
    const PetscReal closing = VectorDot(m, &s->nodal.rows[row * m], q);
    PetscReal       slip[FRICTION_TANGENTS], size;

    if (s->tangent[row]) continue;
    own.closing = PetscMax(own.closing, s->nodal.equality[row] || pressed > 0 ? PetscAbsReal(closing) : closing);
    own.moving  = PetscMax(own.moving, PetscAbsReal(closing));
    if (!s->nodal.equality[row]) own.work += pressed * closing;
    if (!num) continue;
    for (PetscInt t = 0; t < num; t++) slip[t] = VectorDot(m, &s->slide[(row + 1 + t) * m], q);
    size        = VectorNorm(num, slip);
    own.fastest = PetscMax(own.fastest, size);
    own.coupled = (PetscBool)(own.coupled || law->coefficient[a] > 0);
    own.work += (law->bound[a] + law->coefficient[a] * pressed) * size;
  }
  own.work *= vi->stiffness * vi->length;
  PetscCallMPI(MPI_Allreduce(&own.work, &sliding->work, 1, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(&own.fastest, &sliding->fastest, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(&own.closing, &sliding->closing, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(&own.moving, &sliding->moving, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(&own.coupled, &sliding->coupled, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The part by which the loads must do more work than contact takes, so that no other state takes more (eq.
   16.8e). Returns whether there is one. */
static PetscBool SteadySlidingSurplus_Private(const SteadySliding *sliding, const FrictionReport *friction,
                                              PetscReal *surplus)
{
  const PetscReal left = 1 - friction->coupling; // of what friction has less
  PetscReal       gain;                          // of friction that turns, as a part of the other state's

  *surplus = SURPLUS_STEADY;
  if (!sliding->coupled) return PETSC_TRUE;
  if (sliding->moving > CLOSES_NOT * sliding->fastest || !(left > 0)) return PETSC_FALSE;
  if (!(PETSC_SQRT2 * friction->turning < left)) return PETSC_FALSE;
  gain = left / 2 * (1 - PetscSqrtReal(1 - 2 * PetscSqr(friction->turning / left)));
  *surplus += gain / (1 - gain);
  return PETSC_TRUE;
}

/* Whether the loads do more work on a motion than contact can take, and it closes no gap. Collective. */
static PetscErrorCode SteadySlidingTest_Private(VI vi, Solvability s, const FrictionReport *friction, Vec forces,
                                                const PetscReal q[], PetscBool *goes)
{
  const PetscReal    work = VectorDot(s->m, s->work, q);
  const PetscScalar *r;
  PetscReal          surplus;
  SteadySliding      sliding;
  PetscBool          bounded;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(forces, &r));
  PetscCall(SteadySlidingMeasure_Private(vi, s, r, q, &sliding));
  PetscCall(VecRestoreArrayRead(forces, &r));
  bounded = SteadySlidingSurplus_Private(&sliding, friction, &surplus);
  PetscCall(PetscInfo(forces, "bodies slide: the loads do %g of work, contact takes %g; slip to %g, closing %g\n",
                      (double)work, (double)sliding.work, (double)sliding.fastest, (double)sliding.closing));
  PetscCall(PetscInfo(forces, "coupling %g, turning %g: a surplus of %g is needed\n", (double)friction->coupling,
                      (double)friction->turning, bounded ? (double)surplus : INFINITY));
  *goes =
      (PetscBool)(bounded && sliding.closing <= CLOSES_NOT * sliding.fastest && work > (1 + surplus) * sliding.work);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityTestSliding(VI vi, Solvability s, const FrictionReport *friction, Vec forces, Vec step)
{
  PetscReal *q, *straight;
  PetscBool *take, goes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(s->m, &q, s->m, &straight, s->m, &take));
  PetscCall(SteadySlidingSetMotion_Private(s, step, q, &goes));
  if (goes) PetscCall(SteadySlidingTest_Private(vi, s, friction, forces, q, &goes));
  if (goes) { // without rotations if possible
    PetscBool simple;

    SolvabilityMarkStraight(vi, take);
    for (PetscInt k = 0; k < s->m; k++) straight[k] = take[k] ? q[k] : 0;
    PetscCall(SteadySlidingTest_Private(vi, s, friction, forces, straight, &simple));
    PetscCall(SceneMotionDestroy(&s->motion));
    PetscCall(SceneMotionCreate(vi, s, simple ? straight : q, &s->motion));
    s->status = SOLVABLE_NOT;
    s->slides = PETSC_TRUE;
  }
  PetscCall(PetscFree3(q, straight, take));
  PetscFunctionReturn(PETSC_SUCCESS);
}
