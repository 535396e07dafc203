/* loadrefine.c -- loads given by formulas with jumps and kinks inside facets and cells.

   A second rule, whose points reach the vertices, tells where a formula is not smooth. Only these elements
   are integrated anew, by nested integrals that are cut at jumps and kinks (cubature.h). A curve may cross a
   facet between the points of both rules. Then it may cross the neighbours, too: finer rules check these. */
#include "base/compat.h"
#include "base/warning.h"
#include "level/ghosted.h"
#include "problem/loadterm.h"

enum {
  MAX_DIM       = 3,
  COARSE_POINTS = 3,        /* points along each coordinate of a rule whose error is compared */
  FINER_POINTS  = 5,        /* the same of the third rule, after the two that are compared */
  REGULAR_WORK  = 20000000, /* evaluations that all elements of a term may take together */
  SWITCHED_WORK =
      60000000, /* the same where the place of a jump is known: most of these evaluate a part of the formula alone */
  LARGEST_WORK = 3000000, /* of one of them */
  PLENTY       = 8        /* largest budget in equal shares, where the place of a jump is known */
};

/* Least budget of an element: of lines, of facets in space or cells in the plane, and of cells in space. On
   facets and in the plane few elements, where a curve touches a line of points, take more than 10000. */
static const PetscInt SMALLEST_WORK[MAX_DIM + 1] = {0, 1000000, 1000000, 20000};

/* Pieces along each coordinate of lines, facets in space or cells in the plane, and cells in space.
   ROUGH_PIECES: the initial number where two rules differ, and for the neighbours. Narrower features are not
   detected. */
static const PetscInt PIECES[MAX_DIM + 1] = {0, 8, 2, 1}, ROUGH_PIECES[MAX_DIM + 1] = {0, 8, 8, 2},
                                       NEIGHBOUR_PIECES[MAX_DIM + 1] = {0, 8, 8, 4};

/* Permitted difference of two rules, relative to the load on an element or to its share of the total. A tenth
   of the accuracy that is promised for totals. */
static const PetscReal ACCURACY = 1e-11, PROMISED = 1e-10;
/* From rule to rule, errors of smooth functions fall at least so much. */
static const PetscReal FALLING = 0.1;
/* Least scale of a component, relative to the largest one of the scene: a smaller component may be the
   roundoff of sin(pi). */
static const PetscReal NEGLIGIBLE = 1e-5;
/* Elements that would exceed their budget are integrated to tolerances coarser by COARSEST, then finer by
   FINER each. */
static const PetscReal COARSEST = 1e8, FINER = 1e-2;
/* Distance of points from vertices in roundings of coordinates, and its limits. */
static const PetscReal ROUNDINGS = 32., LEAST_INSET = 1e-13, LARGEST_INSET = 1e-6;

/* Scales of a term, the same on all ranks. */
typedef struct {
  PetscReal scale[MAX_DIM]; /* of each component's total */
  PetscReal num;            /* elements */
} Measure;

static PetscErrorCode LoadRefineIntegrand_Private(void *ctx, const PetscReal xi[], PetscReal value[])
{
  PetscFunctionBeginUser;
  PetscCall(LoadElementValue((const LoadElement *)ctx, xi, 1., value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode LoadRefineSwitch_Private(void *ctx, PetscInt i, const PetscReal xi[], PetscReal *value)
{
  const LoadElement *element = ctx;
  const PetscInt     dim     = element->term->dim;
  PetscReal          phi[ELEMENT_MAX_NODES], x[MAX_DIM] = {0.};

  PetscFunctionBeginUser;
  ElementShape(element->type, xi, phi, NULL);
  for (PetscInt n = 0; n < element->num_nodes; n++) {
    for (PetscInt k = 0; k < dim; k++) x[k] += phi[n] * element->X[n * dim + k];
  }
  PetscCall(ExpressionComponent(element->term->switches, i, dim, x, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Distance of points from vertices: at a vertex on a jump, roundoff of its coordinates would decide on the
   side. */
static PetscReal LoadRefineInsetPoint_Private(const LoadElement *element)
{
  const PetscInt dim = element->term->dim, num = ElementNumNodes(ElementLinear(element->type));
  PetscReal      largest = 0., shortest = PETSC_MAX_REAL;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < dim; k++) largest = PetscMax(largest, PetscAbsReal(element->X[i * dim + k]));
    for (PetscInt j = 0; j < i; j++) {
      PetscReal distance = 0.;
      for (PetscInt k = 0; k < dim; k++)
        distance = PetscMax(distance, PetscAbsReal(element->X[i * dim + k] - element->X[j * dim + k]));
      shortest = PetscMin(shortest, distance);
    }
  }
  return PetscMin(PetscMax(ROUNDINGS * PETSC_MACHINE_EPSILON * largest / shortest, LEAST_INSET), LARGEST_INSET);
}

/* An element's cubature, without a tolerance. */
static Cubature LoadRefineGetCubature_Private(const LoadElement *element, PetscInt pieces)
{
  return (Cubature){.type         = element->type,
                    .size         = element->num_nodes * element->term->dim,
                    .integrand    = LoadRefineIntegrand_Private,
                    .switches     = LoadRefineSwitch_Private,
                    .num_switches = element->term->switches ? ExpressionSize(element->term->switches) : 0,
                    .ctx          = (void *)element,
                    .inset        = LoadRefineInsetPoint_Private(element),
                    .pieces       = pieces};
}

/* Largest difference of two loads in each component. [in] n - [num_nodes][dim]; [out] miss - [dim] */
static void LoadRefineGetDifference_Private(PetscInt n, PetscInt dim, const PetscReal a[], const PetscReal b[],
                                            PetscReal miss[])
{
  for (PetscInt k = 0; k < dim; k++) miss[k] = 0.;
  for (PetscInt i = 0; i < n; i++) miss[i % dim] = PetscMax(miss[i % dim], PetscAbsReal(a[i] - b[i]));
}

/* The load on an element in a component; on all of them of a pressure. */
static PetscReal LoadRefineGetOwn_Private(const LoadTerm *term, PetscInt e, PetscInt component)
{
  PetscReal sum = 0.;

  if (!term->pressure) return term->own[e * term->dim + component];
  for (PetscInt k = 0; k < term->dim; k++) sum += term->own[e * term->dim + k];
  return sum;
}

/* Permitted errors of an element. [in] measure - or NULL: then by the element alone;
   [out] tolerance - [dim] */
static void LoadRefineGetTolerance_Private(const LoadTerm *term, const Measure *measure, PetscInt e,
                                           PetscReal tolerance[])
{
  PetscReal largest = 0.;

  for (PetscInt k = 0; k < term->dim; k++) largest = PetscMax(largest, LoadRefineGetOwn_Private(term, e, k));
  for (PetscInt k = 0; k < term->dim; k++)
    tolerance[k] = ACCURACY * PetscMax(LoadRefineGetOwn_Private(term, e, k),
                                       measure ? measure->scale[k] / measure->num : NEGLIGIBLE * largest);
}

/* Whether two rules differ by more than the permitted error of loads. [in] miss - [dim] */
static PetscBool LoadRefineDiffers_Private(const LoadTerm *term, const Measure *measure, PetscInt e,
                                           const PetscReal miss[])
{
  PetscReal tolerance[MAX_DIM];

  LoadRefineGetTolerance_Private(term, measure, e, tolerance);
  for (PetscInt k = 0; k < term->dim; k++)
    if (miss[k] > tolerance[k]) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Whether errors fall in proportion from rule to rule, so that the last one is within the tolerance. Those of
   smooth functions fall faster still.
   [in] first, second - errors of two rules [dim] */
static PetscBool LoadRefineIsWithin_Private(PetscInt dim, const PetscReal tolerance[], const PetscReal first[],
                                            const PetscReal second[])
{
  for (PetscInt k = 0; k < dim; k++) {
    if (second[k] <= tolerance[k]) continue;
    if (!(second[k] <= FALLING * first[k] && PetscSqr(second[k]) <= tolerance[k] * first[k])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Looks for a rule for a smooth function. Errors of 3 points, of Lobatto's 5 and of Gauss's 5 are of order 6,
   8 and 10 in the element's size, those of 3, 5 and 7 points of order 6, 10 and 14. Lobatto's on pieces are
   smaller than those of Gauss's 5 points, and in no such proportion.
   [in] other - the integrals by Lobatto's rule; [out] fe - by the one that is found; [out] points - of it, 0
   for none */
static PetscErrorCode LoadRefineFindRule_Private(Cubature *cubature, PetscInt dim, const PetscReal tolerance[],
                                                 const PetscReal other[], PetscReal fe[], PetscInt *points)
{
  PetscReal coarse[CUBATURE_MAX_SIZE], before[CUBATURE_MAX_SIZE], first[MAX_DIM], second[MAX_DIM];

  PetscFunctionBeginUser;
  PetscCall(CubatureGauss(cubature, COARSE_POINTS, coarse));
  PetscCall(PetscArraycpy(before, other, cubature->size));
  for (*points = FINER_POINTS; *points < CUBATURE_MAX_GAUSS; *points += 2) {
    PetscCall(CubatureGauss(cubature, *points, fe));
    LoadRefineGetDifference_Private(cubature->size, dim, coarse, fe, first);
    LoadRefineGetDifference_Private(cubature->size, dim, before, fe, second);
    if (*points == FINER_POINTS && cubature->pieces > 1) PetscCall(PetscArrayzero(first, dim));
    if (LoadRefineIsWithin_Private(dim, tolerance, first, second)) PetscFunctionReturn(PETSC_SUCCESS);
    PetscCall(PetscArraycpy(before, fe, cubature->size));
  }
  *points = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadElementCheck(const LoadElement *element, PetscInt e, PetscReal fe[])
{
  const LoadTerm *term     = element->term;
  const PetscInt  dim      = term->dim;
  Cubature        cubature = LoadRefineGetCubature_Private(element, PIECES[ElementDim(element->type)]);
  PetscReal      *own = &term->own[e * dim], *miss = &term->miss[e * dim], sums[2][MAX_DIM] = {{0.}};
  PetscReal       other[CUBATURE_MAX_SIZE], finer[CUBATURE_MAX_SIZE], tolerance[MAX_DIM];

  PetscFunctionBeginUser;
  PetscCall(CubatureLobatto(&cubature, other));
  LoadElementSums(element, fe, sums[0]);
  LoadElementSums(element, other, sums[1]);
  for (PetscInt k = 0; k < dim; k++) own[k] = PetscMax(sums[0][k], sums[1][k]);
  LoadRefineGetDifference_Private(cubature.size, dim, fe, other, miss);
  if (!LoadRefineDiffers_Private(term, NULL, e, miss)) PetscFunctionReturn(PETSC_SUCCESS);
  LoadRefineGetTolerance_Private(term, NULL, e, tolerance);
  PetscCall(LoadRefineFindRule_Private(&cubature, dim, tolerance, other, finer, &term->points[e]));
  if (term->points[e]) PetscCall(PetscArraycpy(fe, finer, cubature.size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Totals over all ranks. Components of a pressure have the scale of all of them. [out] measures - [num] */
static PetscErrorCode LoadRefineMeasureTerms_Private(MPI_Comm comm, PetscInt num, const LoadTerm terms[],
                                                     Measure measures[])
{
  enum { COLUMNS = MAX_DIM + 1 };
  PetscReal *sums, largest = 0.;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * COLUMNS, &sums));
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < terms[i].dim; k++) sums[i * COLUMNS + (terms[i].pressure ? 0 : k)] += terms[i].sums[k];
    sums[i * COLUMNS + MAX_DIM] = (PetscReal)terms[i].num;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(num * COLUMNS), MPIU_REAL, MPI_SUM, comm));
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < MAX_DIM; k++) largest = PetscMax(largest, sums[i * COLUMNS + k]);
  }
  if (largest == 0.) largest = 1.; // no load: tolerances are positive nevertheless
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < MAX_DIM; k++)
      measures[i].scale[k] = PetscMax(sums[i * COLUMNS + (terms[i].pressure ? 0 : k)], NEGLIGIBLE * largest);
    measures[i].num = PetscMax(sums[i * COLUMNS + MAX_DIM], 1.);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscReal LoadRefineGetLargest_Private(PetscInt dim, const PetscReal miss[])
{
  PetscReal most = 0.;

  for (PetscInt k = 0; k < dim; k++) most = PetscMax(most, miss[k]);
  return most;
}

/* Whether the errors of rules with ever more points decrease as for smooth functions; those of a jump or a
   kink do not.
   [in] other - the integrals by Lobatto's rule, whose points are elsewhere; [out] finest - the integrals by
   the last rule */
static PetscErrorCode LoadRefineFallsWithin_Private(Cubature *cubature, const LoadTerm *term, const Measure *measure,
                                                    PetscInt e, const PetscReal other[], PetscReal finest[],
                                                    PetscBool *falls)
{
  static const PetscInt points[3] = {3, 5, 7};
  const PetscInt        dim       = term->dim;
  PetscReal             value[CUBATURE_MAX_SIZE], miss[MAX_DIM], apart, before = PETSC_MAX_REAL;

  PetscFunctionBeginUser;
  PetscCall(CubatureGauss(cubature, CUBATURE_MAX_GAUSS, finest));
  LoadRefineGetDifference_Private(cubature->size, dim, other, finest, miss);
  apart  = LoadRefineDiffers_Private(term, measure, e, miss) ? LoadRefineGetLargest_Private(dim, miss) : 0.;
  *falls = PETSC_TRUE;
  for (PetscInt i = 0; i < 3 && *falls; i++) {
    PetscReal most;

    PetscCall(CubatureGauss(cubature, points[i], value));
    LoadRefineGetDifference_Private(cubature->size, dim, value, finest, miss);
    most = LoadRefineGetLargest_Private(dim, miss);
    if (i == 0) *falls = (PetscBool)(apart <= most);               // of lower degree than Lobatto's rule
    if (!LoadRefineDiffers_Private(term, measure, e, miss)) break; // only roundoff is left
    if (i == 2 && term->switches) *falls = PETSC_FALSE;            // bisecting the cell is more accurate
    *falls = (PetscBool)(*falls && most <= FALLING * before);
    before = most;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The integrals over element e by the rule that was taken for it. */
static PetscErrorCode LoadRefineGetTaken_Private(const LoadElement *element, PetscInt e, PetscReal fe[])
{
  Cubature cubature = LoadRefineGetCubature_Private(element, PIECES[ElementDim(element->type)]);

  PetscFunctionBeginUser;
  if (element->term->points[e])
    PetscCall(CubatureGauss(&cubature, element->term->points[e], fe));
  else
    PetscCall(LoadElementIntegrate(element, fe));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes a finer rule for an element where the formula is smooth.
   [in,out] fa - [num_nodes][dim]; [out] smooth */
static PetscErrorCode LoadRefineTakeFiner_Private(LoadTerm *term, const Measure *measure, PetscInt e, PetscScalar fa[],
                                                  PetscBool *smooth)
{
  PetscReal   fe[CUBATURE_MAX_SIZE], other[CUBATURE_MAX_SIZE], finer[CUBATURE_MAX_SIZE], tolerance[MAX_DIM];
  PetscInt    points;
  LoadElement element;
  Cubature    cubature;

  PetscFunctionBeginUser;
  LoadElementSet(term, e, &element);
  cubature = LoadRefineGetCubature_Private(&element, PIECES[ElementDim(element.type)]);
  PetscCall(CubatureLobatto(&cubature, other));
  LoadRefineGetTolerance_Private(term, measure, e, tolerance);
  PetscCall(LoadRefineFindRule_Private(&cubature, term->dim, tolerance, other, finer, &points));
  *smooth = (PetscBool)(points > 0);
  if (!points) {
    points = CUBATURE_MAX_GAUSS;
    PetscCall(LoadRefineFallsWithin_Private(&cubature, term, measure, e, other, finer, smooth));
  }
  if (!*smooth) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LoadRefineGetTaken_Private(&element, e, fe));
  LoadElementAdd(&element, -1., fe, fa);
  LoadElementAdd(&element, 1., finer, fa);
  term->points[e] = points;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds elements where the formula is not smooth. Where it is smooth but the rule for loads is too coarse,
   takes a finer rule.
   [out] pieces - initial number, 0 where nothing is left to do [term->num]; [in,out] fa - [num_nodes][dim] */
static PetscErrorCode LoadRefineFindRough_Private(LoadTerm *term, const Measure *measure, PetscInt pieces[],
                                                  PetscScalar fa[])
{
  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < term->num; e++) {
    const PetscInt dim   = ElementDim(term->type[e]);
    PetscBool      jumps = PETSC_FALSE, smooth = PETSC_TRUE;

    if (term->switches) {
      LoadElement element;
      Cubature    cubature;

      LoadElementSet(term, e, &element);
      cubature = LoadRefineGetCubature_Private(&element, PIECES[dim]);
      PetscCall(CubatureMayJump(&cubature, &jumps));
    }
    if (!jumps && !term->points[e] && LoadRefineDiffers_Private(term, measure, e, &term->miss[e * term->dim]))
      PetscCall(LoadRefineTakeFiner_Private(term, measure, e, fa, &smooth));
    pieces[e] = jumps || !smooth ? ROUGH_PIECES[dim] : 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finer check of elements that share a node with one where two rules differ. Collective.
   [in,out] pieces - [term->num] */
static PetscErrorCode LoadRefineFindNeighbours_Private(const LoadTerm *term, const Measure *measure, PetscInt pieces[])
{
  PetscReal    fe[CUBATURE_MAX_SIZE], other[CUBATURE_MAX_SIZE], miss[MAX_DIM];
  LoadElement  element;
  PetscScalar *mark;
  Vec          nodes;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(term->level, 1, &nodes));
  PetscCall(GhostedGetArray(nodes, &mark));
  for (PetscInt e = 0; e < term->num; e++) {
    for (PetscInt i = 0; pieces[e] && i < ElementNumNodes(term->type[e]); i++) mark[term->nodes[e][i]] = 1.;
  }
  PetscCall(GhostedRestoreArray(nodes, &mark));
  PetscCall(LevelShareVec(nodes, MAX_VALUES));
  PetscCall(GhostedGetArray(nodes, &mark));
  for (PetscInt e = 0; e < term->num; e++) {
    PetscBool near = PETSC_FALSE;
    Cubature  cubature;

    for (PetscInt i = 0; i < ElementNumNodes(term->type[e]); i++)
      near = (PetscBool)(near || PetscRealPart(mark[term->nodes[e][i]]) > 0.);
    if (pieces[e] || !near) continue;
    LoadElementSet(term, e, &element);
    cubature = LoadRefineGetCubature_Private(&element, NEIGHBOUR_PIECES[ElementDim(element.type)]);
    PetscCall(LoadRefineGetTaken_Private(&element, e, fe));
    PetscCall(CubatureLobatto(&cubature, other));
    LoadRefineGetDifference_Private(cubature.size, term->dim, fe, other, miss);
    if (LoadRefineDiffers_Private(term, measure, e, miss)) pieces[e] = cubature.pieces;
  }
  PetscCall(GhostedRestoreArray(nodes, &mark));
  PetscCall(VecDestroy(&nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The integrals over one element within its budget. If the tolerance exceeds the budget, and the place of a
   jump is unknown, tolerances decrease from a coarse one.
   [in] tolerance - [dim]; [in,out] work - budget, then evaluations; [out] fe - [num_nodes][dim]; [out] miss -
   error bound of fe [dim] */
static PetscErrorCode LoadRefineIntegrateRough_Private(const LoadElement *element, PetscInt pieces,
                                                       const PetscReal tolerance[], PetscInt *work, PetscReal fe[],
                                                       PetscReal miss[])
{
  const PetscInt dim = element->term->dim, budget = *work;
  Cubature       cubature = LoadRefineGetCubature_Private(element, pieces);
  PetscReal      scaled[CUBATURE_MAX_SIZE], next[CUBATURE_MAX_SIZE], error;

  PetscFunctionBeginUser;
  cubature.tolerance = scaled;
  cubature.budget    = budget;
  for (PetscInt i = 0; i < cubature.size; i++) scaled[i] = tolerance[i % dim];
  if (element->term->switches)
    PetscCall(CubatureSwitches(&cubature, fe, &error));
  else
    PetscCall(CubatureAdaptive(&cubature, fe, &error));
  for (PetscInt k = 0; k < dim; k++) miss[k] = error * tolerance[k];
  *work = cubature.count;
  if (cubature.count <= budget || element->term->switches) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscReal factor = COARSEST; factor > 1.; factor *= FINER) {
    for (PetscInt i = 0; i < cubature.size; i++) scaled[i] = factor * tolerance[i % dim];
    PetscCall(CubatureAdaptive(&cubature, next, &error));
    if (factor < COARSEST) LoadRefineGetDifference_Private(cubature.size, dim, fe, next, miss);
    if (cubature.count > budget) break; /* the integral before is more accurate */
    PetscCall(PetscArraycpy(fe, next, cubature.size));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The budget of the next element. Where the place of a jump is known few elements need many evaluations: they
   may take up to PLENTY shares. [in] spent - evaluations of all elements before */
static PetscInt LoadRefineBudget_Private(const LoadTerm *term, PetscReal num_rough, PetscReal spent)
{
  const PetscReal least = SMALLEST_WORK[term->on_facets ? term->dim - 1 : term->dim];
  const PetscReal share = (term->switches ? SWITCHED_WORK : REGULAR_WORK) / num_rough;
  const PetscReal more  = term->switches && spent < 0.5 * SWITCHED_WORK ? PLENTY * share : share;

  return (PetscInt)PetscMax(least, PetscMin(LARGEST_WORK, more));
}

/* Errors above the tolerance in a term. */
typedef struct {
  PetscReal miss[MAX_DIM]; /* on all elements */
  PetscReal worst;         /* on one of them, relative to the scale */
  PetscReal at[MAX_DIM];   /* its centre */
} Shortfall;

/* Integrates elements with jumps or kinks anew.
   [in] num_rough - elements on all ranks; [in,out] fa - [num_nodes][dim] */
static PetscErrorCode LoadRefineIntegrate_Private(const LoadTerm *term, const Measure *measure, const PetscInt pieces[],
                                                  PetscReal num_rough, PetscScalar fa[], Shortfall *shortfall)
{
  const PetscInt dim = term->dim;
  PetscReal      fe[CUBATURE_MAX_SIZE], tolerance[MAX_DIM], miss[MAX_DIM], spent = 0.;
  LoadElement    element;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < term->num; e++) {
    PetscReal worst = 0.;
    PetscInt  work  = LoadRefineBudget_Private(term, num_rough, spent);

    if (!pieces[e]) continue;
    LoadElementSet(term, e, &element);
    PetscCall(LoadRefineGetTaken_Private(&element, e, fe));
    LoadElementAdd(&element, -1., fe, fa);
    for (PetscInt k = 0; k < dim; k++)
      tolerance[k] = ACCURACY * PetscMax(LoadRefineGetOwn_Private(term, e, k), 0.5 * measure->scale[k] / num_rough);
    PetscCall(LoadRefineIntegrateRough_Private(&element, pieces[e], tolerance, &work, fe, miss));
    spent += (PetscReal)work;
    LoadElementAdd(&element, 1., fe, fa);
    for (PetscInt k = 0; k < dim; k++) {
      shortfall->miss[k] += miss[k];
      worst = PetscMax(worst, miss[k] / measure->scale[k]);
    }
    if (worst <= shortfall->worst) continue;
    shortfall->worst = worst;
    for (PetscInt k = 0; k < dim; k++) {
      shortfall->at[k] = 0.;
      for (PetscInt i = 0; i < element.num_nodes; i++) shortfall->at[k] += element.X[i * dim + k] / element.num_nodes;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns where a total is less accurate than PROMISED. Collective. */
static PetscErrorCode LoadRefineWarn_Private(const LoadTerm *term, const Measure *measure, Shortfall *shortfall)
{
  const MPI_Comm comm  = term->level->comm;
  PetscReal      worst = shortfall->worst, part = 0.;
  PetscMPIInt    rank, holder;
  Warning        rough = {.code   = "rough_load",
                          .body   = term->scene->bodies[term->body].name,
                          .dim    = term->dim,
                          .advice = "align mesh edges with it, or refine"};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, shortfall->miss, MAX_DIM, MPIU_REAL, MPI_SUM, comm));
  for (PetscInt k = 0; k < term->dim; k++) part = PetscMax(part, shortfall->miss[k] / measure->scale[k]);
  if (part <= PROMISED) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPIU_REAL, MPI_MAX, comm));
  holder = shortfall->worst == worst ? rank : PETSC_MPI_INT_MAX;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &holder, 1, MPI_INT, MPI_MIN, comm));
  PetscCallMPI(MPI_Bcast(shortfall->at, MAX_DIM, MPIU_REAL, holder, comm));
  for (PetscInt k = 0; k < MAX_DIM; k++) rough.at[k] = shortfall->at[k];
  PetscCall(WarningAdd(&rough, "%s jumps or bends within cells, and two rules differ by %.1e of its total",
                       ExpressionOption(term->value), (double)part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Elements of a term on all ranks that are to be integrated anew. Collective. */
static PetscErrorCode LoadRefineCountRough_Private(const LoadTerm *term, const PetscInt pieces[], PetscReal *num)
{
  PetscFunctionBeginUser;
  *num = 0.;
  for (PetscInt e = 0; e < term->num; e++) *num += pieces[e] > 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_REAL, MPI_SUM, term->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadTermsRefine(Level *level, PetscInt num, LoadTerm terms[], PetscScalar fa[])
{
  PetscBool formulas = PETSC_FALSE;
  Measure  *measures;
  PetscInt *pieces;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) formulas = (PetscBool)(formulas || terms[i].formula);
  if (!formulas) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(num, &measures));
  PetscCall(LoadRefineMeasureTerms_Private(level->comm, num, terms, measures));
  for (PetscInt i = 0; i < num; i++) {
    LoadTerm *term      = &terms[i];
    Shortfall shortfall = {{0.}, 0., {0.}};
    PetscReal num_rough;

    if (!term->formula) continue;
    PetscCall(PetscMalloc1(term->num, &pieces));
    PetscCall(ExpressionCreateSwitches(term->value, &term->switches));
    PetscCall(LoadRefineFindRough_Private(term, &measures[i], pieces, fa));
    PetscCall(LoadRefineCountRough_Private(term, pieces, &num_rough));
    if (num_rough > 0.) {
      if (!term->switches && (term->dim > 2 || !term->on_facets))
        PetscCall(LoadRefineFindNeighbours_Private(term, &measures[i], pieces));
      PetscCall(LoadRefineCountRough_Private(term, pieces, &num_rough));
      PetscCall(LoadRefineIntegrate_Private(term, &measures[i], pieces, num_rough, fa, &shortfall));
      PetscCall(LoadRefineWarn_Private(term, &measures[i], &shortfall));
    }
    PetscCall(PetscFree(pieces));
  }
  PetscCall(PetscFree(measures));
  PetscFunctionReturn(PETSC_SUCCESS);
}
