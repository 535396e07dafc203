/* test_search.c -- the mortar facets that reach a rank: all that its facets may meet, each once, and not the whole side. */
#include "contact/contactfacet.h"
#include "contact/mortarsurface.h"
#include "test.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "uniform.h"

enum { MAX_FACETS = 1200 };

/* A side as every rank of the test knows it. */
typedef struct {
  PetscInt    num;
  ElementType type[MAX_FACETS];
  PetscReal   X[MAX_FACETS][3 * ELEMENT_MAX_FACET_NODES];
  PetscInt    rank[MAX_FACETS]; /* that holds it */
  PetscInt    first; /* global number of the first node of facet 0; facet f has ELEMENT_MAX_FACET_NODES of them */
} Side;

/* What this rank holds of two sides. */
typedef struct {
  Level  level;
  Facets facets[2];
} Held;

static PetscMPIInt Rank(void)
{
  PetscMPIInt rank;
  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  return rank;
}

static PetscMPIInt Size(void)
{
  PetscMPIInt size;
  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  return size;
}

/* A facet somewhere in the unit cube, of any type and bent at random. */
static void RandomFacet(PetscInt dim, PetscReal size, ElementType *type, PetscReal X[])
{
  static const ElementType types[2][4] = {{ELEMENT_LINE2, ELEMENT_LINE3, ELEMENT_LINE2, ELEMENT_LINE3},
                                          {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9}};
  PetscReal                origin[3], axes[2][3];

  *type = types[dim - 2][(PetscInt)Uniform(0, 4)];
  for (PetscInt k = 0; k < dim; k++) {
    origin[k]  = Uniform(0, 1);
    axes[0][k] = Uniform(-size, size);
    axes[1][k] = Uniform(-size, size);
  }
  for (PetscInt i = 0; i < ElementNumNodes(*type); i++) {
    const PetscReal *xi = ElementNode(*type, i);
    for (PetscInt k = 0; k < dim; k++) {
      X[i * dim + k] = origin[k] + Uniform(-0.3, 0.3) * size;
      for (PetscInt j = 0; j < dim - 1; j++) X[i * dim + k] += xi[j] * axes[j][k];
    }
  }
}

/* Facets never leave their boxes, nor their hulls' boxes the nodes' where they are not curved. */
static void TestBoxes(PetscInt dim)
{
  enum { LATTICE = 12 };
  for (PetscInt test = 0; test < 400; test++) {
    PetscReal   X[3 * ELEMENT_MAX_FACET_NODES], box[6], x[3], phi[ELEMENT_MAX_NODES];
    ElementType type;
    RandomFacet(dim, 1, &type, X);
    ContactFacetBox(dim, type, X, box);
    for (PetscInt i = 0; i <= LATTICE; i++) {
      for (PetscInt j = 0; j <= LATTICE; j++) {
        const PetscReal xi[2] = {(PetscReal)i / LATTICE, (PetscReal)j / LATTICE};
        if ((type == ELEMENT_TRI3 || type == ELEMENT_TRI6) && i + j > LATTICE) continue;
        ElementSurface(type, X, xi, x, phi, NULL);
        for (PetscInt k = 0; k < dim; k++) CHECK(x[k] >= box[k] - 1e-14 && x[k] <= box[dim + k] + 1e-14);
      }
    }
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) { // straightened, its box is that of its vertices
      const ElementType linear = ElementLinear(type);
      ElementShape(linear, ElementNode(type, i), phi, NULL);
      for (PetscInt k = 0; k < dim && i >= ElementNumNodes(linear); k++) {
        X[i * dim + k] = 0;
        for (PetscInt j = 0; j < ElementNumNodes(linear); j++) X[i * dim + k] += phi[j] * X[j * dim + k];
      }
    }
    ContactFacetBox(dim, type, X, box);
    for (PetscInt k = 0; k < dim; k++) {
      PetscReal low = X[k], high = X[k];
      for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(type)); i++) {
        low  = PetscMin(low, X[i * dim + k]);
        high = PetscMax(high, X[i * dim + k]);
      }
      CHECK_NEAR(box[k], low, 1e-14);
      CHECK_NEAR(box[dim + k], high, 1e-14);
    }
  }
}

/* Makes the tables of a level that holds nothing but this rank's facets. */
static void Hold(PetscInt dim, const Side sides[2], Held *held)
{
  static PetscInt material[1]; // all facets belong to one cell

  Level   *level  = &held->level;
  PetscInt num[2] = {0, 0}, total;

  CHECK(!PetscMemzero(held, sizeof(*held)));
  for (PetscInt s = 0; s < 2; s++) {
    for (PetscInt f = 0; f < sides[s].num; f++) num[s] += sides[s].rank[f] == Rank();
  }
  total                = (num[0] + num[1]) * ELEMENT_MAX_FACET_NODES;
  level->comm          = PETSC_COMM_WORLD;
  level->dim           = dim;
  level->num_nodes     = 0;
  level->cell_material = material;
  CHECK(!PetscCalloc2(total * dim, &level->coords, total, &level->node_global));
  for (PetscInt s = 0; s < 2; s++) {
    Facets *facets = &held->facets[s];
    CHECK(
        !PetscCalloc3(num[s], &facets->type, num[s], &facets->cell, num[s] * ELEMENT_MAX_FACET_NODES, &facets->nodes));
    for (PetscInt f = 0; f < sides[s].num; f++) {
      if (sides[s].rank[f] != Rank()) continue;
      facets->type[facets->num] = sides[s].type[f];
      for (PetscInt i = 0; i < ElementNumNodes(sides[s].type[f]); i++) {
        const PetscInt node                                      = level->num_nodes++;
        facets->nodes[facets->num * ELEMENT_MAX_FACET_NODES + i] = node;
        level->node_global[node]                                 = sides[s].first + f * ELEMENT_MAX_FACET_NODES + i;
        CHECK(!PetscArraycpy(&level->coords[node * dim], &sides[s].X[f][i * dim], dim));
      }
      facets->num++;
    }
  }
}

static void Release(Held *held)
{
  for (PetscInt s = 0; s < 2; s++)
    CHECK(!PetscFree3(held->facets[s].type, held->facets[s].cell, held->facets[s].nodes));
  CHECK(!PetscFree2(held->level.coords, held->level.node_global));
}

/* Every facet that came is one of the side, whole, and is there once. [out] place - of each in the surface, or -1 */
static void CheckFacets(PetscInt dim, const Side *mortar, const MortarSurface *surface, PetscInt place[])
{
  for (PetscInt f = 0; f < mortar->num; f++) place[f] = -1;
  for (PetscInt g = 0; g < surface->num; g++) {
    const PetscInt *nodes = &surface->nodes[g * ELEMENT_MAX_FACET_NODES];
    const PetscInt  f     = (nodes[0] - mortar->first) / ELEMENT_MAX_FACET_NODES;
    CHECK(f >= 0 && f < mortar->num && place[f] < 0);
    place[f] = g;
    CHECK(surface->type[g] == mortar->type[f]);
    for (PetscInt i = 0; i < ElementNumNodes(mortar->type[f]); i++) {
      CHECK(nodes[i] == mortar->first + f * ELEMENT_MAX_FACET_NODES + i);
      for (PetscInt k = 0; k < dim; k++)
        CHECK(surface->coords[(g * ELEMENT_MAX_FACET_NODES + i) * dim + k] == mortar->X[f][i * dim + k]);
    }
  }
}

/* Queries with a nonmortar facet's box, widened by the reach: those that looking at all facets finds. */
static void CheckQueries(PetscInt dim, const Side sides[2], PetscReal reach, const MortarSurface *surface,
                         const PetscInt place[])
{
  for (PetscInt f = 0; f < sides[0].num; f++) {
    PetscReal       query[6], box[6];
    PetscInt        num_hits, expected = 0;
    const PetscInt *hits;
    if (sides[0].rank[f] != Rank()) continue;
    ContactFacetBox(dim, sides[0].type[f], sides[0].X[f], query);
    for (PetscInt k = 0; k < dim; k++) {
      query[k] -= reach;
      query[dim + k] += reach;
    }
    CHECK(!BoxTreeQuery(surface->tree, query, &num_hits, &hits));
    for (PetscInt g = 0; g < sides[1].num; g++) {
      PetscBool meet = PETSC_TRUE, hit = PETSC_FALSE;
      ContactFacetBox(dim, sides[1].type[g], sides[1].X[g], box);
      for (PetscInt k = 0; k < dim; k++)
        meet = (PetscBool)(meet && box[k] <= query[dim + k] && query[k] <= box[dim + k]);
      for (PetscInt h = 0; h < num_hits; h++) hit = (PetscBool)(hit || (place[g] >= 0 && hits[h] == place[g]));
      CHECK(meet == hit);
      expected += meet;
    }
    CHECK(num_hits == expected);
  }
}

/* Points on rays of a facet: a mortar facet whose box holds one is among the hits. [in] boxes - of the surface [num][6] */
static void CheckRays(PetscInt dim, const ClipFacet *facet, PetscReal reach, const PetscReal boxes[][6],
                      const MortarSurface *surface, PetscInt *num_hits)
{
  enum { NUM_RAYS = 200 };
  const ElementType type = facet->type;
  const PetscInt   *hits;

  CHECK(!MortarSurfaceQuery(surface, dim, facet, reach, num_hits, &hits));
  for (PetscInt r = 0; r < NUM_RAYS; r++) {
    const PetscReal s = Uniform(-reach, reach), xi[2] = {Uniform(0, 1), Uniform(0, 1)};
    PetscReal       x[3], n[3]                        = {0, 0, 0}, phi[ELEMENT_MAX_NODES];
    if (ElementLinear(type) == ELEMENT_TRI3 && xi[0] + xi[1] > 1) continue;
    ElementSurface(type, facet->X, xi, x, phi, NULL);
    for (PetscInt i = 0; i < ElementNumNodes(type) * dim; i++) n[i % dim] += phi[i / dim] * facet->N[i];
    FrameNormalize(dim, n);
    for (PetscInt k = 0; k < dim; k++) x[k] += s * n[k];
    for (PetscInt g = 0; g < surface->num; g++) {
      PetscBool inside = PETSC_TRUE, hit = PETSC_FALSE;
      for (PetscInt k = 0; k < dim; k++)
        inside = (PetscBool)(inside && x[k] >= boxes[g][k] && x[k] <= boxes[g][dim + k]);
      if (!inside) continue;
      for (PetscInt h = 0; h < *num_hits; h++) hit = (PetscBool)(hit || hits[h] == g);
      CHECK(hit);
    }
  }
}

/* Rays along normals that do not turn over a facet, or a little, or by more than a right angle. */
static PetscErrorCode TestRays(PetscInt dim)
{
  enum { NUM_FACETS = 300, NUM_NONMORTAR = 60 };
  static Side      sides[2];
  static PetscReal boxes[NUM_FACETS][6];
  Held             held;
  MortarSurface    surface;
  PetscInt         found = 0, all = 0, num_hits;

  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < 2; s++) {
    sides[s].num   = s ? NUM_FACETS : NUM_NONMORTAR;
    sides[s].first = s * MAX_FACETS * ELEMENT_MAX_FACET_NODES;
    for (PetscInt f = 0; f < sides[s].num; f++) {
      RandomFacet(dim, 0.05, &sides[s].type[f], sides[s].X[f]);
      sides[s].rank[f] = f % Size();
    }
  }
  Hold(dim, sides, &held);
  PetscCall(MortarSurfaceCreate(&held.level, &held.facets[0], &held.facets[1], NULL, NULL, 0.3, &surface));
  for (PetscInt g = 0; g < surface.num; g++)
    ContactFacetBox(dim, surface.type[g], &surface.coords[g * ELEMENT_MAX_FACET_NODES * dim], boxes[g]);
  for (PetscInt f = 0; f < NUM_NONMORTAR; f++) {
    const PetscReal turn = f % 3 ? Uniform(0, 0.3) : f % 2 ? 0 : 2;
    PetscReal       N[3 * ELEMENT_MAX_FACET_NODES], mean[3];
    const ClipFacet facet = {sides[0].type[f], sides[0].X[f], N};
    for (PetscInt k = 0; k < dim; k++) mean[k] = Uniform(-1, 1);
    FrameNormalize(dim, mean);
    for (PetscInt i = 0; i < ElementNumNodes(sides[0].type[f]); i++) {
      for (PetscInt k = 0; k < dim; k++) N[i * dim + k] = mean[k] + turn * Uniform(-1, 1);
      FrameNormalize(dim, &N[i * dim]);
    }
    if (sides[0].rank[f] != Rank()) continue;
    CheckRays(dim, &facet, Uniform(0, 0.3), boxes, &surface, &num_hits);
    found += num_hits;
    all += surface.num;
  }
  CHECK(2 * found <= all); // it does not return everything
  PetscCall(MortarSurfaceDestroy(&surface));
  Release(&held);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A strip of n squares askew under another one, however fine: no query finds more than the few that lie beneath. */
static PetscErrorCode TestAskew(void)
{
  static Side   sides[2];
  Held          held;
  MortarSurface surface;

  PetscFunctionBeginUser;
  for (PetscInt n = 10; n <= 1000; n *= 10) {
    const PetscReal h = 1. / (PetscReal)n, c = PetscSqrtReal(0.5);
    PetscReal       N[12];
    ClipFacet       facet = {ELEMENT_QUAD4, NULL, N};
    for (PetscInt i = 0; i < 4; i++) {
      N[3 * i]     = -c;
      N[3 * i + 1] = 0;
      N[3 * i + 2] = c;
    }
    for (PetscInt s = 0; s < 2; s++) {
      sides[s].num   = n;
      sides[s].first = s * MAX_FACETS * ELEMENT_MAX_FACET_NODES;
      for (PetscInt f = 0; f < n; f++) {
        sides[s].type[f] = ELEMENT_QUAD4;
        sides[s].rank[f] = f * Size() / n;
        for (PetscInt v = 0; v < 4; v++) {
          const PetscReal *xi      = ElementNode(ELEMENT_QUAD4, v);
          sides[s].X[f][3 * v]     = c * h * ((PetscReal)f + xi[0]);
          sides[s].X[f][3 * v + 1] = h * xi[1];
          sides[s].X[f][3 * v + 2] = sides[s].X[f][3 * v];
        }
      }
    }
    Hold(3, sides, &held);
    PetscCall(MortarSurfaceCreate(&held.level, &held.facets[0], &held.facets[1], NULL, NULL, 0.2, &surface));
    for (PetscInt f = 0; f < n; f++) {
      PetscInt        num_hits;
      const PetscInt *hits;
      if (sides[0].rank[f] != Rank()) continue;
      facet.X = sides[0].X[f];
      PetscCall(MortarSurfaceQuery(&surface, 3, &facet, 0.2, &num_hits, &hits));
      CHECK(num_hits >= 1 && num_hits <= 5);
    }
    PetscCall(MortarSurfaceDestroy(&surface));
    Release(&held);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] reach - of all facets; [out] held - most facets that a rank was sent or kept */
static PetscErrorCode Search(PetscInt dim, const Side sides[2], PetscReal reach, PetscInt *most)
{
  static PetscInt place[MAX_FACETS];
  MortarSurface   surface;
  Held            held;

  PetscFunctionBeginUser;
  Hold(dim, sides, &held);
  PetscCall(MortarSurfaceCreate(&held.level, &held.facets[0], &held.facets[1], NULL, NULL, reach, &surface));
  CheckFacets(dim, &sides[1], &surface, place);
  CheckQueries(dim, sides, reach, &surface, place);
  if (held.facets[0].num == 0) CHECK(surface.num == 0);
  *most = surface.num;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 1, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(MortarSurfaceDestroy(&surface));
  Release(&held);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets anywhere, on ranks anyhow: at random, all of a side on one rank, none at all. */
static PetscErrorCode TestRandom(PetscInt dim)
{
  enum { NUM_CASES = 5, NUM_FACETS = 150 };
  static Side    sides[2];
  const PetscInt size = Size(), nobody = -1;
  /* of each case the rank of each side, or anyone's */
  const PetscInt owner[NUM_CASES][2] = {
      {nobody, nobody}, {0, size - 1}, {size - 1, 0}, {0, nobody}, {nobody, size / 2}};
  PetscInt most;

  PetscFunctionBeginUser;
  for (PetscInt test = 0; test < 4 * NUM_CASES; test++) {
    const PetscReal facet = Uniform(0.01, 0.1), reach = test % 2 ? 0 : Uniform(0, 0.2);
    for (PetscInt s = 0; s < 2; s++) {
      sides[s].num   = test == 7 + s ? 0 : NUM_FACETS;
      sides[s].first = s * MAX_FACETS * ELEMENT_MAX_FACET_NODES;
      for (PetscInt f = 0; f < sides[s].num; f++) {
        const PetscInt any = (PetscInt)Uniform(0, size);
        RandomFacet(dim, facet, &sides[s].type[f], sides[s].X[f]);
        sides[s].rank[f] = owner[test % NUM_CASES][s] == nobody ? any : owner[test % NUM_CASES][s];
      }
    }
    PetscCall(Search(dim, sides, reach, &most));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two like grids of n x n squares a little apart, in strips on the ranks: a rank needs its strip and a margin. The strips of
   the other side run across them or along. */
static PetscErrorCode TestStrips(PetscBool across)
{
  enum { N = 32 };
  static Side    sides[2];
  const PetscInt size = Size(), strip = (N + size - 1) / size;
  PetscInt       most;

  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < 2; s++) {
    sides[s].num   = N * N;
    sides[s].first = s * MAX_FACETS * ELEMENT_MAX_FACET_NODES;
    for (PetscInt f = 0; f < N * N; f++) {
      const PetscInt i = f % N, j = f / N;
      sides[s].type[f] = ELEMENT_QUAD4;
      sides[s].rank[f] = (s && across ? j : i) / strip;
      for (PetscInt v = 0; v < 4; v++) {
        const PetscReal *xi      = ElementNode(ELEMENT_QUAD4, v);
        sides[s].X[f][3 * v]     = (PetscReal)i + xi[0];
        sides[s].X[f][3 * v + 1] = (PetscReal)j + xi[1];
        sides[s].X[f][3 * v + 2] = 0.25 * s;
      }
    }
  }
  PetscCall(Search(3, sides, 0.5, &most));
  CHECK(most <= PetscMin(N, strip + 2) * N);
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 2; dim <= 3; dim++) {
    TestBoxes(dim);
    PetscCall(TestRandom(dim));
    PetscCall(TestRays(dim));
  }
  PetscCall(TestStrips(PETSC_FALSE));
  PetscCall(TestStrips(PETSC_TRUE));
  PetscCall(TestAskew());
  PetscCall(PetscFinalize());
  return 0;
}
