/* split.c -- quadrilaterals split into four and hexahedra into eight, with hanging vertices (see bisect.h).

   Vertices of the parts are the nodes of the cell of order 2. Child k keeps corner k of its parent in the
   place k, so that all descendants of a cell have the same sense. Its vertex i is the node halfway between
   the corners k and i. Cells that are to be split together are found first. A cell must not be split before
   those that touch it in a point and have been split less often. */
#include "kernel/bisectimpl.h"
#include "base/compat.h"

enum { MAX_CORNERS = BISECT_MAX_VERTICES };

ElementType SplitElement(const Bisection *mesh)
{
  return mesh->dim == 2 ? ELEMENT_QUAD4 : ELEMENT_HEX8;
}

PetscErrorCode SplitCreate(PetscInt dim, PetscInt num_vertices, PetscInt num_cells, const PetscInt cells[],
                           const PetscInt facets[], Bisection *mesh)
{
  const PetscInt corners = ElementNumNodes(dim == 2 ? ELEMENT_QUAD4 : ELEMENT_HEX8);

  PetscFunctionBeginUser;
  PetscCall(BisectionBegin(dim, corners, num_vertices, num_cells, cells, facets, mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SplitGetMiddles(const Bisection *mesh, EdgeTable *middles)
{
  PetscFunctionBeginUser;
  *middles = (EdgeTable){.room = 0};
  for (PetscInt v = 0; v < mesh->num_vertices; v++)
    if (mesh->ends[v][0] >= 0) PetscCall(EdgeTableAdd(middles, mesh->ends[v][0], mesh->ends[v][1], v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The two middles of opposite edges between which the middle of a face lies: those with the lower number of
   all four. [in] middle - of the face's edges, around it */
static void FaceChooseEnds_Private(const PetscInt middle[], PetscInt ends[2])
{
  const PetscInt first = PetscMin(middle[0], middle[2]), second = PetscMin(middle[1], middle[3]);
  const PetscInt k = first < second ? 0 : 1;

  ends[0] = middle[k];
  ends[1] = middle[k + 2];
}

PetscInt SplitFindFace(const EdgeTable *middles, const PetscInt corner[], PetscInt middle[])
{
  PetscInt ends[2];

  for (PetscInt i = 0; i < 4; i++) {
    middle[i] = EdgeTableFind(middles, corner[i], corner[(i + 1) % 4]);
    if (middle[i] < 0) return -1;
  }
  FaceChooseEnds_Private(middle, ends);
  return EdgeTableFind(middles, ends[0], ends[1]);
}

/* The corners of a face of a hexahedron. */
static void CellGetFace_Private(const Bisection *mesh, PetscInt cell, PetscInt face, PetscInt corner[])
{
  const PetscInt *local = ElementFacetNodes(ELEMENT_HEX8, face);

  for (PetscInt i = 0; i < 4; i++) corner[i] = mesh->vertex[cell][local[i]];
}

/* The nodes of a cell of order 2, as vertices; new ones are made. [out] node - [ELEMENT_MAX_NODES] */
static PetscErrorCode SplitMakeNodes_Private(Bisection *mesh, EdgeTable *middles, PetscInt cell, PetscInt node[])
{
  const ElementType type = SplitElement(mesh);
  PetscInt          num  = mesh->corners;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(node, mesh->vertex[cell], num));
  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt *ends = ElementEdgeNodes(type, e);

    PetscCall(BisectionGrow(mesh));
    PetscCall(BisectionGetMiddle(mesh, middles, node[ends[0]], node[ends[1]], &node[num++]));
  }
  for (PetscInt f = 0; f < ElementNumFacets(type) && mesh->dim == 3; f++) {
    PetscInt corner[4], middle[4], ends[2];

    CellGetFace_Private(mesh, cell, f, corner);
    (void)SplitFindFace(middles, corner, middle);
    FaceChooseEnds_Private(middle, ends);
    PetscCall(BisectionGrow(mesh));
    PetscCall(BisectionGetMiddle(mesh, middles, ends[0], ends[1], &node[num++]));
  }
  PetscCall(BisectionGrow(mesh));
  node[num]                = mesh->num_vertices++;
  mesh->ends[node[num]][0] = mesh->ends[node[num]][1] = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The node of order 2 halfway between two corners. */
static PetscInt NodeBetween_Private(ElementType linear, PetscInt a, PetscInt b)
{
  const ElementType type = ElementOfOrder(linear, 2);
  const PetscReal  *xa = ElementNode(linear, a), *xb = ElementNode(linear, b);
  PetscInt          k = 0;

  for (; k < ElementNumNodes(type); k++) {
    PetscBool same = PETSC_TRUE;

    for (PetscInt d = 0; d < ElementDim(type); d++)
      same = (PetscBool)(same && ElementNode(type, k)[d] == (xa[d] + xb[d]) / 2);
    if (same) break;
  }
  return k;
}

static PetscBool FacetHasCorner_Private(ElementType linear, PetscInt facet, PetscInt corner)
{
  const PetscInt *local = ElementFacetNodes(linear, facet);

  for (PetscInt i = 0; i < ElementNumNodes(ElementFacetType(linear)); i++)
    if (local[i] == corner) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Writes child k. [in] node - of the cell, of order 2 */
static void SplitSetChild_Private(Bisection *mesh, PetscInt cell, PetscInt k, const PetscInt node[], PetscInt child)
{
  const ElementType type = SplitElement(mesh), high = ElementOfOrder(type, 2);
  const PetscInt    num = mesh->corners;
  PetscInt          facet[MAX_CORNERS];
  PetscReal         place[MAX_CORNERS][MAX_CORNERS], phi[ELEMENT_MAX_NODES];

  for (PetscInt i = 0; i < num; i++) {
    facet[i] = i < ElementNumFacets(type) && FacetHasCorner_Private(type, i, k) ? mesh->facet[cell][i] : -1;
    ElementShape(type, ElementNode(high, NodeBetween_Private(type, k, i)), phi, NULL);
    for (PetscInt j = 0; j < num; j++) {
      place[i][j] = 0;
      for (PetscInt l = 0; l < num; l++) place[i][j] += phi[l] * BisectionGetPlace(mesh, cell, l)[j];
    }
  }
  for (PetscInt i = 0; i < num; i++) {
    mesh->vertex[child][i] = node[NodeBetween_Private(type, k, i)];
    mesh->facet[child][i]  = facet[i];
    for (PetscInt j = 0; j < num; j++) BisectionGetPlace(mesh, child, i)[j] = place[i][j];
  }
  mesh->generation[child] = mesh->generation[cell] + 1;
  mesh->goal[child]       = mesh->goal[cell];
  mesh->parent[child]     = mesh->parent[cell];
  mesh->marks[child]      = 0;
}

/* The first child takes the place of the cell, the others come last. */
static PetscErrorCode SplitCell_Private(Bisection *mesh, EdgeTable *middles, PetscInt cell)
{
  PetscInt node[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(SplitMakeNodes_Private(mesh, middles, cell, node));
  for (PetscInt k = mesh->corners - 1; k > 0; k--) {
    PetscCall(BisectionGrow(mesh));
    SplitSetChild_Private(mesh, cell, k, node, mesh->num_cells++);
  }
  SplitSetChild_Private(mesh, cell, 0, node, cell);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a chosen cell that has been split more often touches a cell: in a vertex, or in the middle of an
   edge or face. [in] least - of each vertex, -1 where there is no such cell [num_vertices] */
static PetscBool SplitMustFollow_Private(const Bisection *mesh, const EdgeTable *middles, const PetscInt least[],
                                         PetscInt cell)
{
  const ElementType type = SplitElement(mesh);

  for (PetscInt k = 0; k < mesh->corners; k++)
    if (least[mesh->vertex[cell][k]] > mesh->generation[cell]) return PETSC_TRUE;
  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt *ends   = ElementEdgeNodes(type, e);
    const PetscInt  middle = EdgeTableFind(middles, mesh->vertex[cell][ends[0]], mesh->vertex[cell][ends[1]]);

    if (middle >= 0 && least[middle] > mesh->generation[cell]) return PETSC_TRUE;
  }
  for (PetscInt f = 0; f < ElementNumFacets(type) && mesh->dim == 3; f++) {
    PetscInt corner[4], middle[4], found;

    CellGetFace_Private(mesh, cell, f, corner);
    found = SplitFindFace(middles, corner, middle);
    if (found >= 0 && least[found] > mesh->generation[cell]) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Adds cells that touch a chosen one and have been split less often. [in,out] chosen - [num_cells]; [in,out]
   least - work, -1 [num_vertices]; [out] any - whether there are such cells */
static void SplitSpread_Private(const Bisection *mesh, const EdgeTable *middles, PetscBool chosen[], PetscInt least[],
                                PetscBool *any)
{
  *any = PETSC_FALSE;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt k = 0; k < mesh->corners && chosen[c]; k++)
      least[mesh->vertex[c][k]] = PetscMax(least[mesh->vertex[c][k]], mesh->generation[c]);
  }
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    if (chosen[c]) continue;
    chosen[c] = SplitMustFollow_Private(mesh, middles, least, c);
    *any      = (PetscBool)(*any || chosen[c]);
  }
}

/* Splits cells once. [in,out] chosen - [num_cells], then with those that have to be split as well */
static PetscErrorCode SplitRound_Private(Bisection *mesh, EdgeTable *middles, PetscBool chosen[])
{
  const PetscInt num = mesh->num_cells;
  PetscBool      any = PETSC_TRUE;
  PetscInt      *least;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(mesh->num_vertices, &least));
  for (PetscInt v = 0; v < mesh->num_vertices; v++) least[v] = -1;
  while (any) SplitSpread_Private(mesh, middles, chosen, least, &any);
  PetscCall(PetscFree(least));
  for (PetscInt c = 0; c < num; c++)
    if (chosen[c]) PetscCall(SplitCell_Private(mesh, middles, c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SplitRefineMore(Bisection *mesh, const PetscInt marked[])
{
  EdgeTable middles;
  PetscBool any = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(SplitGetMiddles(mesh, &middles));
  for (PetscInt c = 0; c < mesh->num_cells; c++) mesh->goal[c] = mesh->generation[c] + marked[c];
  while (any) {
    PetscBool *chosen;

    any = PETSC_FALSE;
    PetscCall(PetscMalloc1(mesh->num_cells, &chosen));
    for (PetscInt c = 0; c < mesh->num_cells; c++) {
      chosen[c] = (PetscBool)(mesh->generation[c] < mesh->goal[c]);
      any       = (PetscBool)(any || chosen[c]);
    }
    if (any) PetscCall(SplitRound_Private(mesh, &middles, chosen));
    PetscCall(PetscFree(chosen));
  }
  PetscCall(BisectionSort(mesh));
  PetscCall(EdgeTableDestroy(&middles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SplitRefine(Bisection *mesh, const PetscInt marked[])
{
  PetscFunctionBeginUser;
  BisectionSetParents(mesh);
  PetscCall(SplitRefineMore(mesh, marked));
  PetscFunctionReturn(PETSC_SUCCESS);
}
