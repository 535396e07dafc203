/* test_bisect.c -- random refinements of bricks: conforming, volume and sides kept, shapes bounded, independent of numbering. Takes the number of
   meshes, for longer tests by hand. */
#include "kernel/bisect.h"
#include "base/compat.h"
#include <stdlib.h>
#include <string.h>
#include <test.h>

#include "uniform.h"

enum { MAX_GRID = 4, MAX_SHAPES = 64, NUM_MESHES = 20, NUM_ROUNDS = 6, MAX_CELLS = 20000 };

/* A mesh of a unit cube or square: bricks cut into simplices. Facets have the number 2 d + end of the side of the cube that they are on. */
typedef struct {
  PetscInt   dim, num_vertices, num_cells;
  PetscInt  *cells, *facets;
  PetscReal *coords;
} Brick;

/* The paths along the axes from one corner of a brick to the opposite one [dim][path][step]. */
static const PetscInt Paths[4][6][3] = {
    [2] = {{0, 1}, {1, 0}}, [3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

static PetscInt GridVertex(PetscInt dim, PetscInt n, const PetscInt at[])
{
  PetscInt v = 0;

  for (PetscInt d = dim - 1; d >= 0; d--) v = v * (n + 1) + at[d];
  return v;
}

/* The side of the cube that all vertices but one are on, or -1. [in] at - of the cell's vertices [dim+1][3] */
static PetscInt SideOf(PetscInt dim, PetscInt n, PetscInt at[][3], PetscInt opposite)
{
  for (PetscInt d = 0; d < dim; d++) {
    for (PetscInt end = 0; end < 2; end++) {
      PetscInt on = 0;

      for (PetscInt i = 0; i <= dim; i++) on += i != opposite && at[i][d] == end * n;
      if (on == dim) return 2 * d + end;
    }
  }
  return -1;
}

/* [in] shake - by which part of a brick inner vertices are moved at most */
static Brick BrickCreate(PetscInt dim, PetscInt n, PetscReal shake)
{
  Brick    brick = {.dim = dim, .num_vertices = 1, .num_cells = dim == 2 ? 2 : 6};
  PetscInt cell = 0, num_bricks = 1, num_paths = brick.num_cells;

  for (PetscInt d = 0; d < dim; d++) {
    brick.num_vertices *= n + 1;
    num_bricks *= n;
  }
  brick.num_cells = num_bricks * num_paths;
  brick.cells     = malloc((size_t)(brick.num_cells * (dim + 1)) * sizeof(PetscInt));
  brick.facets    = malloc((size_t)(brick.num_cells * (dim + 1)) * sizeof(PetscInt));
  brick.coords    = malloc((size_t)(brick.num_vertices * dim) * sizeof(PetscReal));
  for (PetscInt v = 0; v < brick.num_vertices; v++) {
    PetscInt rest = v;

    for (PetscInt d = 0; d < dim; d++, rest /= n + 1) {
      const PetscInt i = rest % (n + 1);

      brick.coords[v * dim + d] = ((PetscReal)i + (i > 0 && i < n ? Uniform(-shake, shake) : 0)) / (PetscReal)n;
    }
  }
  for (PetscInt b = 0; b < num_bricks; b++) {
    for (PetscInt p = 0; p < num_paths; p++, cell++) {
      PetscInt at[4][3] = {{b % n, b / n % n, b / n / n}};

      for (PetscInt i = 1; i <= dim; i++) {
        memcpy(at[i], at[i - 1], sizeof(at[i]));
        at[i][Paths[dim][p][i - 1]]++;
      }
      for (PetscInt i = 0; i <= dim; i++) {
        brick.cells[cell * (dim + 1) + i]  = GridVertex(dim, n, at[i]);
        brick.facets[cell * (dim + 1) + i] = SideOf(dim, n, at, i);
      }
    }
  }
  return brick;
}

static void BrickDestroy(Brick *brick)
{
  free(brick->cells);
  free(brick->facets);
  free(brick->coords);
}

/* Positions of all vertices, the first of which are known. */
static PetscReal *Positions(const Bisection *mesh, const Brick *brick)
{
  PetscReal *x = malloc((size_t)(mesh->num_vertices * mesh->dim) * sizeof(PetscReal));

  memcpy(x, brick->coords, (size_t)(brick->num_vertices * mesh->dim) * sizeof(PetscReal));
  for (PetscInt v = brick->num_vertices; v < mesh->num_vertices; v++) {
    for (PetscInt d = 0; d < mesh->dim; d++)
      x[v * mesh->dim + d] = (x[mesh->ends[v][0] * mesh->dim + d] + x[mesh->ends[v][1] * mesh->dim + d]) / 2;
  }
  return x;
}

/* Of a cell, or of a facet with the vertex opposite left out: dim! times its volume, (dim-1)! times its area. */
static PetscReal CellVolume(const Bisection *mesh, const PetscReal x[], PetscInt cell)
{
  PetscReal e[3][3] = {{0}};

  for (PetscInt i = 0; i < mesh->dim; i++) {
    for (PetscInt d = 0; d < mesh->dim; d++)
      e[i][d] = x[mesh->vertex[cell][i + 1] * mesh->dim + d] - x[mesh->vertex[cell][0] * mesh->dim + d];
  }
  if (mesh->dim == 2) return PetscAbsReal(e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return PetscAbsReal(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                      e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                      e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
}

static int CompareFacets(const void *a, const void *b)
{
  return memcmp(a, b, 3 * sizeof(PetscInt));
}

static void SortVertices(PetscInt num, PetscInt v[])
{
  for (PetscInt i = 1; i < num; i++) {
    for (PetscInt j = i; j > 0 && v[j] < v[j - 1]; j--) {
      const PetscInt swap = v[j];

      v[j]     = v[j - 1];
      v[j - 1] = swap;
    }
  }
}

/* Every facet has one cell and a number, or two cells and none: a vertex that hangs would leave one without either. */
static void CheckConforming(const Bisection *mesh)
{
  const PetscInt num  = mesh->num_cells * (mesh->dim + 1);
  PetscInt(*facet)[4] = calloc((size_t)num, sizeof(*facet)); // sorted vertices, the number

  for (PetscInt c = 0, f = 0; c < mesh->num_cells; c++) {
    for (PetscInt i = 0; i <= mesh->dim; i++, f++) {
      PetscInt n = 0;

      for (PetscInt j = 0; j <= mesh->dim; j++) {
        if (j != i) facet[f][n++] = mesh->vertex[c][j];
      }
      SortVertices(mesh->dim, facet[f]);
      facet[f][3] = mesh->facet[c][i];
    }
  }
  qsort(facet, (size_t)num, sizeof(*facet), CompareFacets);
  for (PetscInt f = 0; f < num;) {
    PetscInt same = 1;

    while (f + same < num && !CompareFacets(facet[f], facet[f + same])) same++;
    CHECK(same <= 2);
    CHECK((facet[f][3] >= 0) == (same == 1));
    f += same;
  }
  free(facet);
}

/* The volume; and that facets of a side are on that side. */
static void CheckVolume(const Bisection *mesh, const PetscReal x[])
{
  long double volume = 0; // sums of 20000 cells would have errors of their own

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    volume += CellVolume(mesh, x, c) / (mesh->dim == 2 ? 2 : 6);
    for (PetscInt i = 0; i <= mesh->dim; i++) {
      const PetscInt side = mesh->facet[c][i];

      for (PetscInt j = 0; j <= mesh->dim && side >= 0; j++) {
        if (j != i) CHECK(x[mesh->vertex[c][j] * mesh->dim + side / 2] == side % 2);
      }
    }
  }
  CHECK_NEAR((PetscReal)volume, 1, 1e-13);
}

/* Places in parents lead to the vertices. [in] before - vertices of the parents */
static void CheckPlaces(const Bisection *mesh, const PetscReal x[], PetscInt before[][BISECT_MAX_VERTICES])
{
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    CHECK(c == 0 || mesh->parent[c] >= mesh->parent[c - 1]);
    for (PetscInt i = 0; i <= mesh->dim; i++) {
      for (PetscInt d = 0; d < mesh->dim; d++) {
        PetscReal at = 0;

        for (PetscInt j = 0; j <= mesh->dim; j++)
          at += BisectionGetPlace(mesh, c, i)[j] * x[before[mesh->parent[c]][j] * mesh->dim + d];
        CHECK_NEAR(at, x[mesh->vertex[c][i] * mesh->dim + d], 1e-14);
      }
    }
  }
}

/* Volume over the cube of the root of the mean squared edge, 1 for a regular cell. */
static PetscReal CellQuality(const Bisection *mesh, const PetscReal x[], PetscInt cell)
{
  const PetscInt num_edges = mesh->dim * (mesh->dim + 1) / 2;
  PetscReal      mean      = 0;

  for (PetscInt i = 0; i <= mesh->dim; i++) {
    for (PetscInt j = 0; j < i; j++) {
      for (PetscInt d = 0; d < mesh->dim; d++)
        mean += PetscSqr(x[mesh->vertex[cell][i] * mesh->dim + d] - x[mesh->vertex[cell][j] * mesh->dim + d]) /
                (PetscReal)num_edges;
    }
  }
  return CellVolume(mesh, x, cell) / (mesh->dim == 2 ? PetscSqrtReal(0.75) * mean : PetscSqrtReal(0.5 * mean) * mean);
}

/* Bricks have few shapes for ever; others are never much worse than the worst of their roots. */
static void CheckShapes(const Bisection *mesh, const PetscReal x[], PetscReal shake, PetscReal worst_root)
{
  PetscReal quality[MAX_SHAPES], worst = 1;
  PetscInt  num = 0;

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    const PetscReal q = CellQuality(mesh, x, c);
    PetscInt        k = 0;

    worst = PetscMin(worst, q);
    while (k < num && PetscAbsReal(quality[k] - q) > 1e-6) k++;
    if (k == num && num < MAX_SHAPES) quality[num++] = q;
  }
  if (shake == 0) CHECK(num <= (mesh->dim == 2 ? 1 : 3));
  CHECK(worst >= .1 * worst_root);
}

/* Marks, by where cells are, so that no numbering matters: a place that moves, and sparse chance. */
static void MarkCells(const Bisection *mesh, const PetscReal x[], const PetscReal centre[], PetscReal radius,
                      PetscInt mark, PetscInt marked[])
{
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscReal distance = 0;

    for (PetscInt d = 0; d < mesh->dim; d++) {
      PetscReal middle = 0;

      for (PetscInt i = 0; i <= mesh->dim; i++)
        middle += x[mesh->vertex[c][i] * mesh->dim + d] / (PetscReal)(mesh->dim + 1);
      distance += PetscSqr(middle - centre[d]);
    }
    marked[c] = PetscSqrtReal(distance) < radius ? mark : 0;
  }
}

static int CompareCells(const void *a, const void *b)
{
  const PetscReal *p = a, *q = b;

  for (PetscInt k = 0; k < 3; k++) {
    if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
  }
  return 0;
}

/* Centres of all cells, sorted. */
static PetscReal (*Centres(const Bisection *mesh, const PetscReal x[]))[3]
{
  PetscReal(*centre)[3] = calloc((size_t)mesh->num_cells, sizeof(*centre));

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt d = 0; d < mesh->dim; d++) {
      PetscReal v[4] = {0, 0, 0, 0};

      for (PetscInt i = 0; i <= mesh->dim; i++) v[i] = x[mesh->vertex[c][i] * mesh->dim + d];
      PetscCallAbort(PETSC_COMM_SELF, PetscSortReal(mesh->dim + 1, v)); // the same sum in any order
      for (PetscInt i = 0; i <= mesh->dim; i++) centre[c][d] += v[i];
    }
  }
  qsort(centre, (size_t)mesh->num_cells, sizeof(*centre), CompareCells);
  return centre;
}

static void CheckSame(const Bisection *a, const PetscReal x[], const Bisection *b, const PetscReal y[])
{
  PetscReal(*p)[3] = Centres(a, x), (*q)[3] = Centres(b, y);

  CHECK(a->num_cells == b->num_cells);
  CHECK(a->num_vertices == b->num_vertices);
  for (PetscInt c = 0; c < a->num_cells; c++) CHECK(!CompareCells(p[c], q[c]));
  free(p);
  free(q);
}

/* The cells of a mesh in another order. */
static void Shuffle(Brick *brick)
{
  const PetscInt num = brick->dim + 1;

  for (PetscInt c = brick->num_cells - 1; c > 0; c--) {
    const PetscInt other = (PetscInt)Uniform(0, (PetscReal)c + .999);

    for (PetscInt i = 0; i < num; i++) {
      PetscInt swap = brick->cells[c * num + i];

      brick->cells[c * num + i]      = brick->cells[other * num + i];
      brick->cells[other * num + i]  = swap;
      swap                           = brick->facets[c * num + i];
      brick->facets[c * num + i]     = brick->facets[other * num + i];
      brick->facets[other * num + i] = swap;
    }
  }
}

/* One refinement around a place. */
static PetscErrorCode Step(const Brick *brick, const PetscReal centre[], PetscReal radius, PetscInt mark,
                           Bisection *mesh)
{
  PetscReal *x = Positions(mesh, brick), *y;
  PetscInt  *marked;
  PetscInt(*before)[BISECT_MAX_VERTICES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(mesh->num_cells, &marked, mesh->num_cells, &before));
  memcpy(before, mesh->vertex, (size_t)mesh->num_cells * sizeof(*before));
  MarkCells(mesh, x, centre, radius, mark, marked);
  PetscCall(BisectionRefine(mesh, marked));
  y = Positions(mesh, brick);
  CheckPlaces(mesh, y, before);
  free(x);
  free(y);
  PetscCall(PetscFree2(marked, before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A mesh and the same with its cells in another order, refined several times. */
static PetscErrorCode TestMesh(PetscInt dim, PetscInt n, PetscReal shake)
{
  Brick      brick = BrickCreate(dim, n, shake);
  Bisection  a, b;
  PetscReal *x, *y, worst = 1;

  PetscFunctionBeginUser;
  PetscCall(BisectionCreate(dim, brick.num_vertices, brick.num_cells, brick.cells, brick.facets, brick.coords, &a));
  Shuffle(&brick);
  PetscCall(BisectionCreate(dim, brick.num_vertices, brick.num_cells, brick.cells, brick.facets, brick.coords, &b));
  for (PetscInt c = 0; c < a.num_cells; c++) worst = PetscMin(worst, CellQuality(&a, brick.coords, c));
  for (PetscInt round = 0; round < NUM_ROUNDS && a.num_cells < MAX_CELLS; round++) {
    const PetscReal centre[3] = {Uniform(0, 1), Uniform(0, 1), Uniform(0, 1)};
    const PetscReal radius    = Uniform(.02, .4);
    const PetscInt  mark      = round % 2 ? -2 : 1; // every second time graded to vertices

    PetscCall(Step(&brick, centre, radius, mark, &a));
    PetscCall(Step(&brick, centre, radius, mark, &b));
    x = Positions(&a, &brick);
    y = Positions(&b, &brick);
    CheckConforming(&a);
    CheckVolume(&a, x);
    CheckShapes(&a, x, shake, worst);
    CheckSame(&a, x, &b, y);
    free(x);
    free(y);
  }
  PetscCall(BisectionDestroy(&a));
  PetscCall(BisectionDestroy(&b));
  BrickDestroy(&brick);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marked cells are bisected dim times: edges are halved, and there are 2^dim children where neighbours ask for no more. */
static PetscErrorCode TestUniform(PetscInt dim)
{
  Brick     brick = BrickCreate(dim, 2, 0);
  Bisection mesh;
  PetscInt *marked;

  PetscFunctionBeginUser;
  PetscCall(BisectionCreate(dim, brick.num_vertices, brick.num_cells, brick.cells, brick.facets, brick.coords, &mesh));
  PetscCall(PetscMalloc1(mesh.num_cells, &marked));
  for (PetscInt c = 0; c < mesh.num_cells; c++) marked[c] = PETSC_TRUE;
  PetscCall(BisectionRefine(&mesh, marked));
  CHECK(mesh.num_cells == brick.num_cells << dim);
  CHECK(mesh.num_vertices == (dim == 2 ? 25 : 125));
  PetscCall(PetscFree(marked));
  PetscCall(BisectionDestroy(&mesh));
  BrickDestroy(&brick);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks -3 at one vertex: its cells are halved four times there and once elsewhere. Where all cells have marks
   -2, all edges are halved twice. */
static PetscErrorCode TestGraded(PetscInt dim)
{
  Brick     brick = BrickCreate(dim, 4, 0);
  Bisection peak, all;
  PetscInt *marked, middle = 0, num = 0;

  PetscFunctionBeginUser;
  while (PetscAbsReal(brick.coords[middle * dim] - .5) + PetscAbsReal(brick.coords[middle * dim + 1] - .5) +
             PetscAbsReal(brick.coords[middle * dim + dim - 1] - .5) >
         .1)
    middle++;
  PetscCall(BisectionCreate(dim, brick.num_vertices, brick.num_cells, brick.cells, brick.facets, brick.coords, &peak));
  PetscCall(BisectionCreate(dim, brick.num_vertices, brick.num_cells, brick.cells, brick.facets, brick.coords, &all));
  PetscCall(PetscCalloc1(brick.num_cells, &marked));
  for (PetscInt c = 0; c < peak.num_cells; c++) {
    for (PetscInt i = 0; i <= dim; i++)
      if (peak.vertex[c][i] == middle) marked[c] = -3;
  }
  PetscCall(BisectionRefine(&peak, marked));
  CheckConforming(&peak);
  CHECK(BisectionGetHalvings(-3) == 4 && BisectionGetHalvings(-2) == 2 && BisectionGetHalvings(-1) == 1);
  for (PetscInt c = 0; c < peak.num_cells; c++) {
    for (PetscInt i = 0; i <= dim; i++) {
      if (peak.vertex[c][i] != middle) continue;
      num++;
      CHECK(peak.generation[c] == 4 * dim);
    }
  }
  CHECK(num > 0);
  CHECK(peak.num_cells < 4 * brick.num_cells); // six cells of the plane alone make 384 in three halvings, of 128
  for (PetscInt c = 0; c < brick.num_cells; c++) marked[c] = -2;
  PetscCall(BisectionRefine(&all, marked));
  CHECK(all.num_cells == brick.num_cells << 2 * dim);
  PetscCall(PetscFree(marked));
  PetscCall(BisectionDestroy(&peak));
  PetscCall(BisectionDestroy(&all));
  BrickDestroy(&brick);
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const PetscInt num = argc > 1 && atoi(argv[1]) > 0 ? atoi(argv[1]) : NUM_MESHES;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 2; dim <= 3; dim++) {
    PetscCall(TestUniform(dim));
    PetscCall(TestGraded(dim));
    for (PetscInt i = 0; i < num; i++) PetscCall(TestMesh(dim, 1 + i % MAX_GRID, i % 2 ? .15 : 0));
  }
  PetscCall(PetscFinalize());
  return 0;
}
