/* contactpatches.c -- connected components of nodes in contact, and the integrals over them.

   Each rank joins the nodes of its own facets. Patches that go on across ranks exchange the largest global
   number of their nodes until none changes. This takes as many exchanges as a patch crosses boundaries
   between ranks. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/disjointsets.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "checks/contactpatches.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES };
enum { SIZE_DEGREE = 2 }; /* of the quadrature of a facet's area, which weighs it against others */

/* Principal axes of areas whose two largest second moments differ by less than this part are not determined:
   those of a circle. */
static const PetscReal ROUND = 0.01;
/* The width of an ellipse over the root of the second moment of its area, per area. */
static const PetscReal ELLIPSE_WIDTH = 4;
/* A patch in space is a bent strip if it fills less than this part of the ellipse with the same second
   moments. A rectangle fills 0.95 of it, a ring of radii r < R fills (R^2 - r^2) / (R^2 + r^2). The moments
   are those of points, and too large where nodes are few: of one in a corner it fills 0.32, of three there
   0.49. So fewer than BENT_NODES do not tell. */
static const PetscReal BENT_FILL = 0.4;
enum { BENT_NODES = 4 };
/* Forces, or places, that differ by less than this part come in the same order on any number of ranks. */
static const PetscReal SAME_PATCH = 1e-9;

/* Pressures below this part of the largest are rounding, which open nodes have. */
static const PetscReal NO_PRESSURE = 1e-9;

/* What is added over the rows of a patch, and over the points that its nodes stand for. */
enum { ROW_NODES, ROW_AREA, ROW_NORMAL, ROW_FORCE, ROW_CENTRE = ROW_FORCE + 3, ROW_SUMS = ROW_CENTRE + 3 };
enum { POINT_SIZE, POINT_FIRST, POINT_SECOND = POINT_FIRST + 3, POINT_SUMS = POINT_SECOND + 9 };
/* Ranges along two axes are maxima; facets and their sizes along these axes are sums. */
enum { RANGE_UPPER, RANGE_LOWER = RANGE_UPPER + 2, RANGES = RANGE_LOWER + 2 };
enum { FACET_SHARE, FACET_COUNT, FACET_SHORTEST, FACET_LENGTH, FACET_SUMS = FACET_LENGTH + 2 };

/* Nodes of a side in contact under collection. */
typedef struct {
  Fields    fields;
  PetscInt  p;
  Facets    facets; /* of the nonmortar side, of this rank */
  PetscInt *patch;  /* of local nodes, -1 for none [num_nodes] */
} PatchNodes;

/* Joins the nodes in contact of each facet. [in] label - < 0 where a node is not in contact; [out] parent -
   [num_nodes] */
static void PatchJoinFacets_Private(const Facets *facets, PetscInt num_nodes, const PetscScalar label[],
                                    PetscInt parent[])
{
  DisjointSetsInitialize(num_nodes, parent);
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscInt first = -1;

    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt node = facets->nodes[f * F + i];

      if (PetscRealPart(label[node]) < 0) continue;
      if (first < 0) first = node;
      DisjointSetsUnite(parent, first, node);
    }
  }
}

/* Nodes in contact get the global number of one of them, others -1. Where a constraint was redistributed
   there is contact if there is pressure. Collective. [out] labels - ghosted */
static PetscErrorCode PatchSetLabels_Private(Fields fields, PetscInt p, Vec labels)
{
  Level       *level = fields->vi->level;
  PairFields   nodal;
  PetscReal    largest = 0;
  PetscScalar *label;

  PetscFunctionBeginUser;
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  for (PetscInt i = 0; i < level->num_owned; i++) largest = PetscMax(largest, nodal.pressure[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscCall(VecGetArray(labels, &label));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscBool joins =
        (PetscBool)(nodal.status[i] == STATUS_NONE && nodal.covered[i] && nodal.pressure[i] > NO_PRESSURE * largest);

    label[i] = joins || StatusIsContact(nodal.status[i]) ? (PetscReal)level->node_global[i] : -1;
  }
  PetscCall(VecRestoreArray(labels, &label));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscCall(LevelShareVec(labels, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The label of a patch is the largest of its nodes. Collective. [in,out] labels - ghosted */
static PetscErrorCode PatchSpreadLabels_Private(Level *level, const Facets *facets, Vec labels)
{
  PetscBool    changed = PETSC_TRUE;
  PetscInt    *parent;
  PetscScalar *label;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes, &parent));
  for (PetscInt round = 0; changed; round++) {
    PetscCall(GhostedGetArray(labels, &label));
    if (round == 0) PatchJoinFacets_Private(facets, level->num_nodes, label, parent);
    changed = PETSC_FALSE;
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      const PetscInt root = DisjointSetsFind(parent, i);

      if (PetscRealPart(label[i]) <= PetscRealPart(label[root])) continue;
      label[root] = label[i];
      changed     = PETSC_TRUE;
    }
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      const PetscInt root = DisjointSetsFind(parent, i);

      if (label[i] == label[root]) continue;
      label[i] = label[root];
      changed  = PETSC_TRUE;
    }
    PetscCall(GhostedRestoreArray(labels, &label));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPIU_BOOL, MPI_LOR, level->comm));
    if (changed) PetscCall(LevelShareVec(labels, MAX_VALUES));
  }
  PetscCall(PetscFree(parent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The labels of all ranks in ascending order, each once. Collective. [in] mine - in any order, sorted here;
   [out] all - owned by the caller */
static PetscErrorCode PatchGatherLabels_Private(MPI_Comm comm, PetscInt n, PetscInt mine[], PetscInt *num,
                                                PetscInt **all)
{
  PetscMPIInt size, count, *counts, *begin;

  PetscFunctionBeginUser;
  PetscCall(PetscSortRemoveDupsInt(&n, mine));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size + 1, &begin));
  count = (PetscMPIInt)n;
  PetscCallMPI(MPI_Allgather(&count, 1, MPI_INT, counts, 1, MPI_INT, comm));
  begin[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) begin[r + 1] = begin[r] + counts[r];
  *num = begin[size];
  PetscCall(PetscMalloc1(*num, all));
  PetscCallMPI(MPI_Allgatherv(mine, count, MPIU_INT, *all, counts, begin, MPIU_INT, comm));
  PetscCall(PetscSortRemoveDupsInt(num, *all));
  PetscCall(PetscFree2(counts, begin));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscBool PatchIsRow_Private(Fields fields, PetscInt p, PetscInt r)
{
  return (PetscBool)(fields->vi->row_pair[r] == p && fields->vi->row_direction[r] == 0 &&
                     StatusIsContact(fields->row_status[r]));
}

/* Numbers the patches that have a row, in the order of their labels. Collective. [out] nodes - patch of each
   local node */
static PetscErrorCode PatchNumber_Private(Vec labels, PatchNodes *nodes, ContactPatches *patches)
{
  const Fields       fields = nodes->fields;
  const PetscInt     p      = nodes->p;
  const VI           vi     = fields->vi;
  PetscInt           num    = 0, *mine, *all;
  const PetscScalar *label;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(vi->num_rows, &mine));
  PetscCall(GhostedGetArrayRead(labels, &label));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (PatchIsRow_Private(fields, p, r))
      mine[num++] = (PetscInt)PetscRealPart(label[vi->pairs[p]->nodes[vi->row_node[r]]]);
  }
  PetscCall(PatchGatherLabels_Private(vi->level->comm, num, mine, &patches->num, &all));
  for (PetscInt i = 0; i < vi->level->num_nodes; i++) {
    nodes->patch[i] = -1;
    if (PetscRealPart(label[i]) < 0) continue;
    PetscCall(PetscFindInt((PetscInt)PetscRealPart(label[i]), patches->num, all, &nodes->patch[i]));
    if (nodes->patch[i] < 0) nodes->patch[i] = -1;
  }
  PetscCall(GhostedRestoreArrayRead(labels, &label));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    patches->row_patch[r] = PatchIsRow_Private(fields, p, r) ? nodes->patch[vi->pairs[p]->nodes[vi->row_node[r]]] : -1;
  PetscCall(PetscCalloc1(patches->num, &patches->patch));
  PetscCall(PetscFree(all));
  PetscCall(PetscFree(mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The patch of a row; rows of tangents stand behind the normal row of their node. */
static PetscInt PatchOfRow_Private(VI vi, const ContactPatches *patches, PetscInt r)
{
  while (vi->row_direction[r]) r--;
  return patches->row_patch[r];
}

/* Area, forces and centroids. Collective. */
static PetscErrorCode PatchSumForces_Private(Fields fields, PetscInt p, ContactPatches *patches)
{
  const VI         vi  = fields->vi;
  const PetscInt   dim = vi->level->dim;
  PetscReal       *sums, *most;
  const PetscReal *lambda;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(patches->num * ROW_SUMS, &sums, patches->num, &most));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal weight = fields->row_weight[r], *d;
    const PetscInt  at     = PatchOfRow_Private(vi, patches, r);
    PetscReal      *sum;

    if (at < 0) continue;
    d   = &vi->pairs[p]->frame[(vi->row_node[r] * dim + vi->row_direction[r]) * dim];
    sum = &sums[at * ROW_SUMS];
    for (PetscInt k = 0; k < dim; k++) sum[ROW_FORCE + k] -= lambda[r] * weight * d[k];
    if (vi->row_direction[r]) continue; // tangents only have a force
    sum[ROW_NODES] += 1;
    sum[ROW_AREA] += weight;
    sum[ROW_NORMAL] += lambda[r] * weight;
    for (PetscInt k = 0; k < dim; k++) sum[ROW_CENTRE + k] += fields->row_moment[r * dim + k];
    most[at] = PetscMax(most[at], lambda[r]);
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * ROW_SUMS), MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, (PetscMPIInt)patches->num, MPIU_REAL, MPI_MAX, vi->level->comm));
  for (PetscInt i = 0; i < patches->num; i++) {
    const PetscReal *sum   = &sums[i * ROW_SUMS];
    ContactPatch    *patch = &patches->patch[i];

    patch->nodes         = (PetscInt)sum[ROW_NODES];
    patch->area          = sum[ROW_AREA];
    patch->normal_force  = sum[ROW_NORMAL];
    patch->max_pressure  = most[i];
    patch->mean_pressure = sum[ROW_NORMAL] / sum[ROW_AREA];
    for (PetscInt k = 0; k < dim; k++) {
      patch->force[k]  = sum[ROW_FORCE + k];
      patch->centre[k] = sum[ROW_CENTRE + k] / sum[ROW_AREA];
    }
    if (vi->scene->model == MODEL_AXISYMMETRIC) patch->force[0] = 0; /* the resultant of a ring acts along its axis */
  }
  PetscCall(PetscFree2(sums, most));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moments of the forces about the centroids: each row's force acts at the centroid of its dual function.
   Collective. */
static PetscErrorCode PatchSumMoments_Private(Fields fields, PetscInt p, ContactPatches *patches)
{
  const VI         vi  = fields->vi;
  const PetscInt   dim = vi->level->dim;
  const PetscReal *lambda;
  PetscReal       *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(patches->num * 3, &sums));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt   at = PatchOfRow_Private(vi, patches, r);
    const PetscReal *d;
    PetscReal        arm[3] = {0}, force[3] = {0}, moment[3];

    if (at < 0) continue;
    d = &vi->pairs[p]->frame[(vi->row_node[r] * dim + vi->row_direction[r]) * dim];
    for (PetscInt k = 0; k < dim; k++) {
      arm[k]   = fields->row_moment[r * dim + k] - fields->row_weight[r] * patches->patch[at].centre[k];
      force[k] = -lambda[r] * d[k];
    }
    VectorCross(arm, force, moment);
    for (PetscInt k = 0; k < 3; k++) sums[at * 3 + k] += moment[k];
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * 3), MPIU_REAL, MPI_SUM, vi->level->comm));
  for (PetscInt i = 0; i < patches->num; i++) {
    PetscCall(PetscArraycpy(patches->patch[i].moment, &sums[i * 3], 3));
    if (dim == 2) patches->patch[i].moment[0] = sums[i * 3 + 2];
    if (vi->scene->model == MODEL_AXISYMMETRIC) patches->patch[i].moment[0] = NAN;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The points of a facet up to which its node i is the nearest: on the way to its other nodes. Of two ends of
   a quadratic facet that is a quarter, since a middle node lies between them. [out] q - [nodes of the
   facet][dim] */
static PetscInt PatchGetPoints_Private(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscReal q[])
{
  const ElementType type = facets->type[f];
  const PetscInt    dim = level->dim, num = ElementNumNodes(type), ends = ElementNumNodes(ElementLinear(type));
  const PetscReal  *x = &level->coords[facets->nodes[f * F + i] * dim];

  for (PetscInt j = 0; j < num; j++) {
    const PetscReal *y     = &level->coords[facets->nodes[f * F + j] * dim];
    const PetscReal  share = num > ends && i < ends && j < ends ? 0.25 : 0.5;

    for (PetscInt k = 0; k < dim; k++) q[j * dim + k] = x[k] + share * (y[k] - x[k]);
  }
  return num;
}

/* Length or area of a facet. */
static PetscReal PatchGetFacetSize_Private(const Level *level, const Facets *facets, PetscInt f)
{
  const PetscInt dim = level->dim;
  PetscReal      X[3 * F], xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], size = 0;
  const PetscInt num = QuadratureRule(facets->type[f], SIZE_DEGREE, xi, w);

  VectorGather(dim, ElementNumNodes(facets->type[f]), &facets->nodes[f * F], level->coords, X);
  for (PetscInt q = 0; q < num; q++)
    size += w[q] * ElementSurface(facets->type[f], X, &xi[q * (dim - 1)], NULL, phi, NULL);
  return size;
}

/* Principal axes of one patch from its second moments. [in] sums - of its points; [out] patch - axis */
static void PatchSetAxes_Private(PetscInt dim, const PetscReal sums[], ContactPatch *patch)
{
  PetscReal A[9], values[3], V[9], first, second;
  PetscInt  order[3] = {0, 1, 2};

  for (PetscInt k = 0; k < dim * dim; k++) {
    A[k] = sums[POINT_SECOND + k] / sums[POINT_SIZE] -
           sums[POINT_FIRST + k / dim] * sums[POINT_FIRST + k % dim] / PetscSqr(sums[POINT_SIZE]);
  }
  DenseEigen(dim, A, values, V);
  for (PetscInt i = 0; i < dim; i++) {
    for (PetscInt j = 0; j + 1 < dim; j++) {
      if (values[order[j]] >= values[order[j + 1]]) continue;
      const PetscInt swap = order[j];

      order[j]     = order[j + 1];
      order[j + 1] = swap;
    }
  }
  for (PetscInt a = 0; a < dim - 1; a++) {
    for (PetscInt k = 0; k < dim; k++) patch->axis[a][k] = V[k * dim + order[a]];
  }
  first        = values[order[0]];
  second       = values[order[1]];
  patch->bent  = (PetscBool)(dim == 3 && patch->nodes >= BENT_NODES &&
                            patch->area < BENT_FILL * 4 * PETSC_PI * PetscSqrtReal(first * second));
  patch->width = 0;
  if (dim == 3 && first - second < ROUND * first) { /* any axis across the third: the one nearest to a coordinate's */
    PetscReal      n[3], dot;
    const PetscInt along = PetscAbsReal(V[order[2]]) > PetscSqrtReal(0.5) ? 1 : 0;

    for (PetscInt k = 0; k < 3; k++) n[k] = V[k * 3 + order[2]];
    dot = n[along];
    for (PetscInt k = 0; k < 3; k++) patch->axis[0][k] = (k == along) - dot * n[k];
    FrameNormalize(3, patch->axis[0]);
    VectorCross(n, patch->axis[0], patch->axis[1]);
    patch->width = ELLIPSE_WIDTH * PetscSqrtReal(second);
  }
  for (PetscInt a = 0; a < dim - 1; a++) {
    PetscInt  largest = 0;
    PetscReal sign;

    for (PetscInt k = 1; k < dim; k++) {
      if (PetscAbsReal(patch->axis[a][k]) > PetscAbsReal(patch->axis[a][largest]) + SAME_PATCH) largest = k;
    }
    sign = patch->axis[a][largest] < 0 ? -1 : 1;
    for (PetscInt k = 0; k < dim; k++) patch->axis[a][k] *= sign;
  }
}

/* Principal axes of the patches: second moments of the points that their nodes stand for. Collective. */
static PetscErrorCode PatchFindAxes_Private(const PatchNodes *nodes, ContactPatches *patches)
{
  const Level   *level = nodes->fields->vi->level;
  const PetscInt dim   = level->dim;
  PetscReal     *sums, q[3 * F];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(patches->num * POINT_SUMS, &sums));
  for (PetscInt f = 0; f < nodes->facets.num; f++) {
    const PetscInt  n    = ElementNumNodes(nodes->facets.type[f]);
    const PetscReal size = PatchGetFacetSize_Private(level, &nodes->facets, f);

    for (PetscInt i = 0; i < n; i++) {
      const PetscInt at = nodes->patch[nodes->facets.nodes[f * F + i]];
      PetscReal     *sum;

      if (at < 0) continue;
      sum = &sums[at * POINT_SUMS];
      (void)PatchGetPoints_Private(level, &nodes->facets, f, i, q);
      for (PetscInt j = 0; j < n; j++) {
        for (PetscInt k = 0; k < dim; k++) q[j * dim + k] -= patches->patch[at].centre[k];
        sum[POINT_SIZE] += size;
        for (PetscInt k = 0; k < dim; k++) sum[POINT_FIRST + k] += size * q[j * dim + k];
        for (PetscInt k = 0; k < dim * dim; k++)
          sum[POINT_SECOND + k] += size * q[j * dim + k / dim] * q[j * dim + k % dim];
      }
    }
  }
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * POINT_SUMS), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt i = 0; i < patches->num; i++) PatchSetAxes_Private(dim, &sums[i * POINT_SUMS], &patches->patch[i]);
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The part of a line facet that a node stands for. */
static PetscReal PatchGetShare_Private(PetscInt num_nodes, PetscInt i)
{
  return num_nodes == 2 || i == 2 ? 0.5 : 0.25;
}

/* Adds a facet to the ranges and sums of a patch along its axes.
   [in,out] range - RANGES; sums - FACET_SUMS */
static void PatchMeasureFacet_Private(const PatchNodes *nodes, PetscInt f, PetscInt at, const ContactPatch *patch,
                                      PetscReal range[], PetscReal sums[])
{
  const Level   *level = nodes->fields->vi->level;
  const PetscInt dim = level->dim, n = ElementNumNodes(nodes->facets.type[f]);
  PetscReal      q[3 * F];

  for (PetscInt a = 0; a < dim - 1; a++) {
    PetscReal lower = PETSC_MAX_REAL, upper = -PETSC_MAX_REAL;

    for (PetscInt i = 0; i < n; i++) {
      const PetscInt  node = nodes->facets.nodes[f * F + i];
      const PetscReal s    = VectorDot(dim, patch->axis[a], &level->coords[node * dim]);

      lower = PetscMin(lower, s);
      upper = PetscMax(upper, s);
      if (nodes->patch[node] != at) continue;
      (void)PatchGetPoints_Private(level, &nodes->facets, f, i, q);
      for (PetscInt j = 0; j < n; j++) {
        const PetscReal t = VectorDot(dim, patch->axis[a], &q[j * dim]);

        range[RANGE_UPPER + a] = PetscMax(range[RANGE_UPPER + a], t);
        range[RANGE_LOWER + a] = PetscMax(range[RANGE_LOWER + a], -t);
      }
      if (dim == 2) sums[FACET_SHARE] += PatchGetShare_Private(n, i);
    }
    sums[FACET_LENGTH + a] += upper - lower;
  }
  VectorGather(dim, n, &nodes->facets.nodes[f * F], level->coords, q);
  sums[FACET_SHORTEST] += ElementShortestEdge(ElementLinear(nodes->facets.type[f]), dim, q);
  sums[FACET_COUNT] += 1;
}

static void PatchSwap_Private(PetscReal *a, PetscReal *b)
{
  const PetscReal swap = *a;

  *a = *b;
  *b = swap;
}

/* The width in facets. The length of a strip that is bent to at most half a circle is nearly a diagonal: that
   of its first extent and twice its second one. Facets lie along it or across it: their shortest edges
   count.
   [in] sums - FACET_SUMS; [in,out] patch - with its extents */
static void PatchSetAcross_Private(PetscInt dim, const PetscReal sums[], ContactPatch *patch)
{
  const PetscReal *lengths = &sums[FACET_LENGTH];

  patch->across     = patch->extent[dim - 2];
  patch->facet_size = lengths[dim - 2] / sums[FACET_COUNT];
  if (patch->bent) {
    patch->across     = patch->area / PetscSqrtReal(PetscSqr(patch->extent[0]) + PetscSqr(2 * patch->extent[1]));
    patch->facet_size = sums[FACET_SHORTEST] / sums[FACET_COUNT];
  }
  patch->facets = dim == 2 ? sums[FACET_SHARE] : patch->across / patch->facet_size;
}

/* Extents along the axes, and the width in facets. In a plane these are counted, since a patch may go round a
   corner. Collective. */
static PetscErrorCode PatchMeasure_Private(const PatchNodes *nodes, ContactPatches *patches)
{
  const MPI_Comm comm = nodes->fields->vi->level->comm;
  const PetscInt dim  = nodes->fields->vi->level->dim;
  PetscReal     *range, *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(patches->num * RANGES, &range, patches->num * FACET_SUMS, &sums));
  for (PetscInt i = 0; i < patches->num * RANGES; i++) range[i] = -PETSC_MAX_REAL;
  for (PetscInt f = 0; f < nodes->facets.num; f++) {
    PetscInt before[F], num = 0;

    for (PetscInt i = 0; i < ElementNumNodes(nodes->facets.type[f]); i++) {
      const PetscInt at = nodes->patch[nodes->facets.nodes[f * F + i]];
      PetscBool new     = (PetscBool)(at >= 0);

      for (PetscInt j = 0; j < num; j++) new = (PetscBool)(new &&before[j] != at);
      if (!new) continue;
      before[num++] = at;
      PatchMeasureFacet_Private(nodes, f, at, &patches->patch[at], &range[at * RANGES], &sums[at * FACET_SUMS]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, (PetscMPIInt)(patches->num * RANGES), MPIU_REAL, MPI_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * FACET_SUMS), MPIU_REAL, MPI_SUM, comm));
  for (PetscInt i = 0; i < patches->num; i++) {
    ContactPatch *patch = &patches->patch[i];

    for (PetscInt a = 0; a < dim - 1; a++)
      patch->extent[a] = range[i * RANGES + RANGE_UPPER + a] + range[i * RANGES + RANGE_LOWER + a];
    if (dim == 3 && patch->extent[1] > patch->extent[0]) { /* second moments need not come in the order of lengths */
      for (PetscInt k = 0; k < 3; k++) PatchSwap_Private(&patch->axis[0][k], &patch->axis[1][k]);
      PatchSwap_Private(&patch->extent[0], &patch->extent[1]);
      PatchSwap_Private(&sums[i * FACET_SUMS + FACET_LENGTH], &sums[i * FACET_SUMS + FACET_LENGTH + 1]);
    }
    if (patch->width == 0) patch->width = patch->extent[dim - 2];
    PatchSetAcross_Private(dim, &sums[i * FACET_SUMS], patch);
  }
  PetscCall(PetscFree2(range, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a patch comes before another. */
static PetscBool PatchComesFirst_Private(const ContactPatch *a, const ContactPatch *b)
{
  const PetscReal force = PetscMax(a->normal_force, b->normal_force);
  PetscReal       size  = 0;

  if (PetscAbsReal(a->normal_force - b->normal_force) > SAME_PATCH * force)
    return (PetscBool)(a->normal_force > b->normal_force);
  for (PetscInt k = 0; k < 3; k++) size = PetscMax(size, PetscAbsReal(a->centre[k] - b->centre[k]));
  for (PetscInt k = 0; k < 3; k++) {
    if (PetscAbsReal(a->centre[k] - b->centre[k]) > SAME_PATCH * size) return (PetscBool)(a->centre[k] < b->centre[k]);
  }
  return PETSC_FALSE;
}

/* By falling force. */
static PetscErrorCode PatchSort_Private(PetscInt num_rows, ContactPatches *patches)
{
  PetscInt     *order, *place;
  ContactPatch *sorted;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(patches->num, &order, patches->num, &place, patches->num, &sorted));
  for (PetscInt i = 0; i < patches->num; i++) {
    PetscInt j = i;

    for (; j > 0 && PatchComesFirst_Private(&patches->patch[i], &patches->patch[order[j - 1]]); j--)
      order[j] = order[j - 1];
    order[j] = i;
  }
  for (PetscInt i = 0; i < patches->num; i++) {
    sorted[i]       = patches->patch[order[i]];
    place[order[i]] = i;
  }
  PetscCall(PetscArraycpy(patches->patch, sorted, patches->num));
  for (PetscInt r = 0; r < num_rows; r++) {
    if (patches->row_patch[r] >= 0) patches->row_patch[r] = place[patches->row_patch[r]];
  }
  PetscCall(PetscFree3(order, place, sorted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactPatchesCreate(Fields fields, PetscInt p, ContactPatches *patches)
{
  const VI         vi    = fields->vi;
  const ScenePair *spec  = vi->pairs[p]->spec;
  PatchNodes       nodes = {.fields = fields, .p = p};
  Vec              labels;

  PetscFunctionBeginUser;
  *patches = (ContactPatches){0};
  PetscCall(PetscMalloc1(vi->num_rows, &patches->row_patch));
  for (PetscInt r = 0; r < vi->num_rows; r++) patches->row_patch[r] = -1;
  if (spec->type == PAIR_TIED || !fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelGetFacets(vi->level, vi->scene, spec->nonmortar.body, spec->nonmortar.side, &nodes.facets));
  PetscCall(PetscMalloc1(vi->level->num_nodes, &nodes.patch));
  PetscCall(LevelCreateVec(vi->level, 1, &labels));
  PetscCall(PatchSetLabels_Private(fields, p, labels));
  PetscCall(PatchSpreadLabels_Private(vi->level, &nodes.facets, labels));
  PetscCall(PatchNumber_Private(labels, &nodes, patches));
  if (patches->num) {
    PetscCall(PatchSumForces_Private(fields, p, patches));
    PetscCall(PatchSumMoments_Private(fields, p, patches));
    PetscCall(PatchFindAxes_Private(&nodes, patches));
    PetscCall(PatchMeasure_Private(&nodes, patches));
    PetscCall(PatchSort_Private(vi->num_rows, patches));
  }
  PetscCall(VecDestroy(&labels));
  PetscCall(PetscFree(nodes.patch));
  PetscCall(FacetsDestroy(&nodes.facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactPatchesDestroy(ContactPatches *patches)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(patches->patch));
  PetscCall(PetscFree(patches->row_patch));
  patches->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}
