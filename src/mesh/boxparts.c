/* boxparts.c -- boxes of many cells, of which each rank makes its own.

   Neighbouring bricks form blocks, so few that the first rank can partition them as it does other meshes.
   Then each rank makes the bricks of its blocks. All ranks know which ranks have a vertex, an edge or a
   facet: the highest of them owns it. (DMPlexInterpolatePointSF() of PETSc 3.18 misses facets of solids.) */
#include "base/compat.h"
#include "base/usererror.h"
#include "bodies/bodylist.h"
#include "bodies/bodymerge.h"
#include "bodies/box.h"
#include "mesh/boxcoarsening.h"
#include "level/plexpoints.h"
#include "mesh/boxparts.h"
#include "partition/partition.h"
#include "partition/plexjoin.h"
#include <petscsf.h>

enum {
  MIN_BRICKS        = 4096, /* a mesh of fewer bricks fits one rank */
  MAX_BLOCKS        = 8192, /* of all boxes, or more for */
  MIN_BLOCKS_A_PART = 64    /* parts that are even within some percent */
};

/* The blocks of all boxes, and their ranks. */
typedef struct {
  PetscInt dim, num_bodies, edge; /* bricks along an edge of a block, at most */
  PetscInt (*bricks)[3];          /* of each box along each axis [num_bodies] */
  PetscInt (*blocks)[3];
  PetscInt *first; /* block of each box [num_bodies+1] */
  PetscInt *rank;  /* of every block, x first [first[num_bodies]] */
} Blocks;

static PetscInt BricksCount_Private(PetscInt dim, const PetscInt factor[])
{
  return factor[0] * factor[1] * (dim > 2 ? factor[2] : 1);
}

static void BodyCountBricks_Private(Scene scene, PetscInt coarser, PetscInt b, PetscInt bricks[3])
{
  SceneBody body = scene->bodies[b];

  BodyCoarsen(&body, scene->dim, coarser);
  for (PetscInt d = 0; d < 3; d++) bricks[d] = d < scene->dim ? body.faces[d] << body.refine : 1;
}

PetscBool BoxPartsWanted(Scene scene, PetscInt coarser, PetscMPIInt num_ranks)
{
  PetscInt num = 0, bricks[3];

  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (scene->bodies[b].mesh_file) return PETSC_FALSE;
    BodyCountBricks_Private(scene, coarser, b, bricks);
    num += BricksCount_Private(scene->dim, bricks);
  }
  return (PetscBool)(num_ranks > 1 && !scene->adapt.on && num >= MIN_BRICKS);
}

/* Blocks with edges of so many bricks, or fewer where that is no divisor. */
static void BlocksCount_Private(Blocks *blocks, PetscInt edge)
{
  blocks->edge = edge;
  for (PetscInt b = 0; b < blocks->num_bodies; b++) {
    for (PetscInt d = 0; d < 3; d++) blocks->blocks[b][d] = (blocks->bricks[b][d] + edge - 1) / edge;
    blocks->first[b + 1] = blocks->first[b] + BricksCount_Private(blocks->dim, blocks->blocks[b]);
  }
}

static PetscErrorCode BlocksCreate_Private(Scene scene, PetscInt coarser, PetscMPIInt num_ranks, Blocks *blocks)
{
  PetscFunctionBeginUser;
  *blocks = (Blocks){.dim = scene->dim, .num_bodies = scene->num_bodies};
  PetscCall(PetscMalloc2(scene->num_bodies, &blocks->bricks, scene->num_bodies, &blocks->blocks));
  PetscCall(PetscCalloc1(scene->num_bodies + 1, &blocks->first));
  for (PetscInt b = 0; b < scene->num_bodies; b++) BodyCountBricks_Private(scene, coarser, b, blocks->bricks[b]);
  BlocksCount_Private(blocks, 1);
  while (blocks->first[scene->num_bodies] > PetscMax(MAX_BLOCKS, MIN_BLOCKS_A_PART * num_ranks))
    BlocksCount_Private(blocks, blocks->edge + 1);
  PetscCall(PetscCalloc1(blocks->first[scene->num_bodies], &blocks->rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BlocksDestroy_Private(Blocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(blocks->bricks, blocks->blocks));
  PetscCall(PetscFree(blocks->first));
  PetscCall(PetscFree(blocks->rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first brick of a block along an axis: blocks differ by one brick at most. */
static PetscInt BlockBegin_Private(PetscInt bricks, PetscInt blocks, PetscInt block)
{
  return (PetscInt)((PetscInt64)block * bricks / blocks);
}

/* The block of a brick along an axis. */
static PetscInt BrickFindBlock_Private(PetscInt bricks, PetscInt blocks, PetscInt brick)
{
  return (PetscInt)((((PetscInt64)brick + 1) * blocks - 1) / bricks);
}

/* A box of blocks as cells, whose corners are nodes of the bricks. [out] num - bricks of each block */
static PetscErrorCode BlocksMakeBox_Private(Scene scene, const Blocks *blocks, PetscInt b, const SideNames *names,
                                            BodyList *list, PetscInt num[], char sentence[])
{
  const PetscInt *bricks = blocks->bricks[b], *n = blocks->blocks[b], dim = blocks->dim;
  SceneBody       body = scene->bodies[b];

  PetscFunctionBeginUser;
  body.simplex = PETSC_FALSE;
  body.refine  = 0;
  for (PetscInt d = 0; d < dim; d++) body.faces[d] = n[d];
  PetscCall(BodyListCreateBox(&body, dim, names, NULL, list, sentence));
  for (PetscInt i = 0; i < list->num_nodes; i++) {
    for (PetscInt d = 0, rest = i; d < dim; rest /= n[d] + 1, d++) {
      const PetscReal s = (PetscReal)BlockBegin_Private(bricks[d], n[d], rest % (n[d] + 1)) / (PetscReal)bricks[d];

      list->coords[i * dim + d] = (1 - s) * body.lower[d] + s * body.upper[d];
    }
  }
  for (PetscInt c = 0; c < list->num_cells; c++) {
    num[c] = 1;
    for (PetscInt d = 0, rest = c; d < dim; rest /= n[d], d++)
      num[c] *= BlockBegin_Private(bricks[d], n[d], rest % n[d] + 1) - BlockBegin_Private(bricks[d], n[d], rest % n[d]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Parts the blocks on the first rank and tells all. Collective. */
static PetscErrorCode BlocksPart_Private(Scene scene, PetscInt refine, const SideNames names[], Blocks *blocks)
{
  const PetscInt num                     = blocks->first[blocks->num_bodies];
  char           sentence[MESH_SENTENCE] = "";
  PetscInt      *bricks, *part, num_cells;
  BodyList      *lists;
  Curves         none;
  PetscMPIInt    rank;
  DM             dm;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  PetscCall(PetscCalloc1(blocks->num_bodies, &lists));
  PetscCall(PetscMalloc1(num, &bricks));
  for (PetscInt b = 0; b < blocks->num_bodies && !rank && !sentence[0]; b++)
    PetscCall(BlocksMakeBox_Private(scene, blocks, b, &names[b], &lists[b], &bricks[blocks->first[b]], sentence));
  PetscCall(UserErrorCheck(scene->comm, sentence));
  PetscCall(MeshMerge(scene, lists, names, &dm, &none));
  PetscCall(PartitionCreate(scene, dm, refine, bricks, &num_cells, &part));
  PetscCall(PetscArraycpy(blocks->rank, part, num_cells));
  PetscCallMPI(MPI_Bcast(blocks->rank, (PetscMPIInt)num, MPIU_INT, 0, scene->comm));
  for (PetscInt b = 0; b < blocks->num_bodies; b++) PetscCall(BodyListDestroy(&lists[b]));
  PetscCall(PetscFree(lists));
  PetscCall(PetscFree(bricks));
  PetscCall(PetscFree(part));
  PetscCall(CurvesDestroy(&none));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rank that makes a brick. */
static PetscInt BlocksFindRank_Private(const Blocks *blocks, PetscInt b, const PetscInt at[])
{
  PetscInt block = 0;

  for (PetscInt d = blocks->dim - 1; d >= 0; d--)
    block = block * blocks->blocks[b][d] + BrickFindBlock_Private(blocks->bricks[b][d], blocks->blocks[b][d], at[d]);
  return blocks->rank[blocks->first[b] + block];
}

/* Position of a point of a box: between two vertices, at most a brick apart along each axis. */
typedef struct {
  PetscInt body, low[3], high[3];
} Place;

/* The highest rank whose bricks have a point: neighbouring bricks are cut equally.
   [out] shared - whether several ranks have it */
static PetscInt BlocksFindOwner_Private(const Blocks *blocks, const Place *place, PetscBool *shared)
{
  const PetscInt *n    = blocks->bricks[place->body];
  PetscInt        most = -1, least = PETSC_MAX_INT, brick[3];

  for (PetscInt side = 0; side < 1 << blocks->dim; side++) {
    PetscBool inside = PETSC_TRUE;
    PetscInt  rank;

    for (PetscInt d = 0; d < blocks->dim; d++) {
      brick[d] = place->high[d] - (side >> d & 1);
      inside   = (PetscBool)(inside && brick[d] >= 0 && brick[d] < n[d] && brick[d] <= place->low[d]);
    }
    if (!inside) continue;
    rank  = BlocksFindRank_Private(blocks, place->body, brick);
    most  = PetscMax(most, rank);
    least = PetscMin(least, rank);
  }
  *shared = (PetscBool)(most != least);
  return most;
}

/* Bricks of this rank's blocks of a box, and their vertices. [out] part - freed by the caller */
static PetscErrorCode BlocksMakePart_Private(const Blocks *blocks, PetscInt b, PetscInt rank, BoxPart *part)
{
  const PetscInt *n = blocks->bricks[b], *m = blocks->blocks[b], corners = 1 << blocks->dim;
  PetscInt        capacity = 0;

  PetscFunctionBeginUser;
  *part = (BoxPart){.num_bricks = 0};
  for (PetscInt block = 0; block < BricksCount_Private(blocks->dim, m); block++) {
    PetscInt begin[3] = {0, 0, 0}, end[3] = {1, 1, 1};

    if (blocks->rank[blocks->first[b] + block] != rank) continue;
    for (PetscInt d = 0, rest = block; d < blocks->dim; rest /= m[d], d++) {
      begin[d] = BlockBegin_Private(n[d], m[d], rest % m[d]);
      end[d]   = BlockBegin_Private(n[d], m[d], rest % m[d] + 1);
    }
    if (part->num_bricks + blocks->edge * blocks->edge * blocks->edge > capacity) {
      capacity = 2 * capacity + blocks->edge * blocks->edge * blocks->edge;
      PetscCall(PetscRealloc(capacity * sizeof(*part->brick), &part->brick));
    }
    for (PetscInt k = begin[2]; k < end[2]; k++)
      for (PetscInt j = begin[1]; j < end[1]; j++)
        for (PetscInt i = begin[0]; i < end[0]; i++) part->brick[part->num_bricks++] = (k * n[1] + j) * n[0] + i;
  }
  PetscCall(PetscSortInt(part->num_bricks, part->brick));
  part->num_nodes = corners * part->num_bricks;
  PetscCall(PetscMalloc1(part->num_nodes, &part->node));
  for (PetscInt i = 0; i < part->num_nodes; i++) {
    const PetscInt brick = part->brick[i / corners], corner = i % corners;
    const PetscInt at[3] = {brick % n[0] + (corner & 1), brick / n[0] % n[1] + (corner >> 1 & 1),
                            brick / n[0] / n[1] + (corner >> 2)};

    part->node[i] = (at[2] * (n[1] + 1) + at[1]) * (n[0] + 1) + at[0];
  }
  PetscCall(PetscSortRemoveDupsInt(&part->num_nodes, part->node));
  PetscFunctionReturn(PETSC_SUCCESS);
}

enum {
  KINDS = 24
}; /* kinds of points with the same lowest vertex: their axes, for triangles their side of the diagonal */

/* The points that this rank shares with others. */
typedef struct {
  PetscInt  num_keys, num;
  PetscInt *key, *point, *owner; /* the same on all ranks, less than num_keys; point of the DM; rank [num] */
} SharedPoints;

/* Position of the point with these vertices; returns its index among the points with the same lowest vertex.
   [in] nodes - numbers in the box [num] */
static PetscInt PlaceFind_Private(const Blocks *blocks, PetscInt num, const PetscInt nodes[], Place *place)
{
  const PetscInt *n     = blocks->bricks[place->body];
  PetscInt        first = -1, axes = 0, kind = num > 2;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt d = 0, rest = nodes[i]; d < blocks->dim; rest /= n[d] + 1, d++) {
      const PetscInt at = rest % (n[d] + 1);

      place->low[d]  = i ? PetscMin(place->low[d], at) : at;
      place->high[d] = i ? PetscMax(place->high[d], at) : at;
    }
  }
  for (PetscInt d = blocks->dim - 1; d >= 0; d--) {
    if (place->high[d] == place->low[d]) continue;
    axes |= 1 << d;
    first = d;
  }
  for (PetscInt i = 0, along = 0; num == 3 && i < num; i++) { // a corner or two are off along the first axis
    PetscInt rest = nodes[i];

    for (PetscInt d = 0; d < first; d++) rest /= n[d] + 1;
    along += rest % (n[first] + 1) - place->low[first];
    if (along == 2) kind = 2;
  }
  return kind * 8 + axes;
}

/* [in] first - of the vertices of each box among those of all [num_bodies+1] */
static PetscErrorCode SharedPointsAdd_Private(DM dm, const Blocks *blocks, const BoxPart parts[],
                                              const PetscInt first[], PetscInt point, SharedPoints *shared)
{
  PetscInt  num, begin, vertices[ELEMENT_MAX_NODES], owner, kind, lowest = 0;
  PetscBool several;
  Place     place = {.body = 0};

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, NULL));
  PetscCall(PointGetVertices(dm, point, &num, vertices));
  while (vertices[0] - begin >= parts[place.body].num_nodes) begin += parts[place.body++].num_nodes;
  for (PetscInt i = 0; i < num; i++) vertices[i] = parts[place.body].node[vertices[i] - begin];
  kind  = PlaceFind_Private(blocks, num, vertices, &place);
  owner = BlocksFindOwner_Private(blocks, &place, &several);
  if (!several) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt d = blocks->dim - 1; d >= 0; d--) lowest = lowest * (blocks->bricks[place.body][d] + 1) + place.low[d];
  shared->key[shared->num]     = (first[place.body] + lowest) * KINDS + kind;
  shared->point[shared->num]   = point;
  shared->owner[shared->num++] = owner;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All points but cells. */
static PetscErrorCode SharedPointsCreate_Private(DM dm, const Blocks *blocks, const BoxPart parts[],
                                                 SharedPoints *shared)
{
  PetscInt *first, begin, end, cell_begin, cell_end;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(blocks->num_bodies + 1, &first));
  for (PetscInt b = 0; b < blocks->num_bodies; b++) {
    const PetscInt nodes[3] = {blocks->bricks[b][0] + 1, blocks->bricks[b][1] + 1, blocks->bricks[b][2] + 1};

    first[b + 1] = first[b] + BricksCount_Private(blocks->dim, nodes);
  }
  PetscCheck(first[blocks->num_bodies] < PETSC_MAX_INT / KINDS, PetscObjectComm((PetscObject)dm), PETSC_ERR_SUP,
             "%" PetscInt_FMT " nodes of boxes need PETSc with 64-bit indices", first[blocks->num_bodies]);
  shared->num_keys = first[blocks->num_bodies] * KINDS;
  shared->num      = 0;
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cell_begin, &cell_end));
  PetscCall(PetscMalloc3(end - begin, &shared->key, end - begin, &shared->point, end - begin, &shared->owner));
  for (PetscInt p = begin; p < end; p++) {
    if (p >= cell_begin && p < cell_end) continue;
    PetscCall(SharedPointsAdd_Private(dm, blocks, parts, first, p, shared));
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The points of owners, by a list of all keys that is spread over the ranks. Collective.
   [out] remote - [num] */
static PetscErrorCode SharedPointsFindRemote_Private(MPI_Comm comm, const SharedPoints *shared, PetscInt remote[])
{
  PetscLayout layout;
  PetscMPIInt rank;
  PetscSF     sf;
  PetscInt   *list, n;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscLayoutCreateFromSizes(comm, PETSC_DECIDE, shared->num_keys, 1, &layout));
  PetscCall(PetscLayoutGetLocalSize(layout, &n));
  PetscCall(PetscSFCreate(comm, &sf));
  PetscCall(PetscSFSetGraphLayout(sf, layout, shared->num, NULL, PETSC_OWN_POINTER, shared->key));
  PetscCall(PetscMalloc1(n, &list));
  for (PetscInt i = 0; i < n; i++) list[i] = -1;
  for (PetscInt i = 0; i < shared->num; i++) remote[i] = shared->owner[i] == rank ? shared->point[i] : -1;
  PetscCall(PetscSFReduceBegin(sf, MPIU_INT, remote, list, MPI_MAX));
  PetscCall(PetscSFReduceEnd(sf, MPIU_INT, remote, list, MPI_MAX));
  PetscCall(PetscSFBcastBegin(sf, MPIU_INT, list, remote, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, MPIU_INT, list, remote, MPI_REPLACE));
  PetscCall(PetscFree(list));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Joins the parts of all ranks. Collective. */
static PetscErrorCode BlocksJoin_Private(DM dm, const Blocks *blocks, const BoxPart parts[])
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)dm);
  SharedPoints   shared;
  PetscSFNode   *nodes;
  PetscMPIInt    rank;
  PetscSF        sf;
  PetscInt      *remote, *leaves, num = 0, end;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(SharedPointsCreate_Private(dm, blocks, parts, &shared));
  PetscCall(PetscMalloc1(shared.num, &remote));
  PetscCall(SharedPointsFindRemote_Private(comm, &shared, remote));
  PetscCall(PetscMalloc1(shared.num, &leaves));
  PetscCall(PetscMalloc1(shared.num, &nodes));
  for (PetscInt i = 0; i < shared.num; i++) {
    if (shared.owner[i] == rank) continue;
    leaves[num]  = shared.point[i];
    nodes[num++] = (PetscSFNode){.rank = shared.owner[i], .index = remote[i]};
  }
  PetscCall(DMPlexGetChart(dm, NULL, &end));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFSetGraph(sf, end, num, leaves, PETSC_OWN_POINTER, nodes, PETSC_OWN_POINTER));
  PetscCall(PlexOrientShared(dm, blocks->dim));
  PetscCall(PetscFree(remote));
  PetscCall(PetscFree3(shared.key, shared.point, shared.owner));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BoxPartsCreate(Scene scene, PetscInt coarser, DM *dm, Curves *curves)
{
  char        sentence[MESH_SENTENCE] = "";
  PetscMPIInt rank, size;
  SideNames  *names;
  BodyList   *lists;
  BoxPart    *parts;
  Blocks      blocks;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  PetscCall(PetscCalloc3(scene->num_bodies, &lists, scene->num_bodies, &names, scene->num_bodies, &parts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(SideNamesOfBody(scene, b, &names[b]));
  PetscCall(BlocksCreate_Private(scene, coarser, size, &blocks));
  PetscCall(BlocksPart_Private(scene, coarser + scene->refine, names, &blocks));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    SceneBody body = scene->bodies[b];

    BodyCoarsen(&body, scene->dim, coarser);
    PetscCall(BlocksMakePart_Private(&blocks, b, rank, &parts[b]));
    PetscCall(BodyListCreateBox(&body, scene->dim, &names[b], &parts[b], &lists[b], sentence));
  }
  PetscCall(MeshMerge(scene, lists, names, dm, curves));
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(BodyListDestroy(&lists[b]));
  PetscCall(BlocksJoin_Private(*dm, &blocks, parts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCall(SideNamesDestroy(&names[b]));
    PetscCall(PetscFree(parts[b].brick));
    PetscCall(PetscFree(parts[b].node));
  }
  PetscCall(PetscFree3(lists, names, parts));
  PetscCall(BlocksDestroy_Private(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}
