/* bodyoverlap.c -- bodies that overlap in space by more than their contact explains.

   Causes are a forgotten move, mixed units, or a body drawn within another. Without a pair nothing else
   detects the overlap; a pair treats it as an interference fit. Points of the boundary of one body, with the
   middles of facets, are searched inside the other. Bodies whose boxes do not overlap need no search. Round
   sides that fit overlap by the rise of their curves over facets. */
#include "base/compat.h"
#include "base/warning.h"
#include "kernel/arc.h"
#include "kernel/boxtree.h"
#include "kernel/closest.h"
#include "kernel/vector.h"
#include "level/plexpoints.h"
#include "mesh/bodyoverlap.h"
#include "side/insidebody.h"
#include "side/sideshape.h"

/* An interference above this part of the smallest extent of a body exceeds small strains. */
static const PetscReal FIT = 0.1;
/* Permitted overlap of two bodies without a pair, as a part of the smallest extent: errors of curves and of
   coordinates. */
static const PetscReal TOUCH = 1e-3;
/* Depths that differ by less are equal. */
static const PetscReal SAME_DEPTH = 1e-8;

/* Coefficients of a sum of coordinates that differs between the points of a mesh: arbitrary digits. */
static const PetscReal MIXED[3] = {1, 0.7548776662466927, 0.5698402909980532};

enum { MAX_MEASURED = 256 }; /* points whose depth is measured */
enum { F = ELEMENT_MAX_FACET_NODES, BOX = 6 };

/* The deepest point of two bodies so far. */
typedef struct {
  PetscReal depth, at[3];
} Deepest;

/* The boundary of all bodies, this rank's part. */
typedef struct {
  PetscInt     num;
  PetscInt    *body, *nodes; /* [num], local nodes of the vertices [num][F] */
  ElementType *type;         /* of order 1 [num] */
} Boundary;

/* Collective. [out] b - owned by the caller */
static PetscErrorCode BoundaryCreate_Private(const Level *level, Boundary *b)
{
  PetscInt   begin, end;
  PetscBool *shared;

  PetscFunctionBeginUser;
  PetscCall(LevelMarkShared(level, &shared));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  b->num = 0;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc3(b->num, &b->body, b->num * F, &b->nodes, b->num, &b->type));
    b->num = 0;
    for (PetscInt f = begin; f < end; f++) {
      PetscInt size, num, vertices[ELEMENT_MAX_NODES];

      PetscCall(DMPlexGetSupportSize(level->dm, f, &size));
      if (size != 1 || shared[f]) continue;
      if (pass) {
        PetscCall(PointGetVertices(level->dm, f, &num, vertices));
        for (PetscInt i = 0; i < num; i++) b->nodes[b->num * F + i] = PointGetNode(level, vertices[i]);
        b->body[b->num] = level->node_body[b->nodes[b->num * F]];
        b->type[b->num] = level->dim == 2 ? ELEMENT_LINE2 : num == 3 ? ELEMENT_TRI3 : ELEMENT_QUAD4;
      }
      b->num++;
    }
  }
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Vertices of a facet. */
static void BoundaryGetFacet_Private(const Level *level, const Boundary *b, PetscInt f, PetscReal X[])
{
  VectorGather(level->dim, ElementNumNodes(b->type[f]), &b->nodes[f * F], level->coords, X);
}

/* The same, and the box around them. [out] box - lower, upper corner [2][dim] */
static void BoundaryGetBox_Private(const Level *level, const Boundary *b, PetscInt f, PetscReal X[], PetscReal box[])
{
  const PetscInt dim = level->dim;

  BoundaryGetFacet_Private(level, b, f, X);
  for (PetscInt k = 0; k < dim; k++) {
    box[k] = box[dim + k] = X[k];
    for (PetscInt i = 1; i < ElementNumNodes(b->type[f]); i++) {
      box[k]       = PetscMin(box[k], X[i * dim + k]);
      box[dim + k] = PetscMax(box[dim + k], X[i * dim + k]);
    }
  }
}

/* The square of the distance of a point from a box. [in] box - [2][dim] */
static PetscReal BoxDistance_Private(PetscInt dim, const PetscReal box[], const PetscReal x[])
{
  PetscReal square = 0;

  for (PetscInt k = 0; k < dim; k++) square += PetscSqr(PetscMax(0, PetscMax(box[k] - x[k], x[k] - box[dim + k])));
  return square;
}

/* Boxes around all bodies: lower, then upper corner. Collective. [out] box - [num_bodies][BOX] */
static PetscErrorCode OverlapSetBoxes_Private(const Level *level, PetscInt num_bodies, PetscReal box[])
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num_bodies * BOX; i++) box[i] = PETSC_MAX_REAL;
  for (PetscInt a = 0; a < level->num_nodes; a++) {
    PetscReal *own = &box[level->node_body[a] * BOX];

    for (PetscInt k = 0; k < dim; k++) {
      own[k]     = PetscMin(own[k], level->coords[a * dim + k]);
      own[3 + k] = PetscMin(own[3 + k], -level->coords[a * dim + k]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, box, (PetscMPIInt)(num_bodies * BOX), MPIU_REAL, MPIU_MIN, level->comm));
  for (PetscInt i = 0; i < num_bodies * BOX; i++)
    if (i % BOX >= 3) box[i] = -box[i];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The smallest extent of a body; in an axisymmetric scene the extent along the radius is a diameter. */
static PetscReal OverlapGetExtent_Private(const struct _n_Scene *scene, const PetscReal box[])
{
  PetscReal extent = PETSC_MAX_REAL;

  for (PetscInt k = 0; k < scene->dim; k++) {
    const PetscBool radius = (PetscBool)(k == 0 && scene->model == MODEL_AXISYMMETRIC);

    extent = PetscMin(extent, radius ? 2 * box[3] : box[3 + k] - box[k]);
  }
  return extent;
}

/* The overlap that the pairs between two bodies explain: infinite for a tie.
   [out] pair - one of them, or NULL */
static PetscReal OverlapGetLimit_Private(const struct _n_Scene *scene, PetscInt a, PetscInt b, const PetscReal box[],
                                         const char **pair)
{
  const PetscReal extent =
      PetscMin(OverlapGetExtent_Private(scene, &box[a * BOX]), OverlapGetExtent_Private(scene, &box[b * BOX]));

  *pair = NULL;
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    const ScenePair *spec = &scene->pairs[p];
    const PetscInt   s = spec->nonmortar.body, m = spec->mortar.body;

    if (!((s == a && m == b) || (s == b && m == a))) continue;
    if (spec->type == PAIR_TIED) return PETSC_INFINITY;
    *pair = spec->name;
  }
  return (*pair ? FIT : TOUCH) * extent;
}

/* Points of the boundary of body a within a box, of all ranks. Collective. [in] box - [BOX]; [out] points -
   owned by the caller */
static PetscErrorCode PointsGather_Private(const Level *level, const Boundary *b, PetscInt a, const PetscReal box[],
                                           GatheredPoints *points)
{
  const PetscInt dim = level->dim;
  PetscInt       num = 0, total = 0;
  PetscReal     *mine;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < b->num; f++) total += b->body[f] == a ? (ElementNumNodes(b->type[f]) + 1) : 0;
  PetscCall(PetscMalloc1(total * dim, &mine));
  for (PetscInt f = 0; f < b->num; f++) {
    const PetscInt n = ElementNumNodes(b->type[f]);
    PetscReal      X[(F + 1) * 3];

    if (b->body[f] != a) continue;
    BoundaryGetFacet_Private(level, b, f, X);
    for (PetscInt k = 0; k < dim; k++) {
      X[n * dim + k] = 0;
      for (PetscInt i = 0; i < n; i++) X[n * dim + k] += X[i * dim + k] / n;
    }
    for (PetscInt i = 0; i <= n; i++) {
      PetscBool within = PETSC_TRUE;

      for (PetscInt k = 0; k < dim; k++)
        within = (PetscBool)(within && box[k] < X[i * dim + k] && X[i * dim + k] < box[3 + k]);
      if (within) PetscCall(PetscArraycpy(&mine[dim * num++], &X[i * dim], dim));
    }
  }
  PetscCall(GatheredPointsCreate(level, num, mine, points));
  PetscCall(PetscFree(mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes points near the boundary of the body. Collective. */
static PetscErrorCode PointsRemoveNear_Private(const Level *level, const Boundary *b, PetscInt body, PetscReal limit,
                                               GatheredPoints *points)
{
  const PetscInt  dim = level->dim;
  PetscReal      *boxes, X[F * 3], query[BOX], eta[2];
  PetscInt       *facet, num = 0, num_hits;
  const PetscInt *hits;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(2 * dim * b->num, &boxes, b->num, &facet));
  for (PetscInt f = 0; f < b->num; f++) {
    if (b->body[f] != body) continue;
    BoundaryGetBox_Private(level, b, f, X, &boxes[2 * dim * num]);
    facet[num++] = f;
  }
  PetscCall(BoxTreeCreate(dim, num, boxes, &tree));
  for (PetscInt i = 0; i < points->num; i++) {
    const PetscReal *x = &points->x[i * dim];

    if (!points->flag[i]) continue;
    for (PetscInt k = 0; k < dim; k++) {
      query[k]       = x[k] - limit;
      query[dim + k] = x[k] + limit;
    }
    PetscCall(BoxTreeQuery(tree, query, &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits && points->flag[i]; h++) {
      BoundaryGetFacet_Private(level, b, facet[hits[h]], X);
      if (ClosestPointOnFacet(dim, b->type[facet[hits[h]]], X, x, eta) <= PetscSqr(limit))
        points->flag[i] = PETSC_FALSE;
    }
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree2(boxes, facet));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, points->flag, (PetscMPIInt)points->num, MPIU_BOOL, MPI_LAND, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a point comes before another: along x, then y, then z. */
static PetscBool PointsCompare_Private(PetscInt dim, const PetscReal x[], const PetscReal y[])
{
  for (PetscInt k = 0; k < dim; k++)
    if (x[k] != y[k]) return (PetscBool)(x[k] < y[k]);
  return PETSC_FALSE;
}

/* The deepest of the remaining points, the first by coordinates of those of equal depth; of more than
   MAX_MEASURED points a subset. Collective. [in,out] deepest - of all bodies so far */
static PetscErrorCode PointsMeasure_Private(const Level *level, const Boundary *b, PetscInt body,
                                            const GatheredPoints *points, Deepest *deepest)
{
  const PetscInt dim  = level->dim;
  PetscInt       left = 0, num = 0, stride, *chosen;
  PetscReal     *away, *key, X[F * 3], box[BOX], eta[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < points->num; i++) left += points->flag[i];
  if (!left) PetscFunctionReturn(PETSC_SUCCESS);
  stride = (left + MAX_MEASURED - 1) / MAX_MEASURED;
  PetscCall(PetscMalloc3(left, &chosen, left, &away, left, &key));
  for (PetscInt i = 0, n = 0; i < points->num; i++) {
    if (!points->flag[i]) continue;
    key[n] = 0;
    for (PetscInt k = 0; k < dim; k++) key[n] += MIXED[k] * points->x[i * dim + k];
    chosen[n++] = i;
  }
  PetscCall(PetscSortRealWithArrayInt(left, key, chosen)); // the same choice on any number of ranks
  for (PetscInt i = 0; i < left; i += stride) chosen[num++] = chosen[i];
  for (PetscInt i = 0; i < num; i++) away[i] = PETSC_MAX_REAL;
  for (PetscInt f = 0; f < b->num; f++) {
    if (b->body[f] != body) continue;
    BoundaryGetBox_Private(level, b, f, X, box);
    for (PetscInt i = 0; i < num; i++) {
      const PetscReal *x = &points->x[chosen[i] * dim];

      if (BoxDistance_Private(dim, box, x) < away[i]) // otherwise the facet is farther away
        away[i] = PetscMin(away[i], ClosestPointOnFacet(dim, b->type[f], X, x, eta));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, away, (PetscMPIInt)num, MPIU_REAL, MPIU_MIN, level->comm));
  for (PetscInt i = 0; i < num; i++) {
    const PetscReal *x = &points->x[chosen[i] * dim], d = PetscSqrtReal(away[i]);

    if (d < deepest->depth * (1 - SAME_DEPTH)) continue;
    if (d < deepest->depth * (1 + SAME_DEPTH) && !PointsCompare_Private(dim, x, deepest->at)) continue;
    deepest->depth = d;
    PetscCall(PetscArraycpy(deepest->at, x, dim));
  }
  PetscCall(PetscFree3(chosen, away, key));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Searches the boundary of body a inside body b, deeper than a limit. Collective.
   [in,out] deepest - as above */
static PetscErrorCode OverlapFind_Private(const Level *level, const Boundary *boundary, PetscInt a, PetscInt b,
                                          const PetscReal boxes[], PetscReal limit, Deepest *deepest)
{
  PetscReal      box[BOX];
  GatheredPoints points;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < level->dim; k++) {
    box[k]     = boxes[b * BOX + k] + limit;
    box[3 + k] = boxes[b * BOX + 3 + k] - limit;
    if (box[k] > boxes[a * BOX + 3 + k] || box[3 + k] < boxes[a * BOX + k] || box[k] >= box[3 + k])
      PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PointsGather_Private(level, boundary, a, box, &points));
  if (points.num) {
    PetscCall(InsideBodyFind(level, b, points.num, points.x, points.flag));
    PetscCall(PointsRemoveNear_Private(level, boundary, b, limit, &points));
    PetscCall(PointsMeasure_Private(level, boundary, b, &points, deepest));
  }
  PetscCall(GatheredPointsDestroy(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far the curve over a facet is from it: that of its middle nodes, or of the normals at its corners.
   [in] normal - of its nodes [F][dim] */
static PetscReal FacetGetRise_Private(const Level *level, const Facets *facets, PetscInt f, const PetscReal normal[])
{
  const PetscInt    dim  = level->dim;
  const ElementType type = facets->type[f], linear = ElementLinear(type);
  PetscReal         X[3 * F], bulge[3 * F], most = 0;

  VectorGather(dim, ElementNumNodes(type), &facets->nodes[f * F], level->coords, X);
  (void)ArcBulge(linear, X, normal, NULL, bulge);
  for (PetscInt e = 0; e < ElementNumEdges(linear); e++) {
    const PetscInt *ends = ElementEdgeNodes(linear, e), middle = ElementNumNodes(linear) + e;
    PetscReal       way[3] = {0};

    for (PetscInt k = 0; k < dim && ElementOrder(type) > 1; k++)
      way[k] = X[middle * dim + k] - (X[ends[0] * dim + k] + X[ends[1] * dim + k]) / 2;
    most = PetscMax(most, PetscMax(VectorNorm(dim, way), VectorNorm(dim, &bulge[middle * dim])));
  }
  return most;
}

/* The largest rise of curves over the facets of a body next to a point. Collective. */
static PetscErrorCode OverlapGetRise_Private(Level *level, PetscInt body, const PetscReal at[], PetscReal *rise)
{
  const PetscInt dim = level->dim;
  SideShape      shape;
  Facets         facets;

  PetscFunctionBeginUser;
  *rise = 0;
  PetscCall(LevelGetBoundary(level, body, &facets));
  PetscCall(SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; f++) {
    const ElementType linear = ElementLinear(facets.type[f]);
    const PetscInt    n      = ElementNumNodes(linear);
    PetscReal         X[3 * F], way[3];

    VectorGather(dim, n, &facets.nodes[f * F], level->coords, X);
    for (PetscInt k = 0; k < dim; k++) way[k] = -at[k];
    for (PetscInt i = 0; i < n * dim; i++) way[i % dim] += X[i] / (PetscReal)n;
    if (VectorNorm(dim, way) <= ElementLongestEdge(linear, dim, X))
      *rise = PetscMax(*rise, FacetGetRise_Private(level, &facets, f, &shape.normal[f * F * dim]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rise, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscCall(SideShapeDestroy(&shape));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a pair refuses the overlap in any case: the user's reach is smaller. */
static PetscBool OverlapIsRefused_Private(const struct _n_Scene *scene, PetscInt a, PetscInt b, PetscReal depth)
{
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    const ScenePair *spec = &scene->pairs[p];
    const PetscInt   s = spec->nonmortar.body, m = spec->mortar.body;

    if (!((s == a && m == b) || (s == b && m == a))) continue;
    if (spec->reach >= 0 && !spec->widened && spec->reach < depth) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Warns of two bodies that overlap. [in] pair - that joins them, or NULL */
static PetscErrorCode OverlapWarn_Private(const Level *level, PetscInt a, PetscInt b, const char pair[],
                                          PetscReal depth, const PetscReal at[])
{
  const char *first = level->scene->bodies[a].name, *second = level->scene->bodies[b].name;
  Warning     overlap = {.code   = "overlapping_bodies",
                         .body   = first,
                         .pair   = pair,
                         .dim    = level->dim,
                         .at     = {at[0], at[1], level->dim == 3 ? at[2] : 0},
                         .advice = "check the positions, units and maps of the bodies"};
  char        z[32]   = "";

  PetscFunctionBeginUser;
  if (level->dim == 3) (void)snprintf(z, sizeof(z), ", %.4g", (double)at[2]);
  if (pair)
    PetscCall(
        WarningAdd(&overlap,
                   "bodies %s and %s overlap by %.3g at (%.4g, %.4g%s), more than the contact %s can close by small "
                   "strains",
                   first, second, (double)depth, (double)at[0], (double)at[1], z, pair));
  else
    PetscCall(WarningAdd(&overlap, "bodies %s and %s overlap by %.3g at (%.4g, %.4g%s), and no pair joins them", first,
                         second, (double)depth, (double)at[0], (double)at[1], z));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyOverlapWarn(Level *level)
{
  const struct _n_Scene *scene = level->scene;
  const PetscInt         n     = scene->num_bodies;
  PetscReal             *box;
  Boundary               boundary = {0, NULL, NULL, NULL};
  PetscBool              any      = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (n < 2) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(n * BOX, &box));
  PetscCall(OverlapSetBoxes_Private(level, n, box));
  for (PetscInt a = 0; a < n; a++) {
    for (PetscInt b = a + 1; b < n; b++) {
      const char     *pair;
      const PetscReal limit   = OverlapGetLimit_Private(scene, a, b, box, &pair);
      Deepest         deepest = {0, {0, 0, 0}};
      PetscReal       rise[2];
      PetscBool       meet = PETSC_TRUE;

      for (PetscInt k = 0; k < level->dim; k++)
        meet = (PetscBool)(meet && PetscMin(box[a * BOX + 3 + k], box[b * BOX + 3 + k]) -
                                           PetscMax(box[a * BOX + k], box[b * BOX + k]) >
                                       limit);
      if (!meet) continue;
      if (!any) PetscCall(BoundaryCreate_Private(level, &boundary));
      any = PETSC_TRUE;
      PetscCall(OverlapFind_Private(level, &boundary, a, b, box, limit, &deepest));
      PetscCall(OverlapFind_Private(level, &boundary, b, a, box, limit, &deepest));
      if (OverlapIsRefused_Private(scene, a, b, deepest.depth)) continue;
      if (deepest.depth <= limit) continue;
      PetscCall(OverlapGetRise_Private(level, a, deepest.at, &rise[0]));
      PetscCall(OverlapGetRise_Private(level, b, deepest.at, &rise[1]));
      if (deepest.depth > limit + rise[0] + rise[1])
        PetscCall(OverlapWarn_Private(level, a, b, pair, deepest.depth, deepest.at));
    }
  }
  if (any) PetscCall(PetscFree3(boundary.body, boundary.nodes, boundary.type));
  PetscCall(PetscFree(box));
  PetscFunctionReturn(PETSC_SUCCESS);
}
