/* split.c -- quadrilaterals split into four, with hanging vertices (see bisect.h).

   Child k keeps corner k of its parent in the place k, so that all descendants of a cell turn the same way.
   Cells that are to be split together are found first. A cell must not be split before those that touch it in
   a point and have been split less often. */
#include "kernel/bisectimpl.h"
#include "base/compat.h"

enum { CORNERS = 4 };

PetscErrorCode SplitCreate(PetscInt num_vertices, PetscInt num_cells, const PetscInt cells[], const PetscInt facets[],
                           Bisection *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(BisectionBegin(2, CORNERS, num_vertices, num_cells, cells, facets, mesh));
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

/* Writes child k. [in] edge - middles of the cell's edges; middle - of the cell */
static void SplitSetChild_Private(Bisection *mesh, PetscInt cell, PetscInt k, const PetscInt edge[], PetscInt middle,
                                  PetscInt child)
{
  const PetscInt next = (k + 1) % CORNERS, opposite = (k + 2) % CORNERS, last = (k + 3) % CORNERS;
  PetscInt       vertex[CORNERS], facet[CORNERS] = {-1, -1, -1, -1};
  PetscReal      place[CORNERS][CORNERS];

  vertex[k]        = mesh->vertex[cell][k];
  vertex[next]     = edge[k];
  vertex[opposite] = middle;
  vertex[last]     = edge[last];
  facet[k]         = mesh->facet[cell][k];
  facet[last]      = mesh->facet[cell][last];
  for (PetscInt j = 0; j < CORNERS; j++) {
    const PetscReal here = mesh->place[cell][k][j];

    place[k][j]        = here;
    place[next][j]     = (here + mesh->place[cell][next][j]) / 2;
    place[last][j]     = (here + mesh->place[cell][last][j]) / 2;
    place[opposite][j] = (place[next][j] + (mesh->place[cell][opposite][j] + mesh->place[cell][last][j]) / 2) / 2;
  }
  for (PetscInt i = 0; i < CORNERS; i++) {
    mesh->vertex[child][i] = vertex[i];
    mesh->facet[child][i]  = facet[i];
    for (PetscInt j = 0; j < CORNERS; j++) mesh->place[child][i][j] = place[i][j];
  }
  mesh->generation[child] = mesh->generation[cell] + 1;
  mesh->goal[child]       = mesh->goal[cell];
  mesh->parent[child]     = mesh->parent[cell];
  mesh->marks[child]      = 0;
}

/* The first child takes the place of the cell, the others come last. */
static PetscErrorCode SplitCell_Private(Bisection *mesh, EdgeTable *middles, PetscInt cell)
{
  PetscInt edge[CORNERS], middle;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < CORNERS; k++) {
    PetscCall(BisectionGrow(mesh));
    PetscCall(
        BisectionGetMiddle(mesh, middles, mesh->vertex[cell][k], mesh->vertex[cell][(k + 1) % CORNERS], &edge[k]));
  }
  PetscCall(BisectionGrow(mesh));
  middle                = mesh->num_vertices++;
  mesh->ends[middle][0] = mesh->ends[middle][1] = -1;
  for (PetscInt k = CORNERS - 1; k > 0; k--) {
    PetscCall(BisectionGrow(mesh));
    SplitSetChild_Private(mesh, cell, k, edge, middle, mesh->num_cells++);
  }
  SplitSetChild_Private(mesh, cell, 0, edge, middle, cell);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds cells that touch a chosen one and have been split less often. [in,out] chosen - [num_cells]; [in,out]
   least - work, -1 [num_vertices]; [out] any - whether there are such cells */
static void SplitSpread_Private(const Bisection *mesh, const EdgeTable *middles, PetscBool chosen[], PetscInt least[],
                                PetscBool *any)
{
  *any = PETSC_FALSE;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt k = 0; k < CORNERS && chosen[c]; k++)
      least[mesh->vertex[c][k]] = PetscMax(least[mesh->vertex[c][k]], mesh->generation[c]);
  }
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt k = 0; k < CORNERS && !chosen[c]; k++) {
      const PetscInt a = mesh->vertex[c][k], middle = EdgeTableFind(middles, a, mesh->vertex[c][(k + 1) % CORNERS]);

      chosen[c] = (PetscBool)(least[a] > mesh->generation[c] || (middle >= 0 && least[middle] > mesh->generation[c]));
      *any      = (PetscBool)(*any || chosen[c]);
    }
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
