/* test_splitsolid.c -- random splittings of hexahedra. Cells that touch differ by one splitting at most.
   Corners of the edges and faces on which vertices hang do not hang. Volume and sides are kept, no numbering
   matters. */
#include "base/compat.h"
#include "kernel/bisect.h"
#include <string.h>
#include <test.h>

#include "uniform.h"

enum { Q = 8, N = 2, POINTS = (N + 1) * (N + 1) * (N + 1), CELLS = N * N * N, MAX_VERTICES = 40000, NUM_ROUNDS = 5 };

typedef struct {
  Bisection mesh;
  PetscReal x[3 * MAX_VERTICES];
} Solid;

static PetscInt CornerAt(const PetscReal xi[])
{
  PetscInt i = 0;

  while (ElementNode(ELEMENT_HEX8, i)[0] != xi[0] || ElementNode(ELEMENT_HEX8, i)[1] != xi[1] ||
         ElementNode(ELEMENT_HEX8, i)[2] != xi[2])
    i++;
  return i;
}

/* The unit cube; a facet on it has the number 2 d + end. [in] turn - axes by which corners are turned, and the order
   of cells */
static PetscErrorCode SolidCreate(PetscInt turn, Solid *solid)
{
  PetscInt cells[CELLS * Q], facets[CELLS * Q];

  PetscFunctionBeginUser;
  for (PetscInt v = 0; v < POINTS; v++) {
    const PetscInt at[3] = {v % (N + 1), v / (N + 1) % (N + 1), v / (N + 1) / (N + 1)};

    for (PetscInt d = 0; d < 3; d++) solid->x[3 * v + d] = (PetscReal)at[d] / N;
  }
  for (PetscInt c = 0; c < CELLS; c++) {
    const PetscInt place = turn ? CELLS - 1 - c : c, low[3] = {c % N, c / N % N, c / N / N};
    PetscInt      *cell = &cells[place * Q], corner[Q];

    for (PetscInt i = 0; i < Q; i++) {
      const PetscReal *r = ElementNode(ELEMENT_HEX8, i);

      corner[i] = low[0] + (PetscInt)r[0] + (N + 1) * (low[1] + (PetscInt)r[1] + (N + 1) * (low[2] + (PetscInt)r[2]));
    }
    for (PetscInt i = 0; i < Q; i++) {
      const PetscReal *r = ElementNode(ELEMENT_HEX8, i), xi[3] = {r[turn % 3], r[(turn + 1) % 3], r[(turn + 2) % 3]};

      cell[i] = corner[CornerAt(xi)];
    }
    for (PetscInt f = 0; f < Q; f++) {
      facets[place * Q + f] = -1;
      for (PetscInt side = 0; side < 6 && f < 6; side++) {
        PetscBool on = PETSC_TRUE;

        for (PetscInt i = 0; i < 4; i++)
          on = (PetscBool)(on && solid->x[3 * cell[ElementFacetNodes(ELEMENT_HEX8, f)[i]] + side / 2] == side % 2);
        if (on) facets[place * Q + f] = side;
      }
    }
  }
  PetscCall(SplitCreate(3, POINTS, CELLS, cells, facets, &solid->mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions of new vertices by every cell that has them; a middle is halfway between its ends. */
static void SetPositions(Solid *solid, PetscInt before[][BISECT_MAX_VERTICES], PetscInt known)
{
  const Bisection *mesh = &solid->mesh;

  for (PetscInt v = 3 * known; v < 3 * mesh->num_vertices; v++) solid->x[v] = -1;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt i = 0; i < Q; i++) {
      for (PetscInt d = 0; d < 3; d++) {
        PetscReal *x = &solid->x[3 * mesh->vertex[c][i] + d], at = 0;

        for (PetscInt j = 0; j < Q; j++)
          at += BisectionGetPlace(mesh, c, i)[j] * solid->x[3 * before[mesh->parent[c]][j] + d];
        if (*x < 0) *x = at;
        CHECK(*x == at); // dyadic
      }
    }
  }
  for (PetscInt v = 0; v < mesh->num_vertices; v++) {
    for (PetscInt d = 0; d < 3 && mesh->ends[v][0] >= 0; d++)
      CHECK(solid->x[3 * v + d] == (solid->x[3 * mesh->ends[v][0] + d] + solid->x[3 * mesh->ends[v][1] + d]) / 2);
  }
}

/* The lowest corner and the size of a cell, which is a cube. */
static PetscReal GetCube(const Solid *solid, PetscInt c, PetscReal low[])
{
  const PetscReal size = 1 / (PetscReal)(N << solid->mesh.generation[c]);

  for (PetscInt d = 0; d < 3; d++) {
    low[d] = 1;
    for (PetscInt i = 0; i < Q; i++) low[d] = PetscMin(low[d], solid->x[3 * solid->mesh.vertex[c][i] + d]);
    for (PetscInt i = 0; i < Q; i++) CHECK(solid->x[3 * solid->mesh.vertex[c][i] + d] <= low[d] + size);
  }
  return size;
}

/* Volume and balance, sides. */
static void CheckCells(const Solid *solid)
{
  const Bisection *mesh   = &solid->mesh;
  PetscReal        volume = 0;

  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscReal       a[3], b[3];
    const PetscReal size = GetCube(solid, c, a);

    volume += size * size * size;
    for (PetscInt e = 0; e < c; e++) {
      const PetscReal other = GetCube(solid, e, b);
      PetscBool       touch = PETSC_TRUE;

      for (PetscInt d = 0; d < 3; d++) touch = (PetscBool)(touch && a[d] <= b[d] + other && b[d] <= a[d] + size);
      if (touch) CHECK(PetscAbsInt(mesh->generation[c] - mesh->generation[e]) <= 1);
    }
    for (PetscInt f = 0; f < 6; f++) {
      const PetscInt side = mesh->facet[c][f];
      PetscInt       on   = -1;

      for (PetscInt s = 0; s < 6; s++) {
        PetscInt count = 0;

        for (PetscInt i = 0; i < 4; i++)
          count += solid->x[3 * mesh->vertex[c][ElementFacetNodes(ELEMENT_HEX8, f)[i]] + s / 2] == s % 2;
        if (count == 4) on = s;
      }
      CHECK(side == on);
    }
  }
  CHECK(volume == 1);
}

/* Corners of split edges and faces of a cell do not hang. */
static PetscErrorCode CheckHanging(const Bisection *mesh)
{
  EdgeTable  middles;
  PetscBool *hangs;
  PetscInt   edges = 0, faces = 0;

  PetscFunctionBeginUser;
  PetscCall(SplitGetMiddles(mesh, &middles));
  PetscCall(PetscCalloc1(mesh->num_vertices, &hangs));
  for (PetscInt pass = 0; pass < 2; pass++) {
    for (PetscInt c = 0; c < mesh->num_cells; c++) {
      for (PetscInt k = 0; k < 12 + 6; k++) {
        const PetscInt *local = k < 12 ? ElementEdgeNodes(ELEMENT_HEX8, k) : ElementFacetNodes(ELEMENT_HEX8, k - 12);
        const PetscInt  num   = k < 12 ? 2 : 4;
        PetscInt        v[4], of_edge[4], middle;

        for (PetscInt i = 0; i < num; i++) v[i] = mesh->vertex[c][local[i]];
        middle = k < 12 ? EdgeTableFind(&middles, v[0], v[1]) : SplitFindFace(&middles, v, of_edge);
        if (middle < 0) continue;
        hangs[middle] = PETSC_TRUE;
        *(k < 12 ? &edges : &faces) += 1;
        for (PetscInt i = 0; i < num && pass; i++) CHECK(!hangs[v[i]]);
      }
    }
  }
  CHECK(edges > faces && faces > 0);
  PetscCall(PetscFree(hangs));
  PetscCall(EdgeTableDestroy(&middles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Step(const PetscReal centre[], PetscReal radius, Solid *solid)
{
  Bisection     *mesh  = &solid->mesh;
  const PetscInt known = mesh->num_vertices;
  PetscInt      *marked;
  PetscInt(*before)[BISECT_MAX_VERTICES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(mesh->num_cells, &marked, mesh->num_cells, &before));
  memcpy(before, mesh->vertex, (size_t)mesh->num_cells * sizeof(*before));
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    PetscReal low[3], square = 0;
    PetscReal size = GetCube(solid, c, low);

    for (PetscInt d = 0; d < 3; d++) square += PetscSqr(low[d] + size / 2 - centre[d]);
    marked[c] = square < radius * radius;
  }
  if (mesh->num_cells == CELLS) memset(marked, 0, CELLS * sizeof(*marked));
  for (PetscInt c = 0; c < CELLS && mesh->num_cells == CELLS; c++) { // one cell, the same of any order
    PetscReal low[3];

    GetCube(solid, c, low);
    marked[c] = low[0] + low[1] + low[2] == 0;
  }
  PetscCall(SplitRefine(mesh, marked));
  CHECK(mesh->num_vertices <= MAX_VERTICES);
  SetPositions(solid, before, known);
  PetscCall(PetscFree2(marked, before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  static Solid a, b;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt turn = 1; turn < 3; turn++) {
    PetscCall(SolidCreate(0, &a));
    PetscCall(SolidCreate(turn, &b));
    for (PetscInt round = 0; round < NUM_ROUNDS; round++) {
      const PetscReal centre[3] = {Uniform(0, 1), Uniform(0, 1), Uniform(0, 1)}, radius = Uniform(.3, .45);

      PetscCall(Step(centre, radius, &a));
      PetscCall(Step(centre, radius, &b));
      CHECK(a.mesh.num_cells == b.mesh.num_cells && a.mesh.num_vertices == b.mesh.num_vertices);
      CheckCells(&a);
      CheckCells(&b);
      PetscCall(CheckHanging(&a.mesh));
    }
    CHECK(a.mesh.num_cells > 100);
    PetscCall(BisectionDestroy(&a.mesh));
    PetscCall(BisectionDestroy(&b.mesh));
  }
  PetscCall(PetscFinalize());
  return 0;
}
