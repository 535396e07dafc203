/* test_split.c -- random splittings of quadrilaterals, also around vertices of three and of more cells. Cells
   that touch differ by one splitting at most. Vertices hang on edges whose ends do not. Area and sides are
   kept, no numbering matters. Takes the number of meshes. */
#include "kernel/bisect.h"
#include "base/compat.h"
#include <stdlib.h>
#include <string.h>
#include <test.h>

#include "uniform.h"

enum { Q = 4, MAX_GRID = 4, NUM_MESHES = 60, NUM_ROUNDS = 7, MAX_CELLS = 20000 };

/* The unit square. Edges have the number 2 d + end of the side that they are on. */
typedef struct {
  PetscInt  num_vertices, num_cells, cells[MAX_GRID * MAX_GRID * 6 * Q], facets[MAX_GRID * MAX_GRID * 6 * Q];
  PetscReal coords[MAX_GRID * MAX_GRID * 20 * 2];
} Square;

static PetscInt SideOf(const PetscReal a[], const PetscReal b[])
{
  for (PetscInt d = 0; d < 2; d++) {
    for (PetscInt end = 0; end < 2; end++)
      if (a[d] == (PetscReal)end && b[d] == (PetscReal)end) return 2 * d + end;
  }
  return -1;
}

static PetscInt VertexAt(Square *square, PetscReal x, PetscReal y)
{
  PetscInt v = 0;

  while (v < square->num_vertices &&
         PetscAbsReal(square->coords[2 * v] - x) + PetscAbsReal(square->coords[2 * v + 1] - y) > 1e-9)
    v++;
  if (v == square->num_vertices) {
    square->coords[2 * v]     = x;
    square->coords[2 * v + 1] = y;
    square->num_vertices++;
  }
  return v;
}

/* [in] x - of the corners around it */
static void AddCell(Square *square, PetscReal x[Q][2])
{
  const PetscInt first = (PetscInt)Uniform(0, Q - .001); // any corner may be the first one

  for (PetscInt i = 0; i < Q; i++) {
    const PetscReal *a = x[(first + i) % Q], *b = x[(first + i + 1) % Q];

    square->cells[square->num_cells * Q + i]  = VertexAt(square, a[0], a[1]);
    square->facets[square->num_cells * Q + i] = SideOf(a, b);
  }
  square->num_cells++;
}

/* Of n x n cells; or of two triangles in each, of three quadrilaterals. */
static void SquareCreate(PetscInt n, PetscBool thirds, Square *square)
{
  const PetscReal h = 1 / (PetscReal)n;

  *square = (Square){.num_cells = 0};
  for (PetscInt c = 0; c < n * n; c++) {
    const PetscReal x = (PetscReal)(c % n) * h, y = (PetscReal)(c / n) * h;

    if (!thirds) AddCell(square, (PetscReal[Q][2]){{x, y}, {x + h, y}, {x + h, y + h}, {x, y + h}});
    for (PetscInt half = 0; half < 2 && thirds; half++) {
      PetscReal v[3][2] = {{x, y}, {x + h, y}, {x + h, y + h}}, middle[2];

      if (half) memcpy(v[1], (PetscReal[2]){x + h, y + h}, sizeof(v[1]));
      if (half) memcpy(v[2], (PetscReal[2]){x, y + h}, sizeof(v[2]));
      for (PetscInt d = 0; d < 2; d++) middle[d] = (v[0][d] + v[1][d] + v[2][d]) / 3;
      for (PetscInt i = 0; i < 3; i++) {
        const PetscReal *a = v[i], *b = v[(i + 1) % 3], *e = v[(i + 2) % 3];

        AddCell(square, (PetscReal[Q][2]){{a[0], a[1]},
                                          {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2},
                                          {middle[0], middle[1]},
                                          {(a[0] + e[0]) / 2, (a[1] + e[1]) / 2}});
      }
    }
  }
  for (PetscInt i = 0; i < square->num_cells * Q; i++) { // sides are exact
    PetscReal *x = &square->coords[2 * square->cells[i]];

    for (PetscInt d = 0; d < 2; d++) x[d] = PetscAbsReal(x[d] - 1) < 1e-9 ? 1 : x[d];
  }
}

/* Cells in another order. */
static void Shuffle(Square *square)
{
  for (PetscInt c = square->num_cells - 1; c > 0; c--) {
    const PetscInt other = (PetscInt)Uniform(0, (PetscReal)c + .999);

    for (PetscInt i = 0; i < Q; i++) {
      PetscInt swap = square->cells[c * Q + i];

      square->cells[c * Q + i]      = square->cells[other * Q + i];
      square->cells[other * Q + i]  = swap;
      swap                          = square->facets[c * Q + i];
      square->facets[c * Q + i]     = square->facets[other * Q + i];
      square->facets[other * Q + i] = swap;
    }
  }
}

/* Positions of the vertices, and of those before. */
typedef struct {
  Bisection mesh;
  PetscReal x[MAX_CELLS * 4 * 2];
} Split;

/* Positions of new vertices by their places in parents. [in] before - vertices of the parents; known - vertices with positions */
static void SetPositions(Split *split, PetscInt before[][BISECT_MAX_VERTICES], PetscInt known)
{
  const Bisection *mesh = &split->mesh;

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    CHECK(c == 0 || mesh->parent[c] >= mesh->parent[c - 1]);
    for (PetscInt i = 0; i < Q; i++) {
      for (PetscInt d = 0; d < 2; d++) {
        PetscReal *x = &split->x[2 * mesh->vertex[c][i] + d], at = 0;

        for (PetscInt j = 0; j < Q; j++)
          at += BisectionGetPlace(mesh, c, i)[j] * split->x[2 * before[mesh->parent[c]][j] + d];
        if (mesh->vertex[c][i] < known)
          CHECK_NEAR(*x, at, 1e-13);
        else
          *x = at;
      }
    }
  }
  for (PetscInt v = known; v < mesh->num_vertices; v++) {
    for (PetscInt d = 0; d < 2 && mesh->ends[v][0] >= 0; d++)
      CHECK_NEAR(split->x[2 * v + d], (split->x[2 * mesh->ends[v][0] + d] + split->x[2 * mesh->ends[v][1] + d]) / 2,
                 1e-13);
  }
}

/* Cells at each point, and which vertices hang. */
static PetscErrorCode CheckBalance(const Bisection *mesh)
{
  EdgeTable  middles, edges = {.room = 0};
  PetscInt  *least, *most, *count;
  PetscBool *hangs;

  PetscFunctionBeginUser;
  PetscCall(SplitGetMiddles(mesh, &middles));
  PetscCall(PetscMalloc4(mesh->num_vertices, &least, mesh->num_vertices, &most, mesh->num_vertices, &hangs,
                         mesh->num_cells * Q, &count));
  for (PetscInt v = 0; v < mesh->num_vertices; v++) {
    least[v] = PETSC_MAX_INT;
    most[v]  = -1;
    hangs[v] = PETSC_FALSE;
  }
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt i = 0; i < Q; i++) {
      const PetscInt a = mesh->vertex[c][i], b = mesh->vertex[c][(i + 1) % Q], middle = EdgeTableFind(&middles, a, b);
      PetscInt       at[2], found;

      at[0] = a;
      at[1] = middle < 0 ? a : middle;
      if (middle >= 0) hangs[middle] = PETSC_TRUE;
      for (PetscInt k = 0; k < 2; k++) {
        least[at[k]] = PetscMin(least[at[k]], mesh->generation[c]);
        most[at[k]]  = PetscMax(most[at[k]], mesh->generation[c]);
      }
      PetscCall(EdgeTableAdd(&edges, a, b, edges.num));
      found = EdgeTableFind(&edges, a, b);
      if (found == edges.num - 1) count[found] = 0;
    }
  }
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt i = 0; i < Q; i++) count[EdgeTableFind(&edges, mesh->vertex[c][i], mesh->vertex[c][(i + 1) % Q])]++;
  }
  for (PetscInt v = 0; v < mesh->num_vertices; v++) CHECK(most[v] - least[v] <= 1);
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt i = 0; i < Q; i++) {
      const PetscInt a = mesh->vertex[c][i], b = mesh->vertex[c][(i + 1) % Q], middle = EdgeTableFind(&middles, a, b);
      const PetscInt same = count[EdgeTableFind(&edges, a, b)];
      PetscBool      half = PETSC_FALSE; // of an edge that a cell has

      for (PetscInt k = 0; k < 2; k++) {
        const PetscInt *ends = mesh->ends[k ? b : a];

        half = (PetscBool)(half || ((ends[0] == (k ? a : b) || ends[1] == (k ? a : b)) &&
                                    EdgeTableFind(&edges, ends[0], ends[1]) >= 0));
      }
      if (middle >= 0) {
        CHECK(!hangs[a] && !hangs[b]);
        CHECK(EdgeTableFind(&edges, a, middle) >= 0 && EdgeTableFind(&edges, middle, b) >= 0);
      }
      CHECK(same <= 2);
      CHECK((same == 1) == (mesh->facet[c][i] >= 0 || middle >= 0 || half));
      CHECK((mesh->facet[c][i] >= 0) + (middle >= 0) + half <= 1);
    }
  }
  PetscCall(PetscFree4(least, most, hangs, count));
  PetscCall(EdgeTableDestroy(&middles));
  PetscCall(EdgeTableDestroy(&edges));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The area, with the sense of the first cells; and that edges of a side are on that side. */
static void CheckArea(const Split *split)
{
  const Bisection *mesh = &split->mesh;
  long double      area = 0;

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    CHECK(!BisectionIsTurned(mesh, c));
    for (PetscInt i = 0; i < Q; i++) {
      const PetscReal *a = &split->x[2 * mesh->vertex[c][i]], *b = &split->x[2 * mesh->vertex[c][(i + 1) % Q]];

      area += (a[0] * b[1] - b[0] * a[1]) / 2;
      if (mesh->facet[c][i] >= 0) CHECK(SideOf(a, b) == mesh->facet[c][i]);
    }
  }
  CHECK_NEAR((PetscReal)area, 1, 1e-13);
}

static int CompareMiddles(const void *a, const void *b)
{
  const PetscReal *p = a, *q = b;

  for (PetscInt k = 0; k < 2; k++) {
    if (PetscAbsReal(p[k] - q[k]) > 1e-10) return p[k] < q[k] ? -1 : 1;
  }
  return 0;
}

static void GetMiddle(const Split *split, PetscInt c, PetscReal middle[2])
{
  for (PetscInt d = 0; d < 2; d++) {
    middle[d] = 0;
    for (PetscInt i = 0; i < Q; i++) middle[d] += split->x[2 * split->mesh.vertex[c][i] + d] / Q;
  }
}

static void CheckSame(const Split *a, const Split *b)
{
  const PetscInt num = a->mesh.num_cells;
  PetscReal(*p)[2] = calloc((size_t)num, sizeof(*p)), (*q)[2] = calloc((size_t)num, sizeof(*q));

  CHECK(num == b->mesh.num_cells && a->mesh.num_vertices == b->mesh.num_vertices);
  for (PetscInt c = 0; c < num; c++) {
    GetMiddle(a, c, p[c]);
    GetMiddle(b, c, q[c]);
  }
  qsort(p, (size_t)num, sizeof(*p), CompareMiddles);
  qsort(q, (size_t)num, sizeof(*q), CompareMiddles);
  for (PetscInt c = 0; c < num; c++) CHECK(!CompareMiddles(p[c], q[c]));
  free(p);
  free(q);
}

/* One refinement around a place, some cells twice. Parents that stay whole touch no cell that asked for more. */
static PetscErrorCode Step(const PetscReal centre[2], PetscReal radius, Split *split)
{
  Bisection     *mesh  = &split->mesh;
  const PetscInt known = mesh->num_vertices;
  PetscInt      *marked;
  PetscInt(*before)[BISECT_MAX_VERTICES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(mesh->num_cells, &marked, mesh->num_cells, &before));
  memcpy(before, mesh->vertex, (size_t)mesh->num_cells * sizeof(*before));
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscReal middle[2], distance;

    GetMiddle(split, c, middle);
    distance  = PetscSqrtReal(PetscSqr(middle[0] - centre[0]) + PetscSqr(middle[1] - centre[1]));
    marked[c] = distance < radius ? (distance < radius / 3 ? 2 : 1) : 0;
  }
  PetscCall(SplitRefine(mesh, marked));
  for (PetscInt c = 0, children = 0; c < mesh->num_cells; c++) {
    children = c && mesh->parent[c] == mesh->parent[c - 1] ? children + 1 : 1;
    if (c + 1 == mesh->num_cells || mesh->parent[c + 1] != mesh->parent[c])
      CHECK(children >= (marked[mesh->parent[c]] == 2 ? 16 : marked[mesh->parent[c]] ? 4 : 1) && children % 3 == 1);
  }
  CHECK(mesh->num_vertices <= MAX_CELLS * 4);
  SetPositions(split, before, known);
  PetscCall(PetscFree2(marked, before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A mesh and the same with its cells in another order. */
static PetscErrorCode TestMesh(PetscInt n, PetscBool thirds)
{
  static Square square;
  static Split  a, b;

  PetscFunctionBeginUser;
  SquareCreate(n, thirds, &square);
  PetscCall(SplitCreate(2, square.num_vertices, square.num_cells, square.cells, square.facets, &a.mesh));
  Shuffle(&square);
  PetscCall(SplitCreate(2, square.num_vertices, square.num_cells, square.cells, square.facets, &b.mesh));
  memcpy(a.x, square.coords, sizeof(square.coords));
  memcpy(b.x, square.coords, sizeof(square.coords));
  for (PetscInt round = 0; round < NUM_ROUNDS && a.mesh.num_cells < MAX_CELLS / 16; round++) {
    const PetscReal centre[2] = {Uniform(0, 1), Uniform(0, 1)}, radius = Uniform(.02, .3);

    PetscCall(Step(centre, radius, &a));
    PetscCall(Step(centre, radius, &b));
    PetscCall(CheckBalance(&a.mesh));
    CheckArea(&a);
    CheckSame(&a, &b);
  }
  PetscCall(BisectionDestroy(&a.mesh));
  PetscCall(BisectionDestroy(&b.mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One cell of 4 x 4 is split alone; one of its parts takes the three neighbours of that corner with it. */
static PetscErrorCode TestLeast(void)
{
  static Square square;
  Bisection     mesh;
  PetscInt      marked[64] = {0};

  PetscFunctionBeginUser;
  SquareCreate(4, PETSC_FALSE, &square);
  PetscCall(SplitCreate(2, square.num_vertices, square.num_cells, square.cells, square.facets, &mesh));
  marked[5] = 1;
  PetscCall(SplitRefine(&mesh, marked));
  CHECK(mesh.num_cells == 19);
  memset(marked, 0, sizeof(marked));
  marked[5] = 1; // the first of four parts, which are numbers 5 to 8
  PetscCall(SplitRefine(&mesh, marked));
  CHECK(mesh.num_cells == 19 + 3 + 3 * 3);
  PetscCall(BisectionDestroy(&mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const PetscInt num = argc > 1 && atoi(argv[1]) > 0 ? atoi(argv[1]) : NUM_MESHES;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(TestLeast());
  for (PetscInt i = 0; i < num; i++) PetscCall(TestMesh(1 + i % MAX_GRID, (PetscBool)(i % 2)));
  PetscCall(PetscFinalize());
  return 0;
}
