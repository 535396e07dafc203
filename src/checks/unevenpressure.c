/* unevenpressure.c -- pressures that follow the facets of a coarser and softer mortar side.

   Multipliers are stable if the nonmortar side can follow them. A stiff nonmortar side does not bend between
   the nodes of a soft partner with larger facets. It touches that at a few nodes, with pressures that are too
   high. */
#include "checks/unevenpressure.h"
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "contact/slidingnodes.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/largest.h"
#include "result/pairsum.h"
#include "result/sidecorners.h"
#include "side/sidemeasure.h"

/* A pressure shows that exceeds the mean around it by this part. Under a paraboloid three facets wide it does
   so by a sixth. */
static const PetscReal UNEVEN = 0.25;
/* Directions are normal to each other if they are less than 30 degrees from it. */
static const PetscReal NORMAL_TO = 0.5;
/* The nonmortar side is stiffer by this factor of contact moduli at least. At 3, the largest pressure of a
   ball in a cup of facets twice as long is 1.24 times the mean (order 1), at 10 1.45 times. */
static const PetscReal STIFFNESS_RATIO = 3;

enum { F = ELEMENT_MAX_FACET_NODES };
/* Of each node: force and area of its row. */
enum { ROW_FORCE, ROW_AREA, NUM_ROW };
/* Sums over the facets around each node: force and area of rows, the area that is covered, and that times the
   lengths of the facets of both sides. */
enum { FORCE, AREA, COVERED, MORTAR, NONMORTAR, NUM_SUMS };

/* Forces and areas of the rows of pair p. Collective. [out] rows - ghosted [NUM_ROW], owned by the caller */
static PetscErrorCode UnevenPressureCreateRows_Private(Fields fields, PetscInt p, Vec *rows)
{
  const VI           vi = fields->vi;
  const PetscScalar *lambda;
  PetscScalar       *row;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, NUM_ROW, rows));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArray(*rows, &row));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    PetscScalar *of;

    if (vi->row_pair[r] != p || vi->row_direction[r] != 0) continue;
    of           = &row[vi->pairs[p]->nodes[vi->row_node[r]] * NUM_ROW];
    of[ROW_AREA] = fields->row_weight[r];
    if (StatusIsContact(fields->row_status[r])) of[ROW_FORCE] = fields->row_weight[r] * lambda[r];
  }
  PetscCall(VecRestoreArray(*rows, &row));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCall(LevelShareVec(*rows, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sums of one facet.
   [in] row - at local nodes; [in,out] at - its first point, then that of the next facet;
   [out] of - [NUM_SUMS] */
static void UnevenPressureSumFacet_Private(const Level *level, const PairPoints points, PetscInt f,
                                           const PetscScalar row[], PetscInt *at, PetscReal of[])
{
  const PetscInt *nodes = &points->facets.nodes[f * F], num = ElementNumNodes(points->facets.type[f]);
  PetscReal       X[3 * F], length;

  VectorGather(level->dim, num, nodes, level->coords, X);
  length = ElementLongestEdge(ElementLinear(points->facets.type[f]), level->dim, X);
  for (PetscInt k = 0; k < NUM_SUMS; k++) of[k] = 0;
  for (PetscInt i = 0; i < num; i++) {
    of[FORCE] += PetscRealPart(row[nodes[i] * NUM_ROW + ROW_FORCE]);
    of[AREA] += PetscRealPart(row[nodes[i] * NUM_ROW + ROW_AREA]);
  }
  for (; *at < points->num && points->point[*at].facet == f; ++*at) {
    const PairPoint *point = &points->point[*at];

    of[COVERED] += point->weight;
    of[MORTAR] += point->weight * points->size[point->mortar];
    of[NONMORTAR] += point->weight * length;
  }
}

/* Adds up the facets around each node. Collective.
   [in] rows - of all nodes; [out] sums - [NUM_SUMS] per node, owned by the caller */
static PetscErrorCode UnevenPressureCreateSums_Private(Fields fields, PetscInt p, Vec rows, Vec *sums)
{
  Level             *level  = fields->vi->level;
  const PairPoints   points = fields->vi->pairs[p]->points;
  const PetscScalar *row;
  PetscScalar       *sum;
  PetscInt           at = 0;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, NUM_SUMS, sums));
  PetscCall(GhostedGetArrayRead(rows, &row));
  PetscCall(GhostedGetArray(*sums, &sum));
  for (PetscInt f = 0; f < points->facets.num; f++) {
    const PetscInt *nodes = &points->facets.nodes[f * F];
    PetscReal       of[NUM_SUMS];

    UnevenPressureSumFacet_Private(level, points, f, row, &at, of);
    for (PetscInt i = 0; i < ElementNumNodes(points->facets.type[f]); i++)
      for (PetscInt k = 0; k < NUM_SUMS; k++) sum[nodes[i] * NUM_SUMS + k] += of[k];
  }
  PetscCall(GhostedRestoreArray(*sums, &sum));
  PetscCall(GhostedRestoreArrayRead(rows, &row));
  PetscCall(LevelShareVec(*sums, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether planes may cut the side where it ends, so that it goes on behind them as its mirror image. Supports
   hold such a node along the side, in space normal to its boundary.
   [in] way - of SideCornersGetEnds() */
static PetscBool UnevenPressureIsMirrored_Private(const Support *support, const Pair pair, PetscInt a,
                                                  const PetscScalar way[])
{
  const PetscInt   dim = support->dim, node = pair->nodes[a];
  const PetscReal *n         = &pair->frame[a * dim * dim];
  PetscReal        along[3]  = {0, 0, 0};
  PetscInt         num_held  = 0;
  PetscBool        is_normal = PETSC_FALSE;

  for (PetscInt k = 0; k < dim; k++) along[k] = PetscRealPart(way[k]);
  for (PetscInt j = 0; j < support->count[node]; j++) {
    const PetscReal *d = &support->directions[(node * dim + j) * dim];

    if (PetscAbsReal(VectorDot(dim, d, n)) > NORMAL_TO) continue;
    num_held++;
    is_normal = (PetscBool)(PetscAbsReal(VectorDot(dim, d, along)) < NORMAL_TO * VectorNorm(dim, along));
  }
  return (PetscBool)(num_held == dim - 1 || (num_held == 1 && is_normal));
}

/* The mean pressure and the ratio of facets around the largest pressure. Collective.
   [in] row - of it; [out] around - 0 at an edge [2] */
static PetscErrorCode UnevenPressureAround_Private(Fields fields, PetscInt p, PetscInt row, PetscReal around[])
{
  const VI           vi   = fields->vi;
  const Pair         pair = vi->pairs[p];
  const PetscInt     dim  = vi->level->dim;
  const PetscScalar *sum, *way;
  PetscInt           begin, end, a = -1, node = -1;
  PetscBool          slides = PETSC_FALSE; /* along a support, but the partner is not held there */
  Vec                rows, sums, ways;

  PetscFunctionBeginUser;
  around[0] = around[1] = 0;
  PetscCall(UnevenPressureCreateRows_Private(fields, p, &rows));
  PetscCall(UnevenPressureCreateSums_Private(fields, p, rows, &sums));
  PetscCall(SideCornersGetEnds(vi->level, &pair->points->facets, &ways));
  PetscCall(VecGetArrayRead(sums, &sum));
  PetscCall(VecGetArrayRead(ways, &way));
  PetscCall(VecGetOwnershipRange(fields->lambda, &begin, &end));
  if (row >= begin && row < end) {
    a    = vi->row_node[row - begin];
    node = pair->nodes[a];
  }
  PetscCall(SlidingNodesFind(vi->level, &vi->support, pair->M, a >= 0, &node, a >= 0 ? &pair->D[a] : NULL, &slides));
  if (a >= 0) {
    const PetscScalar *of   = &sum[node * NUM_SUMS];
    PetscBool          edge = (PetscBool)(!(PetscRealPart(of[COVERED]) > 0) || PairSumEndsPartner(pair, a));

    if (!edge && SideCornersIsEnd(dim, &way[node * dim], PetscRealPart(of[NONMORTAR] / of[COVERED])))
      edge = (PetscBool)(slides || !UnevenPressureIsMirrored_Private(&vi->support, pair, a, &way[node * dim]));
    if (!edge) {
      around[0] = PetscRealPart(of[FORCE] / of[AREA]);
      around[1] = PetscRealPart(of[MORTAR] / of[NONMORTAR]);
    }
  }
  PetscCall(VecRestoreArrayRead(ways, &way));
  PetscCall(VecRestoreArrayRead(sums, &sum));
  PetscCall(VecDestroy(&ways));
  PetscCall(VecDestroy(&sums));
  PetscCall(VecDestroy(&rows));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, around, 2, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UnevenPressureFind(Fields fields, PetscInt p, UnevenPressure *found)
{
  const VI         vi     = fields->vi;
  const ScenePair *spec   = vi->pairs[p]->spec;
  const SceneBody *bodies = vi->scene->bodies;
  PetscReal        around[2]; /* mean, ratio */
  SideMeasure      side[2];
  PairSum          pressed;

  PetscFunctionBeginUser;
  *found = (UnevenPressure){.shows = PETSC_FALSE};
  if (spec->type != PAIR_CONTACT || spec->mortar.body < 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (bodies[spec->nonmortar.body].num_regions || bodies[spec->mortar.body].num_regions)
    PetscFunctionReturn(PETSC_SUCCESS); // pressures of layers differ without a fault of the mesh
  PetscCall(PairSumCompute(fields, p, &pressed));
  if (!pressed.active) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &spec->nonmortar, &side[0]));
  PetscCall(SideMeasureCompute(vi->scene, vi->level, &spec->mortar, &side[1]));
  if (side[0].modulus <= STIFFNESS_RATIO * side[1].modulus) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(UnevenPressureAround_Private(fields, p, pressed.max_pressure_row, around));
  PetscCall(PetscArraycpy(found->at, pressed.max_pressure_at, 3));
  found->largest = pressed.max_pressure;
  found->mean    = around[0];
  found->ratio   = around[1];
  found->shows   = (PetscBool)(found->ratio > 1 && found->largest > (1 + UNEVEN) * found->mean);
  PetscFunctionReturn(PETSC_SUCCESS);
}
