/* sideerrors.c -- what is not known of a file's curved sides, as an error of pressures.

   The curve between two nodes with the errors e_0 and e_1 of its slopes there is off by
   h t (1 - t) (e_0 (1 - t) - e_1 t). In the mean square, over facets whose errors do not depend on each
   other, its slope is off by (4/15)^(1/2) e, and its place by (2/105)^(1/2) h e. A half space answers a wave
   of any length with a pressure of its slope times half of E*. */
#include "result/sideerrors.h"
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/compliance.h"
#include "result/largest.h"
#include "result/pairsum.h"

enum { F = ELEMENT_MAX_FACET_NODES, FIELDS = LEVEL_NORMAL_ERRORS };

/* Squares of what a cubic of slopes e is off by: its slope over e, its place over h e. */
static const PetscReal SLOPE_SQUARED = 4. / 15, PLACE_SQUARED = 2. / 105;
/* Pressures below this part of the largest are roundoff, or that of the solver. */
static const PetscReal LEAST_PRESSURE = 1e-6;

/* Integrals over the contact. */
enum { SUM_AREA, SUM_NORMAL, SUM_PRESSURE, SUM_FORCE, SUM_POTENTIAL, SUMS };

typedef struct {
  const Level       *level;
  PairPoints         points;
  Compliance         compliance;
  const PetscScalar *errors, *traction, *normal; /* local, at nodes of the nonmortar side */
  PetscReal         *errors_m;                   /* of PairPointsFetch() */
  PetscReal          least;                      /* pressure that counts */
  PetscReal          sums[SUMS];
  Largest            largest;
} Touch;

/* Squares of the errors of the normals of both sides at a point, and of these times the sizes of facets.
   [in] type, values - of one side, [vertices][FIELDS]; [in,out] squares - [FIELDS] */
static void TouchAddSquares_Private(ElementType type, const PetscReal xi[], const PetscReal values[],
                                    PetscReal squares[])
{
  PetscReal phi[ELEMENT_MAX_NODES];

  ElementShape(ElementLinear(type), xi, phi, NULL);
  for (PetscInt k = 0; k < FIELDS; k++) {
    PetscReal at = 0;

    for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(type)); i++) at += phi[i] * values[i * FIELDS + k];
    squares[k] += at * at;
  }
}

/* E* = 1 / (1/E' of one side + 1/E' of the other). */
static PetscErrorCode TouchGetModulus_Private(Touch *touch, const PairPoint *point, const PetscReal x[],
                                              const PetscReal n[], PetscReal *modulus)
{
  const PairPoints points = touch->points;
  PetscReal        E[2];

  PetscFunctionBeginUser;
  PetscCall(ComplianceModulus(&touch->compliance, touch->level->cell_material[points->facets.cell[point->facet]], x, n,
                              &E[0]));
  *modulus = E[0];
  if (point->mortar < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ComplianceModulus(&touch->compliance, points->material[point->mortar], x, n, &E[1]));
  *modulus = 1 / (1 / E[0] + 1 / E[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TouchAddPoint_Private(Touch *touch, const PairPoint *point)
{
  const Level      *level  = touch->level;
  const Facets     *facets = &touch->points->facets;
  const ElementType type   = facets->type[point->facet];
  const PetscInt    dim = level->dim, *nodes     = &facets->nodes[point->facet * F];
  PetscReal         phi[ELEMENT_MAX_NODES], x[3] = {0}, n[3] = {0}, t[3] = {0}, own[F * FIELDS], squares[FIELDS] = {0};
  PetscReal         pressure, modulus = 0, error;
  const PetscReal   weight = point->weight * level->scene->thickness;

  PetscFunctionBeginUser;
  ElementShape(type, point->xi, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    for (PetscInt k = 0; k < dim; k++) {
      x[k] += phi[i] * level->coords[nodes[i] * dim + k];
      n[k] += phi[i] * PetscRealPart(touch->normal[nodes[i] * dim + k]);
      t[k] += phi[i] * PetscRealPart(touch->traction[nodes[i] * dim + k]);
    }
    for (PetscInt k = 0; k < FIELDS; k++) own[i * FIELDS + k] = PetscRealPart(touch->errors[nodes[i] * FIELDS + k]);
  }
  pressure = VectorDot(dim, n, t);
  if (!(pressure > touch->least)) PetscFunctionReturn(PETSC_SUCCESS);
  TouchAddSquares_Private(type, point->xi, own, squares);
  if (point->mortar >= 0)
    TouchAddSquares_Private(touch->points->type[point->mortar], point->eta,
                            &touch->errors_m[point->mortar * F * FIELDS], squares);
  PetscCall(TouchGetModulus_Private(touch, point, x, n, &modulus));
  error = modulus / 2 * PetscSqrtReal(SLOPE_SQUARED * squares[0]);
  LargestTake(&touch->largest, error, dim, x, 0);
  touch->sums[SUM_AREA] += weight;
  touch->sums[SUM_NORMAL] += weight * squares[0];
  touch->sums[SUM_PRESSURE] += weight * error * error;
  touch->sums[SUM_FORCE] += weight * pressure;
  if (squares[0] > 0) // of each facet of the file one error, which has the size h
    touch->sums[SUM_POTENTIAL] += weight * PetscSqr(pressure) * PLACE_SQUARED * squares[1] *
                                  PetscPowReal(squares[1] / squares[0], (PetscReal)(dim - 1) / 2);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds all points of this rank. Collective. */
static PetscErrorCode TouchAddPoints_Private(Touch *touch, Vec traction)
{
  Vec                 v[]     = {touch->level->normal_errors, traction, touch->points->normals};
  const PetscScalar **array[] = {&touch->errors, &touch->traction, &touch->normal};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; i++) {
    PetscCall(GhostedGetArrayRead(v[i], array[i]));
  }
  for (PetscInt q = 0; q < touch->points->num; q++) PetscCall(TouchAddPoint_Private(touch, &touch->points->point[q]));
  for (PetscInt i = 0; i < 3; i++) {
    PetscCall(GhostedRestoreArrayRead(v[i], array[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of pair p. Collective. [out] errors - all 0 where there are none */
static PetscErrorCode SideErrorsCompute_Private(Fields fields, PetscInt p, SideErrors *errors)
{
  Level  *level = fields->vi->level;
  Touch   touch = {.level = level, .points = fields->vi->pairs[p]->points};
  Vec     traction;
  PairSum sum;

  PetscFunctionBeginUser;
  *errors = (SideErrors){.normal = 0};
  if (!touch.points || fields->vi->pairs[p]->spec->type == PAIR_TIED) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PairSumCompute(fields, p, &sum));
  touch.least = LEAST_PRESSURE * PetscMax(0, sum.max_pressure);
  PetscCall(ComplianceCreate(level->scene, &touch.compliance));
  PetscCall(PairTractionCreate(fields, p, fields->row_status, &traction));
  PetscCall(PairPointsFetch(touch.points, level->normal_errors, FIELDS, &touch.errors_m));
  PetscCall(TouchAddPoints_Private(&touch, traction));
  PetscCall(PetscFree(touch.errors_m));
  PetscCall(VecDestroy(&traction));
  PetscCall(ComplianceDestroy(&touch.compliance));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, touch.sums, SUMS, MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(LargestReduce(level->comm, level->dim, 1, &touch.largest));
  if (!(touch.sums[SUM_AREA] > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  *errors = (SideErrors){.normal    = PetscSqrtReal(touch.sums[SUM_NORMAL] / touch.sums[SUM_AREA]),
                         .pressure  = PetscSqrtReal(touch.sums[SUM_PRESSURE] / touch.sums[SUM_AREA]),
                         .mean      = touch.sums[SUM_FORCE] / touch.sums[SUM_AREA],
                         .largest   = touch.largest.value,
                         .potential = PetscSqrtReal(touch.sums[SUM_POTENTIAL])};
  PetscCall(PetscArraycpy(errors->at, touch.largest.at, 3));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideErrorsGet(Fields fields, PetscInt p, SideErrors *errors)
{
  const PetscInt num = fields->vi->scene->num_pairs;

  PetscFunctionBeginUser;
  *errors = (SideErrors){.normal = 0};
  if (!fields->vi->level->normal_errors) PetscFunctionReturn(PETSC_SUCCESS);
  if (!fields->side_errors) {
    PetscCall(PetscMalloc1(num, &fields->side_errors));
    for (PetscInt i = 0; i < num; i++) PetscCall(SideErrorsCompute_Private(fields, i, &fields->side_errors[i]));
  }
  *errors = fields->side_errors[p];
  PetscFunctionReturn(PETSC_SUCCESS);
}
