/* sideshape.c -- normals and curvatures of the smooth patches of a side.

   Contributions of the facets around a node are summed over all ranks. At a feature edge sums of one patch
   are needed: the few facets there are sent to all ranks. */
#include "base/compat.h"
#include "level/facets.h"
#include "kernel/frame.h"
#include "side/arcnormals.h"
#include "side/sidecurves.h"
#include "side/sideends.h"
#include "side/sidehanging.h"
#include "side/sidejets.h"
#include "side/sidekinks.h"
#include "side/sidequadrics.h"
#include "side/sidesums.h"
#include "kernel/vector.h"

/* Neighbours lie on a line whose second moment across it is below this share. */
static const PetscReal ON_A_LINE = 1e-4;

enum {
  F          = ELEMENT_MAX_FACET_NODES,
  MOST_KINKS = 4 /* searches for quadrics: edges that lie behind each other, and one more */
};

/* Data of a side during the computation. */
typedef struct {
  Level        *level;
  const Facets *facets;
  SideShape    *shape;
  SideSums      nodes;
  SidePlanes    planes;
  PetscReal    *weighted; /* normal of each facet alone, with its weight [num][F][dim] */
  PetscReal    *share;    /* of a full turn around the node: of the facet, then of its patch [num][F] */
  SideFit       fit;
} Side;

/* One corner of a facet at a feature edge. */
typedef struct {
  PetscInt  node;                                    /* global */
  PetscReal unit[3], weighted[3], share, outward[3]; /* from the node to the middle of the facet */
} Corner;

/* The share of a full turn around node i that a facet fills. [in] X - [num_nodes][dim] */
static PetscReal SideShapeAngleShare_Private(PetscInt dim, ElementType type, PetscInt i, const PetscReal X[])
{
  const PetscInt num = ElementNumNodes(ElementLinear(type)), edges = dim == 2 ? 0 : num;
  PetscReal      a[3], b[3];

  if (i >= num) return i < num + edges ? 0.5 : 1;
  if (dim == 2) return 0.5;
  for (PetscInt k = 0; k < 3; k++) {
    a[k] = X[3 * ((i + 1) % num) + k] - X[3 * i + k];
    b[k] = X[3 * ((i + num - 1) % num) + k] - X[3 * i + k];
  }
  return PetscAcosReal(
             PetscMax(-1, PetscMin(1, VectorDot(3, a, b) / PetscSqrtReal(VectorDot(3, a, a) * VectorDot(3, b, b))))) /
         (2 * PETSC_PI);
}

static void SideShapeSetCorners_Private(Side *side)
{
  const PetscInt dim = side->level->dim;

  for (PetscInt f = 0; f < side->facets->num; f++) {
    const ElementType type = side->facets->type[f];
    PetscReal         X[3 * F];

    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      for (PetscInt k = 0; k < dim; k++) X[i * dim + k] = SideGetPosition(side->level, side->facets, f, i, k);
    }
    FrameAddFacetNormal(dim, ElementNumNodes(type), X, &side->weighted[f * F * dim]);
    if (side->level->conforming) SideHangingSetCorners(side->level, side->facets, f, X, &side->weighted[f * F * dim]);
    for (PetscInt i = 0; i < ElementNumNodes(type); i++)
      side->share[f * F + i] = SideShapeAngleShare_Private(dim, type, i, X);
  }
}

/* Whether facets around the nodes of corners may meet at a feature edge. Collective.
   [out] suspect - 1 or 0 [num][F] */
static PetscErrorCode SideShapeFindSuspects_Private(const Side *side, PetscReal suspect[])
{
  const PetscInt dim = side->level->dim;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      PetscReal unit[3];

      PetscCall(PetscArraycpy(unit, &side->weighted[(f * F + i) * dim], dim));
      FrameNormalize(dim, unit);
      suspect[f * F + i] = VectorDot(dim, unit, &side->shape->normal[(f * F + i) * dim]) < SURELY_SMOOTH ? 1 : 0;
    }
  }
  PetscCall(SideSumAtNodes(&side->nodes, 1, NULL, suspect));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The record of a corner of this rank for other ranks. */
static Corner SideShapeCornerOf_Private(const Side *side, PetscInt f, PetscInt i)
{
  const PetscInt dim = side->level->dim, n = ElementNumNodes(ElementLinear(side->facets->type[f]));
  Corner corner = {.node = side->level->node_global[side->facets->nodes[f * F + i]], .share = side->share[f * F + i]};

  for (PetscInt k = 0; k < dim; k++) {
    corner.unit[k] = corner.weighted[k] = side->weighted[(f * F + i) * dim + k];
    for (PetscInt v = 0; v < n; v++)
      corner.outward[k] +=
          (SideGetPosition(side->level, side->facets, f, v, k) - SideGetPosition(side->level, side->facets, f, i, k)) /
          (PetscReal)n;
  }
  FrameNormalize(dim, corner.unit);
  FrameNormalize(dim, corner.outward);
  return corner;
}

static int SideShapeCompareCorners_Private(const void *a, const void *b)
{
  const PetscInt first = ((const Corner *)a)->node, second = ((const Corner *)b)->node;

  return first < second ? -1 : first > second;
}

/* The corners at suspect nodes, of all ranks, by nodes. Collective. [out] all - freed by the caller [*num] */
static PetscErrorCode SideShapeGatherCorners_Private(const Side *side, const PetscReal suspect[], PetscInt *num,
                                                     Corner **all)
{
  PetscMPIInt size, *counts, *begin, mine = 0;
  Corner     *corners;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(side->level->comm, &size));
  PetscCall(PetscMalloc3(side->facets->num * F, &corners, size, &counts, size + 1, &begin));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      if (suspect[f * F + i] > 0) corners[mine++] = SideShapeCornerOf_Private(side, f, i);
    }
  }
  mine *= (PetscMPIInt)sizeof(Corner);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, counts, 1, MPI_INT, side->level->comm));
  begin[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) begin[r + 1] = begin[r] + counts[r];
  *num = begin[size] / (PetscInt)sizeof(Corner);
  PetscCall(PetscMalloc1(*num, all));
  PetscCallMPI(MPI_Allgatherv(corners, mine, MPI_BYTE, *all, counts, begin, MPI_BYTE, side->level->comm));
  if (*num) qsort(*all, (size_t)*num, sizeof(Corner), SideShapeCompareCorners_Private);
  PetscCall(PetscFree3(corners, counts, begin));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the normal of one corner to that of its own patch, where there are several.
   [in] node - all corners of its node [num] */
static void SideShapeSetPatch_Private(Side *side, PetscInt f, PetscInt i, PetscInt num, const Corner node[])
{
  const PetscInt dim       = side->level->dim;
  const Corner   own       = SideShapeCornerOf_Private(side, f, i);
  PetscReal      normal[3] = {0}, share = 0, ridge = 0;
  PetscBool      edge = PETSC_FALSE;

  for (PetscInt c = 0; c < num; c++) {
    if (VectorDot(dim, own.unit, node[c].unit) < SMOOTH_SIDE) {
      edge = PETSC_TRUE;
      ridge -= VectorDot(dim, own.unit, node[c].outward); // negative products, at a convex edge
      continue;
    }
    share += node[c].share;
    for (PetscInt k = 0; k < dim; k++) normal[k] += node[c].weighted[k];
  }
  if (!edge) return;
  FrameNormalize(dim, normal);
  for (PetscInt k = 0; k < dim; k++) side->shape->normal[(f * F + i) * dim + k] = normal[k];
  side->share[f * F + i]        = share;
  side->shape->ridge[f * F + i] = ridge > 0 ? 1 : -1;
}

/* Lets corners at feature edges have the normals of their own patches. Collective. */
static PetscErrorCode SideShapeSplitPatches_Private(Side *side)
{
  PetscReal *suspect;
  PetscInt   num = 0;
  Corner    *corners;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(side->facets->num * F, &suspect));
  PetscCall(SideShapeFindSuspects_Private(side, suspect));
  PetscCall(SideShapeGatherCorners_Private(side, suspect, &num, &corners));
  for (PetscInt f = 0; f < side->facets->num && num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      const Corner key   = {.node = side->level->node_global[side->facets->nodes[f * F + i]]};
      Corner      *first = suspect[f * F + i] > 0
                               ? bsearch(&key, corners, (size_t)num, sizeof(Corner), SideShapeCompareCorners_Private)
                               : NULL;
      PetscInt     count = 0;

      if (!first) continue;
      while (first > corners && first[-1].node == key.node) first--;
      while (first + count < corners + num && first[count].node == key.node) count++;
      SideShapeSetPatch_Private(side, f, i, count, first);
    }
  }
  PetscCall(PetscFree(corners));
  PetscCall(PetscFree(suspect));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the moments of one neighbour in its facet to a corner: dx dx', dn dx' / |dx|^2 in the tangent plane.
   [in,out] sums - [2][dim][dim] */
static void SideShapeAddNeighbour_Private(const Side *side, PetscInt f, PetscInt i, PetscInt j, PetscReal sums[])
{
  const PetscInt   dim = side->level->dim;
  const PetscReal *n = &side->shape->normal[(f * F + i) * dim], *m = &side->shape->normal[(f * F + j) * dim];
  PetscReal        dx[3], dn[3], along, across, square, most = 0;

  for (PetscInt k = 0; k < dim; k++) {
    dx[k] = SideGetPosition(side->level, side->facets, f, j, k) - SideGetPosition(side->level, side->facets, f, i, k);
    dn[k] = m[k] - n[k];
  }
  along  = VectorDot(dim, dx, n);
  across = VectorDot(dim, dn, n);
  for (PetscInt k = 0; k < dim; k++) {
    dx[k] -= along * n[k];
    dn[k] -= across * n[k];
    most = PetscMax(most, PetscAbsReal(dn[k]));
  }
  square = VectorDot(dim, dx, dx);
  for (PetscInt k = 0; k < dim * dim && square > 0; k++) {
    sums[k] += dx[k / dim] * dx[k % dim] / square;
    if (most > FLAT_SIDE) sums[dim * dim + k] += dn[k / dim] * dx[k % dim] / square;
  }
}

/* Eigenvector of the larger eigenvalue of a symmetric matrix of the plane; its smaller eigenvalue over the
   larger. */
static PetscReal SideShapePrincipal_Private(const PetscReal A[4], PetscReal d[2])
{
  const PetscReal mean = 0.5 * (A[0] + A[3]), half = 0.5 * (A[0] - A[3]), off = 0.5 * (A[1] + A[2]);
  const PetscReal radius = PetscSqrtReal(half * half + off * off), angle = 0.5 * PetscAtan2Real(off, half);

  d[0] = PetscCosReal(angle);
  d[1] = PetscSinReal(angle);
  return mean + radius > 0 ? (mean - radius) / (mean + radius) : 0;
}

/* S with S dx = dn for all neighbours, by least squares; along a line alone if all neighbours are on it.
   Returns whether they are not.
   [in] sums - [2][dim][dim]; [out] S - [dim][dim] */
static PetscBool SideShapeFitCurvature_Private(PetscInt dim, const PetscReal n[], const PetscReal sums[], PetscReal S[])
{
  PetscReal Q[9], X[4] = {0}, N[4] = {0}, T[4] = {0}, d[2];
  PetscBool full = PETSC_TRUE;

  FrameFromNormal(dim, n, Q);
  for (PetscInt a = 0; a < dim - 1; a++) {
    for (PetscInt b = 0; b < dim - 1; b++) {
      for (PetscInt k = 0; k < dim * dim; k++) {
        const PetscReal q = Q[(1 + a) * dim + k / dim] * Q[(1 + b) * dim + k % dim];

        X[2 * a + b] += q * sums[k];
        N[2 * a + b] += q * sums[dim * dim + k];
      }
    }
  }
  if (dim == 2) {
    full = (PetscBool)(X[0] > 0);
    T[0] = full ? N[0] / X[0] : 0;
  } else if (SideShapePrincipal_Private(X, d) < ON_A_LINE) {
    const PetscReal size = X[0] + X[3], s[2] = {N[0] * d[0] + N[1] * d[1], N[2] * d[0] + N[3] * d[1]};

    full = PETSC_FALSE;
    for (PetscInt k = 0; k < 4 && size > 0; k++) T[k] = (s[0] * d[0] + s[1] * d[1]) / size * d[k / 2] * d[k % 2];
  } else {
    const PetscReal det = X[0] * X[3] - X[1] * X[2];

    T[0] = (N[0] * X[3] - N[1] * X[2]) / det;
    T[3] = (N[3] * X[0] - N[2] * X[1]) / det;
    T[1] = T[2] = 0.5 * (N[1] * X[0] - N[0] * X[1] + N[2] * X[3] - N[3] * X[2]) / det;
  }
  for (PetscInt k = 0; k < dim * dim; k++) {
    S[k] = 0;
    for (PetscInt a = 0; a < (dim - 1) * (dim - 1); a++)
      S[k] += T[2 * (a / (dim - 1)) + a % (dim - 1)] * Q[(1 + a / (dim - 1)) * dim + k / dim] *
              Q[(1 + a % (dim - 1)) * dim + k % dim];
  }
  return full;
}

/* Adds the mirror images of what neighbours add, at nodes on planes of symmetry.
   [in,out] sums - [num][F][2][dim][dim] */
static void SideShapeAddImages_Private(const Side *side, PetscReal sums[])
{
  const PetscInt dim = side->level->dim, size = dim * dim;

  for (PetscInt c = 0; c < side->facets->num * F && side->planes.num; c++) {
    const PetscInt on = side->planes.on[side->nodes.corner[c]];

    for (PetscInt s = 0; s < 2 * side->planes.num; s++) {
      PetscReal *A = &sums[(2 * c + s % 2) * size], image[9];

      if (!(on >> s / 2 & 1) || side->shape->ridge[c] != 0) continue;
      for (PetscInt k = 0; k < size; k++) image[k] = A[k];
      SidePlanesReflectMatrix(&side->planes, dim, s / 2, image);
      for (PetscInt k = 0; k < size; k++) A[k] += image[k];
    }
  }
}

/* Curvatures of all corners. Collective. [in] inner - from inner nodes of patches alone; [out] known - 1
   where they are in all directions [num][F], or NULL */
static PetscErrorCode SideShapeSetCurvatures_Private(Side *side, PetscBool inner, PetscReal known[])
{
  const PetscInt dim = side->level->dim;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(side->facets->num * F * 2 * dim * dim, &sums));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt n = ElementNumNodes(side->facets->type[f]);

    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        if (i == j || (inner && side->share[f * F + j] < INNER_TURN)) continue;
        SideShapeAddNeighbour_Private(side, f, i, j, &sums[(f * F + i) * 2 * dim * dim]);
      }
    }
  }
  PetscCall(SideSumAtNodes(&side->nodes, 2 * dim * dim, side->shape->ridge, sums));
  SideShapeAddImages_Private(side, sums);
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      const PetscInt  c    = f * F + i;
      const PetscBool full = SideShapeFitCurvature_Private(dim, &side->shape->normal[c * dim], &sums[c * 2 * dim * dim],
                                                           &side->shape->curvature[c * dim * dim]);

      if (known) known[c] = full && side->share[c] >= INNER_TURN ? 1 : 0;
    }
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether facets of one patch meet at an angle, or are curved, anywhere. Collective. */
static PetscErrorCode SideShapeTurns_Private(const Side *side, PetscBool *turns)
{
  const PetscInt dim = side->level->dim;

  PetscFunctionBeginUser;
  *turns = PETSC_FALSE;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      PetscReal unit[3], own[3];

      PetscCall(PetscArraycpy(unit, &side->weighted[(f * F + i) * dim], dim));
      PetscCall(PetscArraycpy(own, &side->weighted[f * F * dim], dim));
      FrameNormalize(dim, unit);
      FrameNormalize(dim, own);
      for (PetscInt k = 0; k < dim; k++) {
        const PetscReal normal = side->shape->normal[(f * F + i) * dim + k];
        if (PetscAbsReal(unit[k] - normal) > FLAT_SIDE || PetscAbsReal(unit[k] - own[k]) > FLAT_SIDE)
          *turns = PETSC_TRUE;
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, turns, 1, MPIU_BOOL, MPI_LOR, side->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether facets of a side in space are those of a file: their nodes may lie on the surfaces of a part. A box
   has nodes in order, for which means over facets are exact on cylinders. Collective. */
static PetscErrorCode SideShapeIsOfFile_Private(const Side *side, PetscBool *file)
{
  const Scene scene = side->level->scene;

  PetscFunctionBeginUser;
  *file = PETSC_FALSE;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const SceneBody *body = &scene->bodies[side->level->cell_body[side->facets->cell[f]]];

    *file = (PetscBool)(*file || body->mesh_file);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, file, 1, MPIU_BOOL, MPI_LOR, side->level->comm));
  *file = (PetscBool)(*file && side->level->dim == 3);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes normals that are known, which are not zero. Roundoff alone changes nothing: flat stays flat. */
static void SideShapeTake_Private(Side *side)
{
  const PetscInt dim = side->level->dim;

  for (PetscInt c = 0; c < side->facets->num * F; c++) {
    const PetscReal *known  = &side->fit.normal[c * dim];
    PetscReal       *normal = &side->shape->normal[c * dim], most = 0;

    for (PetscInt k = 0; k < dim; k++) most = PetscMax(most, PetscAbsReal(known[k] - normal[k]));
    if (most <= FLAT_SIDE || VectorNorm(dim, known) == 0) continue;
    for (PetscInt k = 0; k < dim; k++) normal[k] = known[k];
  }
}

/* Facets of sides that the scene holds normal. Collective. [out] held - owned by the caller */
static PetscErrorCode SideShapeGetHeld_Private(Level *level, Facets *held)
{
  const Scene scene = level->scene;

  PetscFunctionBeginUser;
  *held = (Facets){.num = 0};
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++) {
      const SceneBoundary *boundary = &scene->bodies[b].boundaries[i];
      Facets               more;

      if (boundary->kind != BOUNDARY_NORMAL) continue;
      PetscCall(LevelGetFacets(level, scene, b, boundary->side, &more));
      PetscCall(FacetsAppend(&more, held));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static SmoothSide SideShapeSmooth_Private(const Side *side)
{
  return (SmoothSide){side->level, side->facets, &side->nodes, &side->planes, side->shape, side->share};
}

/* Normals from means over facets: those of quadrics and of curves of higher order, where there are, and
   extrapolated ones at ends. Collective.
   [in] mean - [num][F][dim]; [in] quadrics - zero where there is none [num][F][dim], or NULL;
   [out] known - of curvatures [num][F] */
static PetscErrorCode SideShapeSetNormals_Private(Side *side, const PetscReal mean[], const PetscReal quadrics[],
                                                  PetscReal known[])
{
  const SmoothSide smooth = SideShapeSmooth_Private(side);
  const PetscInt   dim = side->level->dim, num = side->facets->num * F;
  SideShape       *shape = side->shape;
  SideFit         *fit   = &side->fit;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(fit->normal, num * dim));
  PetscCall(PetscArrayzero(fit->spread, num));
  PetscCall(PetscArrayzero(fit->error, num));
  PetscCall(PetscArraycpy(shape->normal, mean, num * dim));
  if (quadrics) {
    PetscCall(PetscArraycpy(fit->normal, quadrics, num * dim));
    PetscCall(PetscArrayzero(fit->curvature, num * dim * dim));
    PetscCall(SideJetsGetNormals(&smooth, fit));
  }
  if (dim == 2) PetscCall(SideCurvesGetNormals(&smooth, fit->normal, fit->error));
  SideShapeTake_Private(side);
  PetscCall(SideShapeSetCurvatures_Private(side, PETSC_TRUE, known));
  PetscCall(SideEndsSetNormals(side->level, &side->nodes, side->share, known, shape));
  SideShapeTake_Private(side);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes the curvatures of polynomials, where there are. */
static void SideShapeTakeFit_Private(Side *side)
{
  const PetscInt   dim = side->level->dim, size = dim * dim;
  const PetscReal *curvature = side->fit.curvature;

  for (PetscInt c = 0; c < side->facets->num * F; c++) {
    side->shape->error[c] = side->fit.error[c];
    side->shape->known[c] = (PetscBool)(dim == 2 || VectorNorm(dim, &side->fit.normal[c * dim]) > 0);
    if (!curvature || VectorNorm(size, &curvature[c * size]) == 0) continue;
    side->shape->smooth[c] = PETSC_TRUE;
    for (PetscInt k = 0; k < size; k++) side->shape->curvature[c * size + k] = curvature[c * size + k];
  }
}

/* Finds planes of symmetry, and lets the patch surround the nodes on them: the mean over the facets and their
   images is tangential. Where two planes meet, or in the plane, one direction is left. Collective.
   [in] held - or NULL, as of SideShapeCreate(); [in,out] mean - [num][F][dim] */
static PetscErrorCode SideShapeFindPlanes_Private(Side *side, const Facets *held, PetscReal mean[])
{
  const PetscInt dim = side->level->dim;
  Facets         own = {.num = 0};

  PetscFunctionBeginUser;
  if (!held) PetscCall(SideShapeGetHeld_Private(side->level, &own));
  PetscCall(SidePlanesDestroy(&side->planes));
  PetscCall(SidePlanesCreate(side->level, &side->nodes, held ? held : &own, &side->planes));
  if (!held) PetscCall(FacetsDestroy(&own));
  PetscCall(SidePlanesJudge(
      &side->nodes, dim, &(SideEnds){side->shape->ridge, mean, side->shape->normal, side->fit.spread}, &side->planes));
  for (PetscInt f = 0; f < side->facets->num && side->planes.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      const PetscInt c = f * F + i, on = side->planes.on[side->nodes.corner[c]];

      if (!on || side->shape->ridge[c] != 0) continue;
      side->share[c] = 1;
      SidePlanesProject(&side->planes, dim, on, &mean[c * dim]);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Normals of quadrics, and the feature edges that these show: what is behind one may then be found to be
   another quadric, with edges of its own. Collective.
   [out] quadrics - zero where there is none [num][F][3] */
static PetscErrorCode SideShapeFindQuadrics_Private(Side *side, PetscReal quadrics[])
{
  const SmoothSide smooth = SideShapeSmooth_Private(side);
  SideShape       *shape  = side->shape;
  PetscBool        more   = PETSC_TRUE;
  PetscReal       *about;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(shape->num * F * QUADRIC_MONOMIALS, &about));
  for (PetscInt k = 0; k < MOST_KINKS && more; k++) {
    PetscCall(SideQuadricsGetNormals(&smooth, shape->quadric, quadrics, about));
    PetscCall(SideKinksSplit(&smooth, side->weighted, about, side->share, shape, &more));
  }
  PetscCall(PetscFree(about));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideShapeCreate(Level *level, const Facets *facets, const Facets *held, SideShape *shape)
{
  const PetscInt dim = level->dim, num = facets->num * F;
  Side           side = {.level = level, .facets = facets, .shape = shape};
  PetscReal     *known, *mean, *quadrics = NULL;
  PetscBool      turns, file;

  PetscFunctionBeginUser;
  *shape = (SideShape){.num = facets->num};
  PetscCall(PetscCalloc6(num * dim, &shape->normal, num * dim * dim, &shape->curvature, num, &shape->ridge, num,
                         &shape->known, num, &shape->smooth, num, &shape->error));
  PetscCall(PetscCalloc4(num * dim, &side.weighted, num, &side.share, num, &known, num * dim, &mean));
  PetscCall(SideSumsCreate(level, facets, &side.nodes));
  SideShapeSetCorners_Private(&side);
  PetscCall(PetscArraycpy(shape->normal, side.weighted, num * dim));
  PetscCall(SideSumAtNodes(&side.nodes, dim, NULL, shape->normal));
  for (PetscInt c = 0; c < num; c++) FrameNormalize(dim, &shape->normal[c * dim]);
  PetscCall(SideShapeSplitPatches_Private(&side));
  PetscCall(SideShapeTurns_Private(&side, &turns));
  if (turns) {
    PetscCall(SideSumAtNodes(&side.nodes, 1, shape->ridge, side.share));
    PetscCall(SideShapeIsOfFile_Private(&side, &file));
    if (file) PetscCall(PetscCalloc1(facets->num, &shape->quadric));
    PetscCall(PetscCalloc3(num * dim, &side.fit.normal, num, &side.fit.spread, num, &side.fit.error));
    if (file) // not NULL on ranks without facets
      PetscCall(PetscCalloc2(num * dim + 1, &quadrics, num * dim * dim + 1, &side.fit.curvature));
    if (file) PetscCall(SideShapeFindQuadrics_Private(&side, quadrics));
    PetscCall(PetscArraycpy(mean, shape->normal, num * dim));
    PetscCall(SidePlanesCreate(level, &side.nodes, NULL, &side.planes));
    PetscCall(SideShapeSetNormals_Private(&side, mean, quadrics, known));
    if (file || dim == 2) PetscCall(SideShapeFindPlanes_Private(&side, held, mean));
    if (side.planes.num) PetscCall(SideShapeSetNormals_Private(&side, mean, quadrics, known));
    PetscCall(ArcNormalsTake(level, facets, shape));
    PetscCall(SideHangingSetShape(level, facets, shape));
    PetscCall(SideShapeSetCurvatures_Private(&side, PETSC_FALSE, NULL));
    SideShapeTakeFit_Private(&side);
    PetscCall(PetscFree2(quadrics, side.fit.curvature));
    PetscCall(PetscFree3(side.fit.normal, side.fit.spread, side.fit.error));
    PetscCall(SideHangingSetShape(level, facets, shape));
  }
  PetscCall(SidePlanesDestroy(&side.planes));
  PetscCall(SideSumsDestroy(&side.nodes));
  PetscCall(PetscFree4(side.weighted, side.share, known, mean));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideShapeDestroy(SideShape *shape)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree6(shape->normal, shape->curvature, shape->ridge, shape->known, shape->smooth, shape->error));
  PetscCall(PetscFree(shape->quadric));
  shape->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideShapeIsCurved(const Level *level, const Facets *facets, const SideShape *shape, PetscBool *curved)
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  *curved = PETSC_FALSE;
  for (PetscInt c = 0; c < facets->num * F * dim * dim; c++) *curved = (PetscBool)(*curved || shape->curvature[c] != 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, curved, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
