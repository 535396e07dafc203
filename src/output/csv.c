/* csv.c -- one nonmortar side as a table, ordered along the side.

   A side is a set of facets. In 2D facets are directed, with the body on the left. A facet has one link from
   node to node for order 1, two for order 2, directed likewise. Each component is a chain of links. It starts
   at a node where no link ends, or anywhere if it is closed. An open chain starts at the end that is first by
   coordinates, and chains are in this order. So the table does not depend on the partition. Arc length is
   that of the curved facets. */
#include "output/fieldwriter.h"
#include "result/frictionfields.h"
#include "result/gatherarrays.h"
#include "result/sidenodes.h"
#include "base/compat.h"

/* A row of the table: reals alone, which are gathered as such. */
typedef struct {
  PetscReal node; /* its global number */
  PetscReal x[3], pressure, gap, status, force;
  PetscReal traction[3], slip[3]; /* with friction */
  PetscReal arc;                  /* along its piece */
} SideNode;

enum { SIDE_REALS = sizeof(SideNode) / sizeof(PetscReal) };

/* Links between neighbouring nodes, as positions in the sorted nodes, and their lengths. */
typedef struct {
  PetscInt   num;
  PetscInt  *ends;   /* [num][2] */
  PetscReal *length; /* [num] */
} SideLinks;

enum {
  LENGTH_POINTS = 4
}; /* Gauss points of the length of a link: exact to roundoff unless it turns by a large angle */

/* A component of a side: rows begin..end-1 of the order. */
typedef struct {
  PetscInt        begin, end;
  const SideNode *first;
} SidePiece;

static int CSVCompareNode_Private(const void *a, const void *b)
{
  const SideNode *p = (const SideNode *)a, *q = (const SideNode *)b;

  return (p->node > q->node) - (p->node < q->node);
}

static int CSVComparePlace_Private(const void *a, const void *b)
{
  const SideNode *p = (const SideNode *)a, *q = (const SideNode *)b;

  for (PetscInt k = 0; k < 3; k++) {
    if (p->x[k] != q->x[k]) return (p->x[k] > q->x[k]) - (p->x[k] < q->x[k]);
  }
  return 0;
}

static int CSVCompareChain_Private(const void *a, const void *b)
{
  return CSVComparePlace_Private(((const SidePiece *)a)->first, ((const SidePiece *)b)->first);
}

/* Gathers the nodes of the side on the first rank, by ascending global number. Collective.
   [out] nodes - [num], on other ranks none; owned by the caller */
static PetscErrorCode CSVGatherNodes_Private(Fields fields, PetscInt p, const Facets *facets, PetscInt *num,
                                             SideNode **nodes)
{
  Level         *level = fields->vi->level;
  const PetscInt dim   = level->dim;
  PetscInt       n, *mine, num_reals;
  PetscReal     *reals, *traction, *slip;
  SideNode      *own;
  PairFields     nodal;

  PetscFunctionBeginUser;
  PetscCall(SideNodesCreate(level, facets, &n, &mine));
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PairFieldsOmitBeyond(fields->vi->pairs[p], &nodal);
  PetscCall(PetscMalloc2(level->num_owned * dim, &traction, level->num_owned * dim, &slip));
  PetscCall(FrictionFieldsGet(fields, p, traction, slip));
  PetscCall(PetscMalloc1(n, &own));
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt a = mine[i];

    own[i] = (SideNode){.node     = (PetscReal)level->node_global[a],
                        .pressure = nodal.pressure[a],
                        .gap      = nodal.gap[a],
                        .status   = nodal.status[a],
                        .force    = nodal.force[a]};
    for (PetscInt k = 0; k < dim; k++) {
      own[i].x[k]        = level->coords[a * dim + k];
      own[i].traction[k] = traction[a * dim + k];
      own[i].slip[k]     = slip[a * dim + k];
    }
  }
  PetscCall(GatherArraysReal(level->comm, n * SIDE_REALS, (const PetscReal *)own, &num_reals, &reals));
  *num   = num_reals / SIDE_REALS;
  *nodes = (SideNode *)reals;
  PetscCall(PetscFree(own));
  PetscCall(PetscFree2(traction, slip));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscCall(PetscFree(mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Local node k of a line facet in the order along it: ends are numbered first. */
static PetscInt CSVNextNode_Private(PetscInt num_nodes, PetscInt k)
{
  return k == 0 ? 0 : (k == num_nodes - 1 ? 1 : k + 1);
}

/* Length of a line facet between two reference coordinates. [in] X - [num_nodes][2] */
static PetscReal CSVGetLength_Private(ElementType type, const PetscReal X[], PetscReal from, PetscReal to)
{
  PetscReal xi[LENGTH_POINTS], w[LENGTH_POINTS], phi[ELEMENT_MAX_FACET_NODES], length = 0.0;

  QuadratureLine(LENGTH_POINTS, xi, w);
  for (PetscInt q = 0; q < LENGTH_POINTS; q++) {
    const PetscReal at = from + (to - from) * xi[q];

    length += w[q] * (to - from) * ElementSurface(type, X, &at, NULL, phi, NULL);
  }
  return length;
}

/* Links of all facets, on the first rank. [out] links - owned by the caller, CSVDestroyLinks_Private() */
static PetscErrorCode CSVCreateLinks_Private(const Level *level, const Facets *facets, PetscInt num_nodes,
                                             const SideNode nodes[], SideLinks *links)
{
  PetscInt  *ends, n = 0;
  PetscReal *lengths;

  PetscFunctionBeginUser;
  PetscCall(
      PetscMalloc2(2 * ELEMENT_MAX_FACET_NODES * facets->num, &ends, ELEMENT_MAX_FACET_NODES * facets->num, &lengths));
  for (PetscInt f = 0; f < facets->num; f++) {
    const ElementType type = facets->type[f];
    const PetscInt   *node = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], nn = ElementNumNodes(type);
    PetscReal         X[2 * ELEMENT_MAX_FACET_NODES];

    for (PetscInt i = 0; i < nn; i++) PetscCall(PetscArraycpy(&X[2 * i], &level->coords[2 * node[i]], 2));
    for (PetscInt k = 0; k + 1 < nn; k++) {
      const PetscInt a = CSVNextNode_Private(nn, k), b = CSVNextNode_Private(nn, k + 1);

      ends[2 * n]     = level->node_global[node[a]];
      ends[2 * n + 1] = level->node_global[node[b]];
      lengths[n++]    = CSVGetLength_Private(type, X, ElementNode(type, a)[0], ElementNode(type, b)[0]);
    }
  }
  PetscCall(GatherArraysInt(level->comm, 2 * n, ends, NULL, &links->ends));
  PetscCall(GatherArraysReal(level->comm, n, lengths, &links->num, &links->length));
  PetscCall(PetscFree2(ends, lengths));
  for (PetscInt i = 0; i < 2 * links->num; i++) {
    const SideNode  key   = {.node = (PetscReal)links->ends[i]};
    const SideNode *found = (const SideNode *)bsearch(&key, nodes, num_nodes, sizeof(key), CSVCompareNode_Private);

    links->ends[i] = (PetscInt)(found - nodes);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode CSVDestroyLinks_Private(SideLinks *links)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(links->ends));
  PetscCall(PetscFree(links->length));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Follows next[] from `start` to the end, or back to it; returns the number of nodes. */
static PetscInt CSVFollowChain_Private(PetscInt start, PetscInt next[], PetscInt order[])
{
  PetscInt n = 0, at = start;

  do {
    const PetscInt after = next[at];

    order[n++] = at;
    next[at]   = -1; /* each link is used once */
    at         = after;
  } while (at >= 0 && at != start);
  return n;
}

/* The first node of a closed chain by position. */
static PetscInt CSVFindFirstOfLoop_Private(PetscInt start, const PetscInt next[], const SideNode nodes[])
{
  PetscInt first = start;

  for (PetscInt at = next[start]; at != start; at = next[at]) {
    if (CSVComparePlace_Private(&nodes[at], &nodes[first]) < 0) first = at;
  }
  return first;
}

/* Enters the chain from `start` as a piece; an open one is turned so that it starts at the end that comes
   first.
   [in] step - length of the link that leaves each node [num_nodes] */
static void CSVAddChain_Private(PetscInt start, PetscBool open, PetscInt next[], const PetscReal step[],
                                SideNode nodes[], PetscInt order[], SidePiece *piece)
{
  PetscInt *const rows = &order[piece->begin], n = CSVFollowChain_Private(start, next, rows);
  const PetscBool turn = (PetscBool)(open && CSVComparePlace_Private(&nodes[rows[n - 1]], &nodes[rows[0]]) < 0);

  for (PetscInt a = 0, b = n - 1; turn && a < b; a++, b--) {
    const PetscInt swap = rows[a];

    rows[a] = rows[b];
    rows[b] = swap;
  }
  for (PetscInt r = 1; r < n; r++) nodes[rows[r]].arc = nodes[rows[r - 1]].arc + step[rows[turn ? r : r - 1]];
  piece->end   = piece->begin + n;
  piece->first = &nodes[rows[0]];
}

/* Orders nodes by chains; every node is in exactly one.
   [in,out] nodes - their arc lengths are entered [num_nodes];
   [out] order - [num_nodes]; [out] pieces - [num_pieces] */
static PetscErrorCode CSVOrderChains_Private(PetscInt num_nodes, SideNode nodes[], const SideLinks *links,
                                             PetscInt order[], PetscInt *num_pieces, SidePiece pieces[])
{
  PetscInt  *next, *entered, n = 0;
  PetscReal *step;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_nodes, &next, num_nodes, &entered, num_nodes, &step));
  for (PetscInt i = 0; i < num_nodes; i++) next[i] = entered[i] = -1;
  for (PetscInt l = 0; l < links->num; l++) {
    const PetscInt a = links->ends[2 * l], b = links->ends[2 * l + 1];

    if (next[a] >= 0 || entered[b] >= 0) continue; /* a side that touches itself: the chain is cut there */
    next[a]    = b;
    entered[b] = a;
    step[a]    = links->length[l];
  }
  for (PetscInt i = 0; i < num_nodes; i++) {
    if (entered[i] >= 0) continue;
    pieces[n].begin = n ? pieces[n - 1].end : 0;
    CSVAddChain_Private(i, PETSC_TRUE, next, step, nodes, order, &pieces[n++]);
  }
  for (PetscInt i = 0; i < num_nodes; i++) { /* the rest are closed chains */
    if (next[i] < 0) continue;
    pieces[n].begin = n ? pieces[n - 1].end : 0;
    CSVAddChain_Private(CSVFindFirstOfLoop_Private(i, next, nodes), PETSC_FALSE, next, step, nodes, order,
                        &pieces[n++]);
  }
  *num_pieces = n;
  if (n) qsort(pieces, n, sizeof(*pieces), CSVCompareChain_Private);
  PetscCall(PetscFree3(next, entered, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void CSVWriteRow_Private(FILE *out, PetscInt dim, const SideNode *node)
{
  for (PetscInt k = 0; k < dim; k++) fprintf(out, "%.17g,", (double)node->x[k]);
  fprintf(out, "%.17g,", (double)node->pressure);
  if (PetscIsNanReal(node->gap)) {
    fprintf(out, "nan,"); /* without the sign that printf may show */
  } else {
    fprintf(out, "%.17g,", (double)node->gap);
  }
  fprintf(out, "%d,%.17g", (int)node->status, (double)node->force);
}

/* The columns of friction in a row. */
static void CSVWriteFriction_Private(FILE *out, PetscInt dim, const SideNode *node)
{
  for (PetscInt k = 0; k < dim; k++) fprintf(out, ",%.17g", (double)node->traction[k]);
  for (PetscInt k = 0; k < dim; k++) fprintf(out, ",%.17g", (double)node->slip[k]);
}

/* The names of the columns. */
static void CSVWriteHead_Private(FILE *out, PetscInt dim, PetscBool friction)
{
  fprintf(out, dim == 2 ? "x,y,pressure,gap,status,force,arc_length" : "x,y,z,pressure,gap,status,force");
  for (PetscInt k = 0; friction && k < dim; k++) fprintf(out, ",tangential_traction_%c", "xyz"[k]);
  for (PetscInt k = 0; friction && k < dim; k++) fprintf(out, ",slip_%c", "xyz"[k]);
  fprintf(out, "\n");
}

/* Writes pieces one after the other, the arc length of each counted from 0. */
static void CSVWriteChains_Private(FILE *out, const SideNode nodes[], const PetscInt order[], PetscInt num_pieces,
                                   const SidePiece pieces[], PetscBool friction)
{
  for (PetscInt i = 0; i < num_pieces; i++) {
    for (PetscInt r = pieces[i].begin; r < pieces[i].end; r++) {
      CSVWriteRow_Private(out, 2, &nodes[order[r]]);
      fprintf(out, ",%.17g", (double)nodes[order[r]].arc);
      if (friction) CSVWriteFriction_Private(out, 2, &nodes[order[r]]);
      fprintf(out, "\n");
    }
  }
}

PetscErrorCode CSVWritePair(Fields fields, PetscInt p, FileSet *files, const char final[])
{
  Level           *level     = fields->vi->level;
  const SceneSide *side      = &fields->vi->pairs[p]->spec->nonmortar;
  const PetscBool  friction  = ScenePairHasFriction(fields->vi->pairs[p]->spec);
  PetscInt         num_nodes = 0, num_pieces, *order;
  SideLinks        links     = {0, NULL, NULL};
  SideNode        *nodes;
  SidePiece       *pieces;
  FILE            *out = NULL;
  Facets           facets;
  PetscMPIInt      rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(LevelGetFacets(level, fields->vi->scene, side->body, side->side, &facets));
  PetscCall(CSVGatherNodes_Private(fields, p, &facets, &num_nodes, &nodes));
  if (level->dim == 2) PetscCall(CSVCreateLinks_Private(level, &facets, num_nodes, nodes, &links));
  if (rank == 0) PetscCall(FileSetOpen(files, final, &out));
  if (out) CSVWriteHead_Private(out, level->dim, friction);
  if (out && level->dim == 2) {
    PetscCall(PetscMalloc2(num_nodes, &order, num_nodes, &pieces));
    PetscCall(CSVOrderChains_Private(num_nodes, nodes, &links, order, &num_pieces, pieces));
    CSVWriteChains_Private(out, nodes, order, num_pieces, pieces, friction);
    PetscCall(PetscFree2(order, pieces));
  } else if (out) { /* a surface is ordered by position */
    qsort(nodes, num_nodes, sizeof(*nodes), CSVComparePlace_Private);
    for (PetscInt i = 0; i < num_nodes; i++) {
      CSVWriteRow_Private(out, 3, &nodes[i]);
      if (friction) CSVWriteFriction_Private(out, 3, &nodes[i]);
      fprintf(out, "\n");
    }
  }
  PetscCall(FileSetClose(files, &out));
  PetscCall(PetscFree(nodes));
  PetscCall(CSVDestroyLinks_Private(&links));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}
