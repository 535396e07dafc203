/* csv.c -- one nonmortar side as a table, in the order in which one walks along it.

   A side is a set of facets. In 2D facets are directed (the body lies to the left), so each connected piece is a chain: it
   starts at a facet whose first node ends no other facet, or anywhere if it is closed. Pieces start at the end that comes
   first by coordinates, and come in that order, so that the table does not depend on the partition. */
#include <string.h>
#include "picture.h"
#include <mortise/compat.h>

/* A row of the table. */
typedef struct {
  PetscInt  node; /* global */
  PetscReal x[3], pressure, gap, status, force;
} SideNode;

/* Reals that are gathered per node: x, pressure, gap, status, force. */
enum { SIDE_REALS = 7 };

/* A piece of a side: rows begin..end-1 of the order. */
typedef struct {
  PetscInt        begin, end;
  const SideNode *first;
} SidePiece;

static int CompareNode_Private(const void *a, const void *b)
{
  const SideNode *p = (const SideNode *)a, *q = (const SideNode *)b;

  return (p->node > q->node) - (p->node < q->node);
}

static int ComparePlace_Private(const void *a, const void *b)
{
  const SideNode *p = (const SideNode *)a, *q = (const SideNode *)b;

  for (PetscInt k = 0; k < 3; ++k) {
    if (p->x[k] != q->x[k]) return (p->x[k] > q->x[k]) - (p->x[k] < q->x[k]);
  }
  return 0;
}

static int ComparePiece_Private(const void *a, const void *b)
{
  return ComparePlace_Private(((const SidePiece *)a)->first, ((const SidePiece *)b)->first);
}

/* Marks the owned nodes of a set of facets; the rank that holds a facet need not own its nodes. */
static PetscErrorCode MarkNodes_Private(Level *level, const Facets *facets, Vec *marks)
{
  Vec        local;
  PetscReal *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, marks));
  PetscCall(VecGhostGetLocalForm(*marks, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &mark));
  for (PetscInt f = 0; f < facets->num; ++f) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); ++i) {
      mark[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]] = 1.0;
    }
  }
  PetscCall(VecRestoreArray(local, &mark));
  PetscCall(VecGhostRestoreLocalForm(*marks, &local));
  PetscCall(LevelShareVec(*marks, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers the nodes of the side on the first rank, sorted by global number. */
static PetscErrorCode GatherNodes_Private(Fields fields, PetscInt p, const Facets *facets, PetscInt *num,
                                          SideNode **nodes)
{
  Level           *level = fields->vi->level;
  const PetscInt   dim   = level->dim;
  PetscInt         n     = 0, *ids, *all_ids;
  PetscReal       *reals, *all_reals;
  const PetscReal *mark;
  PairFields       nodal;
  Vec              marks;

  PetscFunctionBeginUser;
  PetscCall(MarkNodes_Private(level, facets, &marks));
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PetscCall(PetscMalloc2(level->num_owned, &ids, level->num_owned * SIDE_REALS, &reals));
  PetscCall(VecGetArrayRead(marks, &mark));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    PetscReal *row = &reals[n * SIDE_REALS];

    if (mark[a] == 0.0) continue;
    for (PetscInt k = 0; k < 3; ++k) row[k] = k < dim ? level->coords[a * dim + k] : 0.0;
    row[3] = nodal.pressure[a], row[4] = nodal.gap[a], row[5] = nodal.status[a], row[6] = nodal.force[a];
    ids[n++] = level->node_global[a];
  }
  PetscCall(VecRestoreArrayRead(marks, &mark));
  PetscCall(GatherInts(level->comm, n, ids, num, &all_ids));
  PetscCall(GatherReals(level->comm, n * SIDE_REALS, reals, NULL, &all_reals));
  PetscCall(PetscMalloc1(*num, nodes));
  for (PetscInt i = 0; i < *num; ++i) {
    const PetscReal *row = &all_reals[i * SIDE_REALS];

    (*nodes)[i] = (SideNode){all_ids[i], {row[0], row[1], row[2]}, row[3], row[4], row[5], row[6]};
  }
  if (*num) qsort(*nodes, *num, sizeof(**nodes), CompareNode_Private);
  PetscCall(PetscFree(all_ids));
  PetscCall(PetscFree(all_reals));
  PetscCall(PetscFree2(ids, reals));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Ends of all facets as positions in the sorted nodes, on the first rank. [out] ends - [num][2] */
static PetscErrorCode GatherEnds_Private(const Level *level, const Facets *facets, PetscInt num_nodes,
                                         const SideNode nodes[], PetscInt *num, PetscInt **ends)
{
  PetscInt *mine;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * facets->num, &mine));
  for (PetscInt i = 0; i < 2 * facets->num; ++i) {
    mine[i] = level->node_global[facets->nodes[(i / 2) * ELEMENT_MAX_FACET_NODES + i % 2]];
  }
  PetscCall(GatherInts(level->comm, 2 * facets->num, mine, num, ends));
  *num /= 2;
  for (PetscInt i = 0; i < 2 * *num; ++i) {
    const SideNode  key   = {.node = (*ends)[i]};
    const SideNode *found = (const SideNode *)bsearch(&key, nodes, num_nodes, sizeof(key), CompareNode_Private);

    (*ends)[i] = (PetscInt)(found - nodes);
  }
  PetscCall(PetscFree(mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Walks along next[] from `start` until the end, or until it is back; returns the number of nodes. */
static PetscInt Walk_Private(PetscInt start, PetscInt next[], PetscInt order[])
{
  PetscInt n = 0, at = start;

  do {
    const PetscInt after = next[at];

    order[n++] = at;
    next[at]   = -1; /* gone over once */
    at         = after;
  } while (at >= 0 && at != start);
  return n;
}

/* The node of a closed chain that comes first by its place, whichever node of it was found. */
static PetscInt FirstOfCircle_Private(PetscInt start, const PetscInt next[], const SideNode nodes[])
{
  PetscInt first = start;

  for (PetscInt at = next[start]; at != start; at = next[at]) {
    if (ComparePlace_Private(&nodes[at], &nodes[first]) < 0) first = at;
  }
  return first;
}

/* Enters the chain from `start` as a piece; an open one is turned so that it starts at the end that comes first. */
static void AddPiece_Private(PetscInt start, PetscBool open, PetscInt next[], const SideNode nodes[], PetscInt order[],
                             SidePiece *piece)
{
  PetscInt *const rows = &order[piece->begin], n = Walk_Private(start, next, rows);

  if (open && ComparePlace_Private(&nodes[rows[n - 1]], &nodes[rows[0]]) < 0) {
    for (PetscInt a = 0, b = n - 1; a < b; ++a, --b) {
      const PetscInt swap = rows[a];

      rows[a] = rows[b];
      rows[b] = swap;
    }
  }
  piece->end   = piece->begin + n;
  piece->first = &nodes[rows[0]];
}

/* Orders nodes by chains; every node is in exactly one. [out] order - [num_nodes]; [out] pieces - [num_pieces] */
static PetscErrorCode OrderChains_Private(PetscInt num_nodes, const SideNode nodes[], PetscInt num_facets,
                                          const PetscInt ends[], PetscInt order[], PetscInt *num_pieces,
                                          SidePiece pieces[])
{
  PetscInt *next, *entered, n = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num_nodes, &next, num_nodes, &entered));
  for (PetscInt i = 0; i < num_nodes; ++i) next[i] = entered[i] = -1;
  for (PetscInt f = 0; f < num_facets; ++f) {
    const PetscInt a = ends[2 * f], b = ends[2 * f + 1];

    if (next[a] >= 0 || entered[b] >= 0) continue; /* a side that touches itself: the chain is cut there */
    next[a]    = b;
    entered[b] = a;
  }
  for (PetscInt i = 0; i < num_nodes; ++i) {
    if (entered[i] >= 0) continue;
    pieces[n].begin = n ? pieces[n - 1].end : 0;
    AddPiece_Private(i, PETSC_TRUE, next, nodes, order, &pieces[n++]);
  }
  for (PetscInt i = 0; i < num_nodes; ++i) { /* what is left are circles */
    if (next[i] < 0) continue;
    pieces[n].begin = n ? pieces[n - 1].end : 0;
    AddPiece_Private(FirstOfCircle_Private(i, next, nodes), PETSC_FALSE, next, nodes, order, &pieces[n++]);
  }
  *num_pieces = n;
  if (n) qsort(pieces, n, sizeof(*pieces), ComparePiece_Private);
  PetscCall(PetscFree2(next, entered));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void WriteRow_Private(FILE *out, PetscInt dim, const SideNode *node)
{
  for (PetscInt k = 0; k < dim; ++k) fprintf(out, "%.17g,", (double)node->x[k]);
  fprintf(out, "%.17g,", (double)node->pressure);
  if (PetscIsNanReal(node->gap)) {
    fprintf(out, "nan,"); /* without the sign that printf may show */
  } else {
    fprintf(out, "%.17g,", (double)node->gap);
  }
  fprintf(out, "%d,%.17g", (int)node->status, (double)node->force);
}

/* Writes pieces one after the other, the arc length of each counted from 0. */
static void WritePieces_Private(FILE *out, const SideNode nodes[], const PetscInt order[], PetscInt num_pieces,
                                const SidePiece pieces[])
{
  fprintf(out, "x,y,pressure,gap,status,force,arc_length\n");
  for (PetscInt i = 0; i < num_pieces; ++i) {
    PetscReal arc = 0.0;

    for (PetscInt r = pieces[i].begin; r < pieces[i].end; ++r) {
      const SideNode *node = &nodes[order[r]], *before = r > pieces[i].begin ? &nodes[order[r - 1]] : node;

      arc += hypot(node->x[0] - before->x[0], node->x[1] - before->x[1]);
      WriteRow_Private(out, 2, node);
      fprintf(out, ",%.17g\n", (double)arc);
    }
  }
}

PetscErrorCode PairWriteCSV(Fields fields, PetscInt p, Files *files, const char final[])
{
  Level           *level = fields->vi->level;
  const SceneSide *side  = &fields->vi->pairs[p]->spec->nonmortar;
  PetscInt         num_nodes, num_facets, num_pieces, *ends, *order;
  SideNode        *nodes;
  SidePiece       *pieces;
  FILE            *out = NULL;
  Facets           facets;
  PetscMPIInt      rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(LevelGetFacets(level, fields->vi->scene, side->body, side->side, &facets));
  PetscCall(GatherNodes_Private(fields, p, &facets, &num_nodes, &nodes));
  PetscCall(GatherEnds_Private(level, &facets, num_nodes, nodes, &num_facets, &ends));
  if (rank == 0) PetscCall(FilesOpen(files, final, &out));
  if (out && level->dim == 2) {
    PetscCall(PetscMalloc2(num_nodes, &order, num_nodes, &pieces));
    PetscCall(OrderChains_Private(num_nodes, nodes, num_facets, ends, order, &num_pieces, pieces));
    WritePieces_Private(out, nodes, order, num_pieces, pieces);
    PetscCall(PetscFree2(order, pieces));
  } else if (out) { /* a surface has no natural order but that of its places */
    fprintf(out, "x,y,z,pressure,gap,status,force\n");
    qsort(nodes, num_nodes, sizeof(*nodes), ComparePlace_Private);
    for (PetscInt i = 0; i < num_nodes; ++i) {
      WriteRow_Private(out, 3, &nodes[i]);
      fprintf(out, "\n");
    }
  }
  PetscCall(FilesClose(files, &out));
  PetscCall(PetscFree(nodes));
  PetscCall(PetscFree(ends));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}
