/* partition.c -- the partition: bodies that touch share ranks where they touch.

   METIS minimizes the weight of cut edges in the graph of cells. Cells of two bodies share no facet. So a
   plain partition of two equal bodies gives one body to each of two ranks: all contact is remote. Cells whose
   facets may touch are therefore joined by extra, heavier edges. These alone would give all contact to one
   rank, if that has room for it: contact is work, and is shared out as the cells are [1]. Edges across which
   cells are short are heavier too: there K couples strongly, and smoothers solve along lines that had better
   not end between ranks.

   Reference: [1] G. Karypis, V. Kumar, Multilevel algorithms for multi-constraint graph partitioning, 1998. */
#include "mesh/meshimpl.h"
#include "kernel/boxtree.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include <metis.h>
#include <petscsf.h>

enum {
  CONTACT_WEIGHT =
      5, /* of an edge across contact, against 1 across a facet: coupling of D and M and of the condensed rows */
  MAX_WEIGHT       = 10, /* of an edge across short cells: how many times longer they are at most */
  MIN_CELLS_A_PART = 4,  /* with fewer METIS is not asked */
  MAX_RECURSIVE    = 8   /* METIS's own advice: recursive bisection is better up to eight parts */
};

/* Weighted edges of the graph of cells, each once. */
typedef struct {
  PetscInt  num, max;
  PetscInt *end; /* [max][2] */
  PetscInt *weight;
} Edges;

/* How much more a part may have than its share. A mesh of few cells cannot share contact out evenly, and it
   is the smaller work. */
static const real_t TOLERANCE[PARTITION_MAX_WEIGHTS] = {1.02F, 1.1F};

/* Appends an edge; an edge from a cell to itself, where a body touches itself in a corner, says nothing. */
static PetscErrorCode EdgesAdd_Private(Edges *edges, PetscInt a, PetscInt b, PetscInt weight)
{
  PetscFunctionBeginUser;
  if (a == b) PetscFunctionReturn(PETSC_SUCCESS);
  if (edges->num == edges->max) {
    edges->max = PetscMax(1024, 2 * edges->max);
    PetscCall(PetscRealloc(edges->max * 2 * sizeof(PetscInt), &edges->end));
    PetscCall(PetscRealloc(edges->max * sizeof(PetscInt), &edges->weight));
  }
  edges->end[2 * edges->num]     = a;
  edges->end[2 * edges->num + 1] = b;
  edges->weight[edges->num++]    = weight;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscReal CellsGetDistance_Private(const Level *level, const PetscInt cells[2])
{
  PetscReal square = 0;

  for (PetscInt d = 0; d < level->dim; d++) {
    PetscReal x[2] = {0, 0};

    for (PetscInt k = 0; k < 2; k++) {
      const PetscInt begin = level->cell_start[cells[k]], end = level->cell_start[cells[k] + 1];

      for (PetscInt i = begin; i < end; i++)
        x[k] += level->coords[level->cell_nodes[i] * level->dim + d] / (PetscReal)(end - begin);
    }
    square += PetscSqr(x[1] - x[0]);
  }
  return PetscSqrtReal(square);
}

/* Cells on both sides of a facet. How far their middles are apart, beside how far cells around them are,
   tells where they are short. */
static PetscErrorCode EdgesAddNeighbours_Private(const Level *level, Edges *edges)
{
  PetscInt   begin, end;
  PetscReal *farthest; /* of each cell's neighbours */

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_cells, &farthest));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt pass = 0; pass < 2; pass++) {
    for (PetscInt f = begin; f < end; f++) {
      const PetscInt *cells; // the first points
      PetscInt        num;
      PetscReal       distance, most;

      PetscCall(DMPlexGetSupportSize(level->dm, f, &num));
      PetscCall(DMPlexGetSupport(level->dm, f, &cells));
      if (num != 2) continue;
      distance = CellsGetDistance_Private(level, cells);
      most     = PetscMax(farthest[cells[0]], farthest[cells[1]]);
      for (PetscInt k = 0; k < 2; k++) farthest[cells[k]] = PetscMax(farthest[cells[k]], distance);
      if (!pass) continue;
      PetscCall(EdgesAdd_Private(edges, cells[0], cells[1],
                                 most >= MAX_WEIGHT * distance ? MAX_WEIGHT : (PetscInt)(most / distance)));
    }
  }
  PetscCall(PetscFree(farthest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The box around a facet; returns its longest extent. [out] X - its nodes [num_nodes][dim]; [out] box - [2][dim] */
static PetscReal FacetGetBox_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal X[],
                                     PetscReal box[])
{
  const PetscInt num = ElementNumNodes(facets->type[f]), dim = level->dim;
  PetscReal      extent = 0;

  for (PetscInt d = 0; d < dim; d++) {
    box[d]       = PETSC_MAX_REAL;
    box[dim + d] = -PETSC_MAX_REAL;
    for (PetscInt i = 0; i < num; i++) {
      const PetscReal x = level->coords[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * dim + d];

      X[i * dim + d] = x;
      box[d]         = PetscMin(box[d], x);
      box[dim + d]   = PetscMax(box[dim + d], x);
    }
    extent = PetscMax(extent, box[dim + d] - box[d]);
  }
  return extent;
}

/* The range of direction . x over points, widened. [in] X - [num][dim] */
static BoxSlab SlabAround_Private(PetscInt dim, PetscInt num, const PetscReal X[], const PetscReal direction[],
                                  PetscReal widen)
{
  BoxSlab slab = {.lower = PETSC_MAX_REAL, .upper = -PETSC_MAX_REAL};

  for (PetscInt d = 0; d < dim; d++) slab.direction[d] = direction[d];
  for (PetscInt i = 0; i < num; i++) {
    PetscReal along = 0;

    for (PetscInt d = 0; d < dim; d++) along += direction[d] * X[i * dim + d];
    slab.lower = PetscMin(slab.lower, along);
    slab.upper = PetscMax(slab.upper, along);
  }
  slab.lower -= widen;
  slab.upper += widen;
  return slab;
}

/* What a facet may touch: within the reach before and behind it, and hardly beside it, so that however far it
   reaches it finds no more of smaller facets. [in] reach - negative: a facet's own size */
static PetscErrorCode FacetQuery_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal reach,
                                         BoxTree tree, PetscInt *num_hits, const PetscInt *hits[])
{
  const ElementType type = facets->type[f];
  const PetscInt    dim = level->dim, num = ElementNumNodes(type), num_vertices = ElementNumNodes(ElementLinear(type));
  PetscReal         X[3 * ELEMENT_MAX_FACET_NODES], box[6], xi[2] = {0, 0}, phi[ELEMENT_MAX_NODES], normal[3], Q[9];
  const PetscReal   extent = FacetGetBox_Private(level, facets, f, X, box), widen = reach >= 0 ? reach : extent;
  BoxSlab           slabs[3];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num_vertices; i++) {
    for (PetscInt k = 0; k < dim - 1; k++) xi[k] += ElementNode(type, i)[k] / (PetscReal)num_vertices;
  }
  (void)ElementSurface(type, X, xi, NULL, phi, normal);
  FrameFromNormal(dim, normal, Q);
  for (PetscInt k = 0; k < dim; k++) {
    slabs[k] = SlabAround_Private(dim, num, X, &Q[k * dim], k == 0 ? widen : extent);
    box[k] -= PetscMax(widen, extent);
    box[dim + k] += PetscMax(widen, extent);
  }
  PetscCall(BoxTreeQuerySlabs(tree, box, dim, slabs, num_hits, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells behind facets of a pair that may touch: within the reach that the user gave, or a facet's own size.
   [in,out] contact - facets of nonmortar sides among them, by cell */
static PetscErrorCode EdgesAddPair_Private(Scene scene, const ScenePair *pair, PetscInt weight, Level *level,
                                           Edges *edges, PetscInt contact[])
{
  Facets     nonmortar, mortar;
  PetscReal *boxes, X[3 * ELEMENT_MAX_FACET_NODES];
  BoxTree    tree;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, pair->nonmortar.body, pair->nonmortar.side, &nonmortar));
  PetscCall(LevelGetFacets(level, scene, pair->mortar.body, pair->mortar.side, &mortar));
  PetscCall(PetscMalloc1(mortar.num * 2 * level->dim, &boxes));
  for (PetscInt f = 0; f < mortar.num; f++) (void)FacetGetBox_Private(level, &mortar, f, X, &boxes[f * 2 * level->dim]);
  PetscCall(BoxTreeCreate(level->dim, mortar.num, boxes, &tree));
  for (PetscInt f = 0; f < nonmortar.num; f++) {
    const PetscInt *hits;
    PetscInt        num_hits;

    PetscCall(FacetQuery_Private(level, &nonmortar, f, pair->reach, tree, &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits; h++)
      PetscCall(EdgesAdd_Private(edges, nonmortar.cell[f], mortar.cell[hits[h]], weight));
    if (num_hits) contact[nonmortar.cell[f]]++;
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree(boxes));
  PetscCall(FacetsDestroy(&nonmortar));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edges as compressed rows, as METIS wants them; those that occur twice are summed up. [out] start - [num_cells+1];
   adjacent, weight - [2 * edges->num] */
static PetscErrorCode EdgesToRows_Private(const Edges *edges, PetscInt num_cells, idx_t start[], idx_t adjacent[],
                                          idx_t weight[])
{
  PetscInt *begin, *fill, *other, *share, kept = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(num_cells + 1, &begin, num_cells, &fill));
  PetscCall(PetscMalloc2(2 * edges->num, &other, 2 * edges->num, &share));
  for (PetscInt i = 0; i < 2 * edges->num; i++) begin[edges->end[i] + 1]++;
  for (PetscInt c = 0; c < num_cells; c++) begin[c + 1] += begin[c];
  for (PetscInt i = 0; i < 2 * edges->num; i++) { // end i faces end i ^ 1
    const PetscInt c = edges->end[i], at = begin[c] + fill[c]++;

    other[at] = edges->end[i ^ 1];
    share[at] = edges->weight[i / 2];
  }
  for (PetscInt c = 0; c < num_cells; c++) {
    start[c] = (idx_t)kept;
    PetscCall(PetscSortIntWithArray(fill[c], &other[begin[c]], &share[begin[c]])); // one facet may face thousands
    for (PetscInt i = begin[c]; i < begin[c + 1]; i++) {
      if (kept > start[c] && adjacent[kept - 1] == other[i]) {
        weight[kept - 1] += (idx_t)share[i];
        continue;
      }
      adjacent[kept] = (idx_t)other[i];
      weight[kept++] = (idx_t)share[i];
    }
  }
  start[num_cells] = (idx_t)kept;
  PetscCall(PetscFree2(begin, fill));
  PetscCall(PetscFree2(other, share));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Hands the graph to METIS. */
static PetscErrorCode EdgesCut_Private(const Edges *edges, PetscInt num_cells, const PartitionWeights *shares,
                                       PetscInt part[])
{
  idx_t  n = (idx_t)num_cells, parts = (idx_t)shares->num_parts, constraints = (idx_t)shares->num, cut;
  idx_t *start, *adjacent, *weight, *load, *answer;
  real_t tolerance[PARTITION_MAX_WEIGHTS], *target;
  int    status;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_cells + 1, &start, 2 * edges->num, &adjacent, 2 * edges->num, &weight));
  PetscCall(PetscMalloc3(num_cells * shares->num, &load, shares->num_parts * shares->num, &target, num_cells, &answer));
  PetscCall(EdgesToRows_Private(edges, num_cells, start, adjacent, weight));
  for (PetscInt i = 0; i < num_cells * shares->num; i++) load[i] = (idx_t)shares->load[i];
  for (PetscInt i = 0; i < shares->num_parts * shares->num; i++) target[i] = (real_t)shares->target[i];
  for (PetscInt i = 0; i < shares->num; i++) tolerance[i] = TOLERANCE[i];
  if (parts <= MAX_RECURSIVE) {
    status = METIS_PartGraphRecursive(&n, &constraints, start, adjacent, load, NULL, weight, &parts, target, tolerance,
                                      NULL, &cut, answer);
  } else {
    status = METIS_PartGraphKway(&n, &constraints, start, adjacent, load, NULL, weight, &parts, target, tolerance, NULL,
                                 &cut, answer);
  }
  PetscCheck(status != METIS_ERROR_MEMORY, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for METIS");
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS gave up with status %d", status);
  for (PetscInt c = 0; c < num_cells; c++) part[c] = (PetscInt)answer[c];
  PetscCall(PetscFree3(load, target, answer));
  PetscCall(PetscFree3(start, adjacent, weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionCompute(Scene scene, Level *level, PetscInt refine, PetscInt contact_weight,
                                const PetscInt bricks[], PetscInt num_parts, PetscInt part[])
{
  Edges            edges = {0, 0, NULL, NULL};
  PetscInt        *contact;
  PartitionWeights shares;

  PetscFunctionBeginUser;
  if (level->num_cells < MIN_CELLS_A_PART * num_parts) {
    for (PetscInt c = 0; c < level->num_cells; c++) part[c] = c * num_parts / level->num_cells;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscCalloc1(level->num_cells, &contact));
  PetscCall(EdgesAddNeighbours_Private(level, &edges));
  for (PetscInt p = 0; p < scene->num_pairs && contact_weight; p++) {
    if (scene->pairs[p].mortar.body >= 0)
      PetscCall(EdgesAddPair_Private(scene, &scene->pairs[p], contact_weight, level, &edges, contact));
  }
  PetscCall(PartitionWeightsCreate(scene, level, contact, bricks, num_parts, &shares));
  PetscCall(EdgesCut_Private(&edges, level->num_cells, &shares, part));
  PetscCall(PartitionWeightsCorrect(scene, level, refine, part, &shares));
  PetscCall(EdgesCut_Private(&edges, level->num_cells, &shares, part));
  PetscCall(PartitionWeightsDestroy(&shares));
  PetscCall(PetscFree(contact));
  PetscCall(PetscFree(edges.end));
  PetscCall(PetscFree(edges.weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The partition as PETSc wants it: the cells of rank 0, of rank 1, ... */
static PetscErrorCode PartitionerSet_Private(PetscInt num_cells, const PetscInt part[], PetscMPIInt size,
                                             PetscPartitioner partitioner)
{
  PetscInt *sizes, *points, *fill;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(size, &sizes, num_cells, &points, size, &fill));
  for (PetscInt c = 0; c < num_cells; c++) sizes[part[c]]++;
  for (PetscMPIInt r = 1; r < size; r++) fill[r] = fill[r - 1] + sizes[r - 1];
  for (PetscInt c = 0; c < num_cells; c++) points[fill[part[c]]++] = c;
  PetscCall(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  PetscCall(PetscPartitionerShellSetPartition(partitioner, size, sizes, points));
  PetscCall(PetscFree3(sizes, points, fill));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The point of the whole DM that each point of this rank was. [in] sf - what DMPlexDistribute() gave, NULL if
   nothing moved */
static PetscErrorCode OriginCreate_Private(DM dm, PetscSF sf, PetscInt **origin)
{
  const PetscSFNode *remote;
  const PetscInt    *local;
  PetscInt           begin, end, num;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, origin));
  for (PetscInt p = begin; p < end; p++) (*origin)[p - begin] = p;
  if (!sf) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSFGetGraph(sf, NULL, &num, &local, &remote));
  for (PetscInt i = 0; i < num; i++) (*origin)[(local ? local[i] : i) - begin] = remote[i].index;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionCreate(Scene scene, DM dm, PetscInt refine, const PetscInt bricks[], PetscInt *num_cells,
                               PetscInt **part)
{
  PetscMPIInt size;
  Level       level;
  DM          clone;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  PetscCall(DMClone(dm, &clone)); // the tables hang a section on their DM that must not travel
  PetscCall(LevelCreateTables(scene, clone, 1, &level));
  PetscCall(LevelSetCoords(&level, NULL));
  PetscCall(DMDestroy(&clone));
  *num_cells = level.num_cells;
  PetscCall(PetscMalloc1(level.num_cells, part));
  PetscCall(PartitionCompute(scene, &level, refine, CONTACT_WEIGHT, bricks, size, *part));
  PetscCall(LevelDestroy(&level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The coarsest mesh is parted: all descendants of a cell stay with it, and METIS sees a small graph. Vertices
   are all it needs, so that meshes of every order are parted alike; cells are judged later, on every number
   of ranks. */
PetscErrorCode PartitionDistribute(Scene scene, PetscInt refine, DM *dm, Curves *curves, PetscInt **origin)
{
  PetscPartitioner partitioner;
  PetscMPIInt      size;
  PetscInt        *part, num_cells;
  PetscSF          sf;
  DM               spread;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  if (size == 1) {
    if (origin) PetscCall(OriginCreate_Private(*dm, NULL, origin));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PartitionCreate(scene, *dm, refine, NULL, &num_cells, &part));
  PetscCall(DMPlexGetPartitioner(*dm, &partitioner));
  PetscCall(PartitionerSet_Private(num_cells, part, size, partitioner));
  PetscCall(PetscFree(part));
  PetscCall(DMPlexDistribute(*dm, 0, &sf, &spread));
  PetscCall(CurvesDistribute(*dm, sf, curves));
  if (origin) PetscCall(OriginCreate_Private(spread, sf, origin));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(DMDestroy(dm));
  *dm = spread;
  PetscFunctionReturn(PETSC_SUCCESS);
}
