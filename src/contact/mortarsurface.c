/* mortarsurface.c -- candidates: the mortar facets near this rank's nonmortar facets, in a box tree.

   No rank has a whole side. Each rank sends a few boxes around its nonmortar facets to all others; a mortar
   facet is sent to the ranks whose boxes it meets. Facets of the own rank come first, then those of others in
   the order of ranks. Sums over them depend on the partition in the last digits only.

   A query is for the rays of one nonmortar facet. They fill a tube along the facet's normals that is as long
   as the reach and hardly wider than the facet. A box around an inclined tube would contain more and more
   facets as these get smaller; slabs along and across the tube do not. */
#include "base/compat.h"
#include "contact/contactfacet.h"
#include "contact/mortarsurface.h"
#include "kernel/frame.h"
#include "kernel/rise.h"
#include "kernel/vector.h"

/* Boxes around the nonmortar facets of one rank. Most of one box around a curved side would be empty, and
   facets in its volume would be sent without need. */
enum { COVER_BOXES = 16 };

/* A query is wider by this share of the facet and the reach: roundoff must not omit facets at the ends. */
static const PetscReal QUERY_SLACK = 1e-8;

/* The boxes of all ranks. */
typedef struct {
  BoxTree      tree;
  PetscInt     num;
  PetscMPIInt *rank; /* ascending [num] */
} Covers;

/* A facet that is sent between ranks. */
typedef struct {
  PetscInt  type, cell, material, nodes[ELEMENT_MAX_FACET_NODES]; /* global */
  PetscReal coords[3 * ELEMENT_MAX_FACET_NODES];
  PetscReal normals[3 * ELEMENT_MAX_FACET_NODES], curvature[9 * ELEMENT_MAX_FACET_NODES];
  PetscReal rises[3 * RISE_TERMS];
} FacetRecord;

/* The mortar side of this rank. */
typedef struct {
  const Level     *level;
  const Facets    *facets;
  const SideShape *shape; /* may be NULL */
  const PetscReal *rises; /* of SmoothGapCreate(), may be NULL */
  PetscInt         first; /* cell of this rank, counted over all ranks */
} Side;

/* A tree over the boxes around all facets of a list. [in] coords - [num][ELEMENT_MAX_FACET_NODES][dim] */
static PetscErrorCode MortarSurfaceCreateTree_Private(PetscInt dim, PetscInt num, const ElementType type[],
                                                      const PetscReal coords[], BoxTree *tree)
{
  PetscReal *boxes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * dim * num, &boxes));
  for (PetscInt f = 0; f < num; f++)
    ContactFacetBox(dim, type[f], &coords[f * ELEMENT_MAX_FACET_NODES * dim], &boxes[2 * f * dim]);
  PetscCall(BoxTreeCreate(dim, num, boxes, tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A few boxes that contain this rank's facets and all points within reach of them. Not collective.
   [out] boxes - [COVER_BOXES][2][dim], the first *num of them are set */
static PetscErrorCode MortarSurfaceCoverFacets_Private(const Level *level, const Facets *facets, PetscReal reach,
                                                       PetscInt *num, PetscReal boxes[])
{
  const PetscInt   dim = level->dim;
  PetscReal       *coords;
  const PetscReal *cover;
  BoxTree          tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(facets->num * ELEMENT_MAX_FACET_NODES * dim, &coords));
  for (PetscInt f = 0; f < facets->num; f++)
    ContactFacetCoordinates(level, facets, f, &coords[f * ELEMENT_MAX_FACET_NODES * dim]);
  PetscCall(MortarSurfaceCreateTree_Private(dim, facets->num, facets->type, coords, &tree));
  PetscCall(PetscFree(coords));
  PetscCall(BoxTreeGetCover(tree, COVER_BOXES, num, &cover));
  for (PetscInt b = 0; b < *num; b++) {
    for (PetscInt k = 0; k < dim; k++) {
      boxes[2 * b * dim + k]       = cover[2 * b * dim + k] - reach;
      boxes[(2 * b + 1) * dim + k] = cover[(2 * b + 1) * dim + k] + reach;
    }
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers the boxes of all ranks on all ranks. Collective. */
static PetscErrorCode MortarSurfaceCoversCreate_Private(const Level *level, const Facets *facets, PetscReal reach,
                                                        Covers *covers)
{
  const PetscInt dim = level->dim, length = COVER_BOXES * 2 * dim;
  PetscReal     *mine, *all;
  PetscInt       num, *nums;
  PetscMPIInt    size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCall(PetscMalloc3(size, &nums, length, &mine, size * length, &all));
  PetscCall(PetscMalloc1(size * COVER_BOXES, &covers->rank));
  PetscCall(PetscArrayzero(mine, length));
  PetscCall(MortarSurfaceCoverFacets_Private(level, facets, reach, &num, mine));
  PetscCallMPI(MPI_Allgather(&num, 1, MPIU_INT, nums, 1, MPIU_INT, level->comm));
  PetscCallMPI(MPI_Allgather(mine, (PetscMPIInt)length, MPIU_REAL, all, (PetscMPIInt)length, MPIU_REAL, level->comm));
  covers->num = 0;
  for (PetscMPIInt r = 0; r < size; r++) {
    for (PetscInt b = 0; b < nums[r]; b++) {
      PetscCall(PetscArraymove(&all[covers->num * 2 * dim], &all[(r * COVER_BOXES + b) * 2 * dim], 2 * dim));
      covers->rank[covers->num++] = r;
    }
  }
  PetscCall(BoxTreeCreate(dim, covers->num, all, &covers->tree));
  PetscCall(PetscFree3(nums, mine, all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MortarSurfaceCoversDestroy_Private(Covers *covers)
{
  PetscFunctionBeginUser;
  PetscCall(BoxTreeDestroy(&covers->tree));
  PetscCall(PetscFree(covers->rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The ranks that may meet a mortar facet, each once. Not collective.
   [out] ranks - ascending [*num], room for all */
static PetscErrorCode MortarSurfaceFindRanks_Private(const Covers *covers, PetscInt dim, const FacetRecord *record,
                                                     PetscInt *num, PetscMPIInt ranks[])
{
  PetscReal       box[6];
  PetscInt        num_hits;
  const PetscInt *hits;

  PetscFunctionBeginUser;
  ContactFacetBox(dim, (ElementType)record->type, record->coords, box);
  PetscCall(BoxTreeQuery(covers->tree, box, &num_hits, &hits));
  *num = 0;
  for (PetscInt h = 0; h < num_hits; h++) {
    if (*num == 0 || ranks[*num - 1] != covers->rank[hits[h]]) ranks[(*num)++] = covers->rank[hits[h]];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void MortarSurfacePackFacet_Private(const Side *side, PetscInt f, FacetRecord *record)
{
  const Level   *level  = side->level;
  const Facets  *facets = side->facets;
  const PetscInt dim    = level->dim;

  record->type     = facets->type[f];
  record->cell     = side->first + facets->cell[f];
  record->material = level->cell_material[facets->cell[f]];
  for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
    record->nodes[i] = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
  ContactFacetCoordinates(level, facets, f, record->coords);
  for (PetscInt i = 0; i < ELEMENT_MAX_FACET_NODES * dim && side->shape; i++)
    record->normals[i] = side->shape->normal[f * ELEMENT_MAX_FACET_NODES * dim + i];
  for (PetscInt i = 0; i < ELEMENT_MAX_FACET_NODES * dim * dim && side->shape; i++)
    record->curvature[i] = side->shape->curvature[f * ELEMENT_MAX_FACET_NODES * dim * dim + i];
  for (PetscInt i = 0; i < RISE_TERMS * dim && side->rises; i++)
    record->rises[i] = side->rises[f * RISE_TERMS * dim + i];
}

/* Appends a facet; the arrays have room for it. */
static void MortarSurfaceAddFacet_Private(PetscInt dim, const FacetRecord *record, MortarSurface *surface)
{
  const PetscInt f = surface->num++, n = ElementNumNodes((ElementType)record->type);

  surface->type[f]     = (ElementType)record->type;
  surface->cell[f]     = record->cell;
  surface->material[f] = record->material;
  for (PetscInt i = 0; i < n; i++) surface->nodes[f * ELEMENT_MAX_FACET_NODES + i] = record->nodes[i];
  for (PetscInt i = 0; i < n * dim; i++) surface->coords[f * ELEMENT_MAX_FACET_NODES * dim + i] = record->coords[i];
  for (PetscInt i = 0; i < n * dim; i++) surface->normals[f * ELEMENT_MAX_FACET_NODES * dim + i] = record->normals[i];
  for (PetscInt i = 0; i < n * dim * dim; i++)
    surface->curvature[f * ELEMENT_MAX_FACET_NODES * dim * dim + i] = record->curvature[i];
  for (PetscInt i = 0; i < RISE_TERMS * dim && surface->rises; i++)
    surface->rises[f * RISE_TERMS * dim + i] = record->rises[i];
}

/* Facets that are sent between this rank and others. */
typedef struct {
  PetscMPIInt  size, rank; /* of and in the communicator */
  PetscInt    *start;      /* of each rank's part of leaving, empty for this rank's own [size+1] */
  FacetRecord *leaving;
  PetscInt     num_staying, num_arriving;
  PetscMPIInt  num_from;
  PetscMPIInt *from;  /* ranks that send, ascending [num_from] */
  PetscInt    *count; /* number of their facets [num_from] */
} Traffic;

/* Counts the facets between ranks. Collective. */
static PetscErrorCode MortarSurfaceTrafficPlan_Private(const Side *side, const Covers *covers, Traffic *traffic)
{
  const Level *level  = side->level;
  FacetRecord  record = {0};
  PetscInt     num, *start, *count;
  PetscMPIInt *ranks, num_to = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &traffic->size));
  PetscCallMPI(MPI_Comm_rank(level->comm, &traffic->rank));
  PetscCall(PetscCalloc1(traffic->size + 1, &traffic->start));
  PetscCall(PetscMalloc2(traffic->size, &ranks, traffic->size, &count));
  start                = traffic->start;
  traffic->num_staying = traffic->num_arriving = 0;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    MortarSurfacePackFacet_Private(side, f, &record);
    PetscCall(MortarSurfaceFindRanks_Private(covers, side->level->dim, &record, &num, ranks));
    for (PetscInt i = 0; i < num; i++) {
      if (ranks[i] == traffic->rank)
        traffic->num_staying++;
      else
        start[ranks[i] + 1]++;
    }
  }
  for (PetscMPIInt r = 0; r < traffic->size; r++) {
    if (start[r + 1]) {
      ranks[num_to]   = r;
      count[num_to++] = start[r + 1];
    }
    start[r + 1] += start[r];
  }
  PetscCall(PetscCommBuildTwoSided(level->comm, 1, MPIU_INT, num_to, ranks, count, &traffic->num_from, &traffic->from,
                                   &traffic->count));
  PetscCall(PetscSortMPIIntWithIntArray(traffic->num_from, traffic->from, traffic->count));
  for (PetscMPIInt i = 0; i < traffic->num_from; i++) traffic->num_arriving += traffic->count[i];
  PetscCall(PetscFree2(ranks, count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds facets of this rank to the surface, and packs those for other ranks. Not collective. */
static PetscErrorCode MortarSurfaceTrafficLoad_Private(const Side *side, const Covers *covers, Traffic *traffic,
                                                       MortarSurface *surface)
{
  PetscInt    *next, num;
  PetscMPIInt *ranks;
  FacetRecord  record = {0};

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(traffic->size, &next, traffic->size, &ranks));
  PetscCall(PetscArraycpy(next, traffic->start, traffic->size));
  PetscCall(PetscMalloc1(traffic->start[traffic->size], &traffic->leaving));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    MortarSurfacePackFacet_Private(side, f, &record);
    PetscCall(MortarSurfaceFindRanks_Private(covers, side->level->dim, &record, &num, ranks));
    for (PetscInt i = 0; i < num; i++) {
      if (ranks[i] == traffic->rank)
        MortarSurfaceAddFacet_Private(side->level->dim, &record, surface);
      else
        traffic->leaving[next[ranks[i]]++] = record;
    }
  }
  PetscCall(PetscFree2(next, ranks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sends and receives facets, and adds the received ones to the surface. Collective. */
static PetscErrorCode MortarSurfaceTrafficRun_Private(const Level *level, Traffic *traffic, MortarSurface *surface)
{
  MPI_Comm     comm;
  MPI_Datatype type;
  MPI_Request *requests;
  PetscMPIInt  tag, num_requests = 0;
  FacetRecord *arriving;

  PetscFunctionBeginUser;
  PetscCall(PetscCommDuplicate(level->comm, &comm, &tag));
  PetscCallMPI(MPI_Type_contiguous((PetscMPIInt)sizeof(FacetRecord), MPI_BYTE, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCall(PetscMalloc2(traffic->num_arriving, &arriving, traffic->num_from + traffic->size, &requests));
  for (PetscInt i = 0, begin = 0; i < traffic->num_from; begin += traffic->count[i++]) {
    PetscCallMPI(MPI_Irecv(&arriving[begin], (PetscMPIInt)traffic->count[i], type, traffic->from[i], tag, comm,
                           &requests[num_requests++]));
  }
  for (PetscMPIInt r = 0; r < traffic->size; r++) {
    const PetscInt begin = traffic->start[r], count = traffic->start[r + 1] - begin;
    if (count) {
      PetscCallMPI(
          MPI_Isend(&traffic->leaving[begin], (PetscMPIInt)count, type, r, tag, comm, &requests[num_requests++]));
    }
  }
  PetscCallMPI(MPI_Waitall(num_requests, requests, MPI_STATUSES_IGNORE));
  for (PetscInt f = 0; f < traffic->num_arriving; f++) MortarSurfaceAddFacet_Private(level->dim, &arriving[f], surface);
  PetscCall(PetscFree2(arriving, requests));
  PetscCallMPI(MPI_Type_free(&type));
  PetscCall(PetscCommDestroy(&comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MortarSurfaceTrafficDestroy_Private(Traffic *traffic)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(traffic->start));
  PetscCall(PetscFree(traffic->leaving));
  PetscCall(PetscFree(traffic->from));
  PetscCall(PetscFree(traffic->count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceCreate(Level *level, const Facets *nonmortar, const Facets *mortar, const SideShape *shape,
                                   const PetscReal rises[], PetscReal reach, MortarSurface *surface)
{
  const PetscInt dim  = level->dim;
  Side           side = {level, mortar, shape, rises, 0};
  Covers         covers;
  Traffic        traffic;
  PetscInt       max;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Scan(&level->num_cells, &side.first, 1, MPIU_INT, MPI_SUM, level->comm));
  side.first -= level->num_cells;
  PetscCall(MortarSurfaceCoversCreate_Private(level, nonmortar, reach, &covers));
  PetscCall(MortarSurfaceTrafficPlan_Private(&side, &covers, &traffic));
  max            = traffic.num_staying + traffic.num_arriving;
  surface->num   = 0;
  surface->rises = NULL;
  PetscCall(PetscMalloc7(max, &surface->type, max, &surface->cell, max, &surface->material,
                         max * ELEMENT_MAX_FACET_NODES, &surface->nodes, max * ELEMENT_MAX_FACET_NODES * dim,
                         &surface->coords, max * ELEMENT_MAX_FACET_NODES * dim, &surface->normals,
                         max * ELEMENT_MAX_FACET_NODES * dim * dim, &surface->curvature));
  if (rises) PetscCall(PetscMalloc1(max * RISE_TERMS * dim, &surface->rises));
  PetscCall(MortarSurfaceTrafficLoad_Private(&side, &covers, &traffic, surface));
  PetscCall(MortarSurfaceCoversDestroy_Private(&covers));
  PetscCall(MortarSurfaceTrafficRun_Private(level, &traffic, surface));
  PetscCall(MortarSurfaceTrafficDestroy_Private(&traffic));
  PetscCall(MortarSurfaceCreateTree_Private(dim, surface->num, surface->type, surface->coords, &surface->tree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceUpdateTree(PetscInt dim, MortarSurface *surface)
{
  PetscFunctionBeginUser;
  PetscCall(BoxTreeDestroy(&surface->tree));
  PetscCall(MortarSurfaceCreateTree_Private(dim, surface->num, surface->type, surface->coords, &surface->tree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceDestroy(MortarSurface *surface)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree7(surface->type, surface->cell, surface->material, surface->nodes, surface->coords,
                       surface->normals, surface->curvature));
  PetscCall(PetscFree(surface->rises));
  PetscCall(BoxTreeDestroy(&surface->tree));
  surface->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Directions about a mean one. */
typedef struct {
  PetscReal mean[3], cosine; /* of the widest angle between them; 0 where it is a right one or more */
} Cone;

/* The cone of the normals, which is that of the Bezier points of their field. */
static Cone MortarSurfaceFindNormalCone_Private(PetscInt dim, ElementType type, const PetscReal N[])
{
  const PetscInt n    = ElementNumNodes(type);
  Cone           cone = {{0, 0, 0}, 1};
  PetscReal      hull[3 * ELEMENT_MAX_FACET_NODES];

  for (PetscInt i = 0; i < n * dim; i++) cone.mean[i % dim] += N[i];
  FrameNormalize(dim, cone.mean);
  ContactFacetHull(dim, type, N, hull);
  for (PetscInt i = 0; i < n; i++) {
    FrameNormalize(dim, &hull[i * dim]);
    cone.cosine = PetscMax(0, PetscMin(cone.cosine, VectorDot(dim, cone.mean, &hull[i * dim])));
  }
  return cone;
}

/* The largest component of unit vectors of the cone along a direction whose own component along the mean is
   given. */
static PetscReal MortarSurfaceConeComponent_Private(const Cone *cone, PetscReal along)
{
  const PetscReal a = PetscAbsReal(along), c = cone->cosine;

  if (a >= c) return 1; // the direction lies in the cone
  return a * c + PetscSqrtReal((1 - a * a) * (1 - c * c));
}

/* The range of direction . x over a facet, widened. [in] hull - [n][dim] */
static BoxSlab MortarSurfaceFindSlab_Private(PetscInt dim, PetscInt n, const PetscReal hull[],
                                             const PetscReal direction[], PetscReal margin)
{
  BoxSlab range = {.lower = PETSC_MAX_REAL, .upper = PETSC_MIN_REAL};

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal x = VectorDot(dim, direction, &hull[i * dim]);

    range.lower = PetscMin(range.lower, x);
    range.upper = PetscMax(range.upper, x);
  }
  for (PetscInt k = 0; k < dim; k++) range.direction[k] = direction[k];
  range.lower -= margin;
  range.upper += margin;
  return range;
}

PetscErrorCode MortarSurfaceQuery(const MortarSurface *surface, PetscInt dim, const ClipFacet *facet, PetscReal reach,
                                  PetscInt *num_hits, const PetscInt *hits[])
{
  const PetscInt  n         = ElementNumNodes(facet->type);
  const Cone      cone      = MortarSurfaceFindNormalCone_Private(dim, facet->type, facet->N);
  const PetscReal slack     = QUERY_SLACK * (reach + ElementLongestEdge(facet->type, dim, facet->X));
  PetscInt        num_slabs = 0;
  PetscReal       hull[3 * ELEMENT_MAX_FACET_NODES], Q[9], box[6];
  BoxSlab         slabs[3];

  PetscFunctionBeginUser;
  ContactFacetHull(dim, facet->type, facet->X, hull);
  for (PetscInt k = 0; k < dim; k++) {
    const PetscReal axis[3] = {k == 0, k == 1, k == 2};
    const BoxSlab   range   = MortarSurfaceFindSlab_Private(
            dim, n, hull, axis, MortarSurfaceConeComponent_Private(&cone, cone.mean[k]) * reach + slack);
    box[k]       = range.lower;
    box[dim + k] = range.upper;
  }
  if (cone.cosine > 0) {
    FrameFromNormal(dim, cone.mean, Q);
    for (; num_slabs < dim; num_slabs++) {
      const PetscReal along = num_slabs == 0 ? 1 : 0;
      slabs[num_slabs]      = MortarSurfaceFindSlab_Private(
               dim, n, hull, &Q[num_slabs * dim], MortarSurfaceConeComponent_Private(&cone, along) * reach + slack);
    }
  }
  PetscCall(BoxTreeQuerySlabs(surface->tree, box, num_slabs, slabs, num_hits, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceFetch(Vec u, PetscInt dim, PetscInt num, const PetscInt nodes[], PetscReal values[])
{
  IS                 from;
  Vec                here;
  VecScatter         scatter;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, dim, num, nodes, PETSC_USE_POINTER, &from));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num * dim, &here));
  PetscCall(VecScatterCreate(u, from, here, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, u, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, u, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(here, &value));
  for (PetscInt i = 0; i < num * dim; i++) values[i] = PetscRealPart(value[i]);
  PetscCall(VecRestoreArrayRead(here, &value));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&here));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(PETSC_SUCCESS);
}
