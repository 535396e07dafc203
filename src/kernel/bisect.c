/* bisect.c -- conforming bisection.

   A tetrahedron is (a0 a1 | a2 a3) with the refinement edge a0 a1. Both facets on that edge have it as their
   marked edge. Facet 0, (a0 a2 a3), and facet 1, (a1 a2 a3), have marked edges of their own. Halved at w, the
   child that keeps a0 has the marked edge of facet 0 as its refinement edge, and likewise for a1. The facets
   that are cut have the edge opposite w marked. The new facet, (w a2 a3), has a2 a3 marked, except in a flat
   cell with the flag. A cell is flat if its marked edges all bound one facet. */
#include "kernel/bisectimpl.h"
#include "base/compat.h"

/* Marks of a cell in one byte: in space, which edge of facets 0 and 1 is marked, and the flag. */
enum {
  EDGE_OPPOSITE = 0, /* a2 a3 */
  EDGE_TO_2     = 1, /* from the vertex of the refinement edge to a2 */
  EDGE_TO_3     = 2,
  EDGE_BITS     = 2,
  EDGE_MASK     = 3,
  FLAG          = 16,
  TURNED        = 32 /* the vertices are an odd permutation of the sense that the first mesh had */
};

/* Lengths that differ by less are equal, so that symmetric meshes are refined symmetrically. */
static const PetscReal LENGTH_STEPS = 1e10;

/* Vertices in the middles of edges that were cut. */
typedef struct {
  EdgeTable  middles;
  PetscInt   room;
  PetscBool *touched; /* whether an edge of the vertex was cut [room] */
  PetscInt  *goal;    /* generation asked for in the cells of a vertex, of graded marks [room] */
} Cuts;

PetscErrorCode BisectionGrow(Bisection *mesh)
{
  PetscFunctionBeginUser;
  if (mesh->num_vertices == mesh->room_vertices) {
    mesh->room_vertices = 2 * mesh->room_vertices;
    PetscCall(PetscRealloc(mesh->room_vertices * sizeof(*mesh->ends), &mesh->ends));
  }
  if (mesh->num_cells == mesh->room_cells) {
    mesh->room_cells = 2 * mesh->room_cells;
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->vertex), &mesh->vertex));
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->facet), &mesh->facet));
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->generation), &mesh->generation));
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->parent), &mesh->parent));
    PetscCall(PetscRealloc(mesh->room_cells * mesh->corners * mesh->corners * sizeof(*mesh->place), &mesh->place));
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->marks), &mesh->marks));
    PetscCall(PetscRealloc(mesh->room_cells * sizeof(*mesh->goal), &mesh->goal));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BisectionGetMiddle(Bisection *mesh, EdgeTable *middles, PetscInt a, PetscInt b, PetscInt *middle)
{
  PetscFunctionBeginUser;
  *middle = EdgeTableFind(middles, a, b);
  if (*middle >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  *middle                = mesh->num_vertices++;
  mesh->ends[*middle][0] = PetscMin(a, b);
  mesh->ends[*middle][1] = PetscMax(a, b);
  PetscCall(EdgeTableAdd(middles, a, b, *middle));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal *BisectionGetPlace(const Bisection *mesh, PetscInt cell, PetscInt vertex)
{
  return &mesh->place[(cell * mesh->corners + vertex) * mesh->corners];
}

PetscInt BisectionGetHalvings(PetscInt mark)
{
  return mark < 0 ? PetscMax(-mark, -2 * mark - 2) : mark;
}

PetscBool BisectionIsTurned(const Bisection *mesh, PetscInt cell)
{
  return (PetscBool)((mesh->marks[cell] & TURNED) > 0);
}

/* Whether a permutation is odd. */
static PetscBool PermutationIsOdd_Private(PetscInt num, const PetscInt order[])
{
  PetscInt inversions = 0;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j < i; j++) inversions += order[j] > order[i];
  }
  return (PetscBool)(inversions % 2);
}

static unsigned char MarksJoin_Private(PetscInt facet0, PetscInt facet1, PetscBool flag)
{
  return (unsigned char)(facet0 | facet1 << EDGE_BITS | (flag ? FLAG : 0));
}

/* The order in which a child lists its parent's vertices, w in the place of the one that it does not keep;
   its marks.
   [in] keep - 0 or 1, the end that it keeps; [out] order - [dim+1] */
static unsigned char ChildOrder_Private(PetscInt dim, unsigned char marks, PetscInt keep, PetscInt order[])
{
  const PetscInt  w = 1 - keep, edge = marks >> (keep ? EDGE_BITS : 0) & EDGE_MASK;
  const PetscInt  other = marks >> (keep ? 0 : EDGE_BITS) & EDGE_MASK;
  const PetscBool flat = (PetscBool)(edge != EDGE_OPPOSITE && edge == other), flag = (PetscBool)((marks & FLAG) > 0);
  const PetscBool child_flag = (PetscBool)(flat && !flag);

  if (dim == 2) {
    order[0] = keep;
    order[1] = 2;
    order[2] = w;
    return 0;
  }
  order[3] = w;
  if (edge == EDGE_OPPOSITE) { // (a2 a3 | keep w), whose facets 0 and 1 are cut ones
    order[0] = 2;
    order[1] = 3;
    order[2] = keep;
    return MarksJoin_Private(EDGE_TO_2, EDGE_TO_2, child_flag);
  }
  order[0] = keep; // (keep c | d w), whose facet 0 is cut and whose facet 1 is new
  order[1] = edge == EDGE_TO_2 ? 2 : 3;
  order[2] = edge == EDGE_TO_2 ? 3 : 2;
  return MarksJoin_Private(EDGE_TO_2, flat && flag ? EDGE_TO_3 : EDGE_TO_2, child_flag);
}

/* Writes the child of a cell that keeps one end of the refinement edge. */
static void BisectionSetChild_Private(Bisection *mesh, PetscInt cell, PetscInt keep, PetscInt middle, PetscInt child)
{
  const PetscInt num = mesh->dim + 1, w = 1 - keep;
  PetscInt       order[BISECT_MAX_VERTICES], vertex[BISECT_MAX_VERTICES], facet[BISECT_MAX_VERTICES];
  PetscReal      place[BISECT_MAX_VERTICES][BISECT_MAX_VERTICES];
  unsigned char  marks  = ChildOrder_Private(mesh->dim, mesh->marks[cell], keep, order);
  unsigned char  turned = mesh->marks[cell] & TURNED; // w where the other end was is the same sense

  if (PermutationIsOdd_Private(num, order)) turned ^= TURNED;
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt k = order[i];

    vertex[i] = k == w ? middle : mesh->vertex[cell][k];
    facet[i]  = k == keep ? -1 : mesh->facet[cell][k];
    for (PetscInt j = 0; j < num; j++)
      place[i][j] = k == w ? (BisectionGetPlace(mesh, cell, 0)[j] + BisectionGetPlace(mesh, cell, 1)[j]) / 2
                           : BisectionGetPlace(mesh, cell, k)[j];
  }
  for (PetscInt i = 0; i < num; i++) {
    mesh->vertex[child][i] = vertex[i];
    mesh->facet[child][i]  = facet[i];
    for (PetscInt j = 0; j < num; j++) BisectionGetPlace(mesh, child, i)[j] = place[i][j];
  }
  mesh->generation[child] = mesh->generation[cell] + 1;
  mesh->goal[child]       = mesh->goal[cell];
  mesh->parent[child]     = mesh->parent[cell];
  mesh->marks[child]      = marks | turned;
}

/* One child takes the place of the cell, the other one comes last. */
static PetscErrorCode BisectionCut_Private(Bisection *mesh, Cuts *cuts, PetscInt cell)
{
  PetscInt middle;

  PetscFunctionBeginUser;
  PetscCall(BisectionGrow(mesh));
  if (mesh->room_vertices > cuts->room) {
    PetscCall(PetscRealloc(mesh->room_vertices * sizeof(*cuts->touched), &cuts->touched));
    PetscCall(PetscArrayzero(&cuts->touched[cuts->room], mesh->room_vertices - cuts->room));
    PetscCall(PetscRealloc(mesh->room_vertices * sizeof(*cuts->goal), &cuts->goal));
    cuts->room = mesh->room_vertices;
  }
  for (PetscInt i = 0; i < 2; i++) cuts->touched[mesh->vertex[cell][i]] = PETSC_TRUE;
  PetscCall(BisectionGetMiddle(mesh, &cuts->middles, mesh->vertex[cell][0], mesh->vertex[cell][1], &middle));
  cuts->goal[middle] = PetscMin(cuts->goal[mesh->vertex[cell][0]], cuts->goal[mesh->vertex[cell][1]]);
  BisectionSetChild_Private(mesh, cell, 1, middle, mesh->num_cells++);
  BisectionSetChild_Private(mesh, cell, 0, middle, cell);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a cell is to be cut: it is asked for, or the middle of one of its edges is a vertex. */
static PetscBool BisectionMustCut_Private(const Bisection *mesh, const Cuts *cuts, PetscInt cell)
{
  if (mesh->generation[cell] < mesh->goal[cell]) return PETSC_TRUE;
  for (PetscInt i = 0; i <= mesh->dim; i++) {
    if (mesh->generation[cell] < cuts->goal[mesh->vertex[cell][i]]) return PETSC_TRUE;
  }
  for (PetscInt i = 0; i <= mesh->dim; i++) {
    const PetscInt a = mesh->vertex[cell][i];

    for (PetscInt j = 0; j < i && cuts->touched[a]; j++) {
      const PetscInt b = mesh->vertex[cell][j];

      if (cuts->touched[b] && EdgeTableFind(&cuts->middles, a, b) >= 0) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* Cuts until no vertex hangs: a pass over the cells may leave hanging vertices on cells that it has
   passed. */
static PetscErrorCode BisectionClose_Private(Bisection *mesh, Cuts *cuts)
{
  PetscBool again = PETSC_TRUE;

  PetscFunctionBeginUser;
  while (again) {
    again = PETSC_FALSE;
    for (PetscInt c = 0; c < mesh->num_cells; c++) { // includes the children appended by this pass
      while (BisectionMustCut_Private(mesh, cuts, c)) {
        again = PETSC_TRUE;
        PetscCall(BisectionCut_Private(mesh, cuts, c));
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves values of cells to new places. [in] num - of values for each cell; to - of every cell [num_cells] */
#define PERMUTE(mesh, array, num, to)                                                                                  \
  do {                                                                                                                 \
    void *sorted;                                                                                                      \
    PetscCall(PetscMalloc((mesh)->room_cells *(num) * sizeof(*(array)), &sorted));                                     \
    for (PetscInt c = 0; c < (mesh)->num_cells; c++)                                                                   \
      PetscCall(PetscMemcpy((char *)sorted + (size_t)((to)[c] * (num)) * sizeof(*(array)), &(array)[c * (num)],        \
                            (size_t)(num) * sizeof(*(array))));                                                        \
    PetscCall(PetscFree(array));                                                                                       \
    (array) = sorted;                                                                                                  \
  } while (0)

PetscErrorCode BisectionSort(Bisection *mesh)
{
  PetscInt *begin, *to, num_parents = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < mesh->num_cells; c++) num_parents = PetscMax(num_parents, mesh->parent[c] + 1);
  PetscCall(PetscCalloc1(num_parents + 1, &begin));
  PetscCall(PetscMalloc1(mesh->num_cells, &to));
  for (PetscInt c = 0; c < mesh->num_cells; c++) begin[mesh->parent[c] + 1]++;
  for (PetscInt p = 0; p < num_parents; p++) begin[p + 1] += begin[p];
  for (PetscInt c = 0; c < mesh->num_cells; c++) to[c] = begin[mesh->parent[c]]++;
  PERMUTE(mesh, mesh->vertex, 1, to);
  PERMUTE(mesh, mesh->facet, 1, to);
  PERMUTE(mesh, mesh->generation, 1, to);
  PERMUTE(mesh, mesh->place, mesh->corners * mesh->corners, to);
  PERMUTE(mesh, mesh->marks, 1, to);
  PERMUTE(mesh, mesh->parent, 1, to);
  PetscCall(PetscFree(begin));
  PetscCall(PetscFree(to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the generations that are asked for: in whole cells, and at vertices. A vertex has the least of what
   its cells ask for. So no cell is cut towards a vertex whose other cells are to stay. */
static void BisectionSetGoals_Private(Bisection *mesh, const PetscInt marked[], PetscInt at_vertex[])
{
  for (PetscInt v = 0; v < mesh->num_vertices; v++) at_vertex[v] = PETSC_MAX_INT;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    const PetscBool graded = (PetscBool)(marked[c] < 0);
    const PetscInt  near   = mesh->generation[c] + (graded ? BisectionGetHalvings(marked[c]) * mesh->dim : 0);

    mesh->goal[c] = mesh->generation[c] + (graded ? 1 : marked[c]) * mesh->dim;
    for (PetscInt i = 0; i <= mesh->dim; i++)
      at_vertex[mesh->vertex[c][i]] = PetscMin(at_vertex[mesh->vertex[c][i]], near);
  }
}

PetscErrorCode BisectionRefineMore(Bisection *mesh, const PetscInt marked[])
{
  Cuts cuts = {.room = mesh->room_vertices};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(cuts.room, &cuts.touched));
  PetscCall(PetscMalloc1(cuts.room, &cuts.goal));
  BisectionSetGoals_Private(mesh, marked, cuts.goal);
  PetscCall(BisectionClose_Private(mesh, &cuts));
  PetscCall(BisectionSort(mesh));
  PetscCall(EdgeTableDestroy(&cuts.middles));
  PetscCall(PetscFree(cuts.touched));
  PetscCall(PetscFree(cuts.goal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void BisectionSetParents(Bisection *mesh)
{
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    mesh->parent[c] = c;
    for (PetscInt i = 0; i < mesh->corners; i++) {
      for (PetscInt j = 0; j < mesh->corners; j++) BisectionGetPlace(mesh, c, i)[j] = i == j;
    }
  }
}

PetscErrorCode BisectionRefine(Bisection *mesh, const PetscInt marked[])
{
  PetscFunctionBeginUser;
  BisectionSetParents(mesh);
  PetscCall(BisectionRefineMore(mesh, marked));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The order of edges: by length, then by their ends. Lengths are measured from the lower end, once for all
   cells. */
typedef struct {
  PetscInt64 length;
  PetscInt   low, high;
} EdgeRank;

static PetscReal EdgeLength2_Private(PetscInt dim, const PetscReal coords[], PetscInt low, PetscInt high)
{
  PetscReal sum = 0;

  for (PetscInt d = 0; d < dim; d++) sum += PetscSqr(coords[high * dim + d] - coords[low * dim + d]);
  return sum;
}

static EdgeRank EdgeGetRank_Private(PetscInt dim, const PetscReal coords[], PetscReal unit, PetscInt a, PetscInt b)
{
  EdgeRank rank = {.low = PetscMin(a, b), .high = PetscMax(a, b)};

  rank.length = (PetscInt64)(EdgeLength2_Private(dim, coords, rank.low, rank.high) / unit * LENGTH_STEPS + 0.5);
  return rank;
}

static PetscBool EdgeIsLonger_Private(EdgeRank a, EdgeRank b)
{
  if (a.length != b.length) return (PetscBool)(a.length > b.length);
  if (a.low != b.low) return (PetscBool)(a.low < b.low);
  return (PetscBool)(a.high < b.high);
}

/* The longest edge among some vertices of a cell.
   [in] places - of those vertices in the cell [num]; [out] longest - places of its ends */
static void CellFindLongest_Private(const Bisection *mesh, const PetscReal coords[], PetscReal unit, PetscInt cell,
                                    PetscInt num, const PetscInt places[], PetscInt longest[2])
{
  EdgeRank best = {.length = -1};

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j < i; j++) {
      const EdgeRank rank =
          EdgeGetRank_Private(mesh->dim, coords, unit, mesh->vertex[cell][places[i]], mesh->vertex[cell][places[j]]);

      if (!EdgeIsLonger_Private(rank, best)) continue;
      best       = rank;
      longest[0] = places[j];
      longest[1] = places[i];
    }
  }
}

/* The marked edge of facet 0 or 1. */
static PetscInt CellMarkFacet_Private(const Bisection *mesh, const PetscReal coords[], PetscReal unit, PetscInt cell,
                                      PetscInt facet)
{
  const PetscInt places[] = {facet, 2, 3};
  PetscInt       longest[2];

  CellFindLongest_Private(mesh, coords, unit, cell, 3, places, longest);
  if (longest[0] != facet) return EDGE_OPPOSITE;
  return longest[1] == 2 ? EDGE_TO_2 : EDGE_TO_3;
}

/* Lists the longest edge of a cell first and marks its facets. */
static void CellBegin_Private(Bisection *mesh, const PetscReal coords[], PetscReal unit, PetscInt cell)
{
  static const PetscInt all[] = {0, 1, 2, 3};
  PetscInt              longest[2];
  unsigned char         turned = 0;

  CellFindLongest_Private(mesh, coords, unit, cell, mesh->dim + 1, all, longest);
  for (PetscInt end = 0; end < 2; end++) { // longest[0] < longest[1]: the first exchange does not move the second end
    const PetscInt vertex = mesh->vertex[cell][end], facet = mesh->facet[cell][end];

    mesh->vertex[cell][end]          = mesh->vertex[cell][longest[end]];
    mesh->facet[cell][end]           = mesh->facet[cell][longest[end]];
    mesh->vertex[cell][longest[end]] = vertex;
    mesh->facet[cell][longest[end]]  = facet;
    if (longest[end] != end) turned ^= TURNED;
  }
  mesh->marks[cell] = 0;
  if (mesh->dim == 3)
    mesh->marks[cell] = MarksJoin_Private(CellMarkFacet_Private(mesh, coords, unit, cell, 0),
                                          CellMarkFacet_Private(mesh, coords, unit, cell, 1), PETSC_FALSE);
  mesh->marks[cell] |= turned;
}

PetscErrorCode BisectionBegin(PetscInt dim, PetscInt corners, PetscInt num_vertices, PetscInt num_cells,
                              const PetscInt cells[], const PetscInt facets[], Bisection *mesh)
{
  PetscFunctionBeginUser;
  *mesh = (Bisection){.dim           = dim,
                      .corners       = corners,
                      .num_vertices  = num_vertices,
                      .num_cells     = num_cells,
                      .room_vertices = PetscMax(1, num_vertices),
                      .room_cells    = PetscMax(1, num_cells)};
  PetscCall(PetscMalloc1(mesh->room_vertices, &mesh->ends));
  PetscCall(PetscMalloc1(mesh->room_cells, &mesh->vertex));
  PetscCall(PetscMalloc1(mesh->room_cells, &mesh->facet));
  PetscCall(PetscCalloc1(mesh->room_cells, &mesh->generation));
  PetscCall(PetscMalloc1(mesh->room_cells, &mesh->parent));
  PetscCall(PetscMalloc1(mesh->room_cells * corners * corners, &mesh->place));
  PetscCall(PetscCalloc1(mesh->room_cells, &mesh->marks));
  PetscCall(PetscMalloc1(mesh->room_cells, &mesh->goal));
  for (PetscInt v = 0; v < num_vertices; v++) mesh->ends[v][0] = mesh->ends[v][1] = -1;
  for (PetscInt c = 0; c < num_cells; c++) {
    PetscCall(PetscArraycpy(mesh->vertex[c], &cells[c * corners], corners));
    PetscCall(PetscArraycpy(mesh->facet[c], &facets[c * corners], corners));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BisectionCreate(PetscInt dim, PetscInt num_vertices, PetscInt num_cells, const PetscInt cells[],
                               const PetscInt facets[], const PetscReal coords[], Bisection *mesh)
{
  const PetscInt num  = dim + 1;
  PetscReal      unit = 0;

  PetscFunctionBeginUser;
  PetscCall(BisectionBegin(dim, num, num_vertices, num_cells, cells, facets, mesh));
  for (PetscInt c = 0; c < num_cells; c++) {
    for (PetscInt i = 0; i < num; i++) {
      for (PetscInt j = 0; j < i; j++)
        unit = PetscMax(unit, EdgeLength2_Private(dim, coords, cells[c * num + i], cells[c * num + j]));
    }
  }
  for (PetscInt c = 0; c < num_cells; c++) CellBegin_Private(mesh, coords, unit, c);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BisectionDestroy(Bisection *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(mesh->vertex));
  PetscCall(PetscFree(mesh->facet));
  PetscCall(PetscFree(mesh->generation));
  PetscCall(PetscFree(mesh->ends));
  PetscCall(PetscFree(mesh->parent));
  PetscCall(PetscFree(mesh->place));
  PetscCall(PetscFree(mesh->marks));
  PetscCall(PetscFree(mesh->goal));
  PetscFunctionReturn(PETSC_SUCCESS);
}
