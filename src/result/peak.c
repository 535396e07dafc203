/* peak.c -- the surfaces around the largest pressure of a pair.

   Facets wider than a rounded edge see a corner there, and so do the pressures. Only the formula of an
   obstacle shows the difference: differences of smaller and smaller steps find an edge of any radius. */
#include "result/peak.h"
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/edgeexponent.h"
#include "result/pairsum.h"

enum {
  F         = ELEMENT_MAX_FACET_NODES,
  STEPS     = 16, /* of differences on a part of a facet */
  ZOOMS     = 6,  /* parts: each has the two steps of the one before where the slope changes most */
  NODE_DATA = 2   /* at a node: pressure, number of facets that end there */
};

/* Differences extend so far beyond a facet, of its length: an edge may lie at its node. */
static const PetscReal PEAK_BEYOND = 0.01;
/* Least ratio of the change of slope on the last part to that on the first one: 1 at an edge, 4e-6 on a
   curve. */
static const PetscReal STAYS = 0.5;
/* Least change of slope that is told from rounding of differences. */
static const PetscReal LEAST_CHANGE = 1e-6;
/* Part of the largest pressure that it falls by on its facets, at least, where it is unbounded: a uniform one
   has no singular part. */
static const PetscReal FALLS = 0.03;
/* Least cosine of a facet's normal and that of a node on a smooth side: 5 degrees. */
static const PetscReal ALIGNED = 0.996;

/* At nodes of the nonmortar side. Collective. [out] nodal - ghosted, NODE_DATA per node */
static PetscErrorCode PeakCreateNodal_Private(Fields fields, PetscInt p, Vec *nodal)
{
  Level        *level  = fields->vi->level;
  const Pair    pair   = fields->vi->pairs[p];
  const Facets *facets = &pair->points->facets;
  PairFields    values;
  PetscScalar  *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, NODE_DATA, nodal));
  PetscCall(GhostedGetArray(*nodal, &a));
  for (PetscInt i = 0; i < level->dim * facets->num; i++)
    a[NODE_DATA * facets->nodes[i / level->dim * F + i % level->dim] + 1] += 1;
  PetscCall(GhostedRestoreArray(*nodal, &a));
  PetscCall(LevelShareVec(*nodal, ADD_VALUES));
  PetscCall(PairFieldsCreate(fields, p, &values));
  PetscCall(VecGetArray(*nodal, &a));
  for (PetscInt k = 0; k < pair->num; k++) a[NODE_DATA * pair->nodes[k]] = values.pressure[pair->nodes[k]];
  PetscCall(VecRestoreArray(*nodal, &a));
  PetscCall(PairFieldsDestroy(&values));
  PetscCall(LevelShareVec(*nodal, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest change of slope of a gap between steps of a part of a facet in the plane. That part becomes the
   two steps around it.
   [in] X - of the facet; [in,out] from, to - reference coordinates of the ends of the part; [out] change */
static PetscErrorCode PeakZoom_Private(Expression gap, ElementType type, const PetscReal X[], PetscReal *from,
                                       PetscReal *to, PetscReal *change)
{
  const PetscReal step = (*to - *from) / STEPS, begin = *from;
  PetscReal       g[STEPS + 1], length                = 0;

  PetscFunctionBeginUser;
  *change = 0;
  for (PetscInt i = 0; i <= STEPS; i++) {
    const PetscReal xi = begin + i * step;
    PetscReal       x[3], phi[ELEMENT_MAX_NODES];
    PetscBool       finite;

    length = step * ElementSurface(type, X, &xi, x, phi, NULL);
    PetscCall(ExpressionTry(gap, 2, x, &g[i], &finite));
    if (!finite) PetscFunctionReturn(PETSC_SUCCESS);
  }
  for (PetscInt i = 1; i < STEPS; i++) {
    const PetscReal here = PetscAbsReal(g[i - 1] - 2 * g[i] + g[i + 1]) / length;

    if (here <= *change) continue;
    *change = here;
    *from   = begin + (i - 1) * step;
    *to     = begin + (i + 1) * step;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether an obstacle's formula has an edge on a facet in the plane: its slope changes as much over small
   steps as over large ones. [in] X - of the facet */
static PetscErrorCode PeakHasKink_Private(const SceneObstacle *obstacle, ElementType type, const PetscReal X[],
                                          PetscBool *kink)
{
  PetscReal from = -PEAK_BEYOND, to = 1 + PEAK_BEYOND, first, last;

  PetscFunctionBeginUser;
  *kink = PETSC_FALSE;
  if (obstacle->kind != OBSTACLE_EXPRESSION) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PeakZoom_Private(obstacle->gap, type, X, &from, &to, &first));
  last = first;
  for (PetscInt k = 0; k < ZOOMS && last > LEAST_CHANGE; k++)
    PetscCall(PeakZoom_Private(obstacle->gap, type, X, &from, &to, &last));
  *kink = (PetscBool)(last > LEAST_CHANGE && last > STAYS * first);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is found on the facets at the largest pressure of a rank. */
typedef struct {
  PetscReal small;             /* size of the smallest one, with the opposite sign */
  PetscReal low;               /* the smallest pressure at a vertex of theirs, with the opposite sign */
  PetscReal end, kink, uneven; /* 1 or 0: the side ends, the obstacle has an edge, the side may have one */
} PeakFindings;

/* Looks at one facet at the largest pressure.
   [in] nodal - of PeakCreateNodal_Private(); normal - directions of contact [dim] */
static PetscErrorCode PeakAddFacet_Private(Fields fields, PetscInt p, PetscInt f, const PetscScalar nodal[],
                                           const PetscScalar normal[], PeakFindings *found)
{
  const Level      *level  = fields->vi->level;
  const Facets     *facets = &fields->vi->pairs[p]->points->facets;
  const PetscInt   *nodes = &facets->nodes[f * F], dim = level->dim;
  const ElementType type = facets->type[f];
  PetscReal         X[3 * F];
  PetscBool         end = PETSC_FALSE, kink;

  PetscFunctionBeginUser;
  ContactFacetCoordinates(level, facets, f, X);
  found->small = PetscMax(found->small, -ElementLongestEdge(type, dim, X));
  for (PetscInt i = 0; i < dim; i++) found->low = PetscMax(found->low, -PetscRealPart(nodal[NODE_DATA * nodes[i]]));
  if (dim == 3) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < dim; i++) {
    PetscReal phi[ELEMENT_MAX_NODES], own[3], x[3];

    end = (PetscBool)(end || PetscRealPart(nodal[NODE_DATA * nodes[i] + 1]) < dim);
    ElementSurface(type, X, ElementNode(type, i), x, phi, own);
    if (VectorDot(dim, own, &normal[dim * nodes[i]]) < ALIGNED) found->uneven = 1;
  }
  if (end) found->end = 1;
  if (end || fields->vi->scene->pairs[p].obstacle.kind == OBSTACLE_NONE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PeakHasKink_Private(&fields->vi->scene->pairs[p].obstacle, type, X, &kink));
  if (kink) found->kink = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PeakGet(Fields fields, PetscInt p, Peak *peak)
{
  const Level       *level  = fields->vi->level;
  const PairPoints   points = fields->vi->pairs[p]->points;
  const Facets      *facets = &points->facets;
  PeakFindings       found  = {.small = -PETSC_MAX_REAL, .low = -PETSC_MAX_REAL};
  Vec                nodal;
  const PetscScalar *at, *normal;
  PairSum            sum;

  PetscFunctionBeginUser;
  PetscCall(PairSumCompute(fields, p, &sum));
  PetscCall(PeakCreateNodal_Private(fields, p, &nodal));
  PetscCall(GhostedGetArrayRead(nodal, &at));
  PetscCall(GhostedGetArrayRead(points->normals, &normal));
  for (PetscInt f = 0; f < facets->num && sum.max_pressure > 0; f++) {
    PetscBool here = PETSC_FALSE;

    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      here = (PetscBool)(here || PetscRealPart(at[NODE_DATA * facets->nodes[f * F + i]]) >= sum.max_pressure);
    if (here) PetscCall(PeakAddFacet_Private(fields, p, f, at, normal, &found));
  }
  PetscCall(GhostedRestoreArrayRead(points->normals, &normal));
  PetscCall(GhostedRestoreArrayRead(nodal, &at));
  PetscCall(VecDestroy(&nodal));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, &found, sizeof(found) / sizeof(PetscReal), MPIU_REAL, MPIU_MAX, level->comm));
  *peak = (Peak){
      .pressure = sum.max_pressure, .size = found.small == -PETSC_MAX_REAL ? 0 : -found.small, .shape = PEAK_UNKNOWN};
  if (found.kink > 0)
    peak->shape = PEAK_KINK;
  else if (found.end > 0)
    peak->shape = PEAK_END;
  else if (level->dim == 2 && fields->vi->scene->pairs[p].obstacle.kind != OBSTACLE_NONE && found.uneven == 0)
    peak->shape = PEAK_SMOOTH;
  if (sum.max_pressure > 0 && -found.low < (1 - FALLS) * sum.max_pressure)
    PetscCall(EdgeExponentGet(fields, p, &sum, peak->size, &peak->exponent));
  PetscFunctionReturn(PETSC_SUCCESS);
}
