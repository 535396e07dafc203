/* test_polygons.c -- overlaps of facets in space: reference values, tilings without holes, curved facets.

   -fuzz_pairs <n>: how many random pairs of facets are clipped (100000). */
#include "kernel/clip.h"
#include "kernel/dual.h"
#include "kernel/element.h"
#include "kernel/frame.h"
#include <test.h>

#include "surfaces.h"

/* The unit square against its two halves; a triangle against a square that covers a quarter of it: fractions by hand.
   Mortar facets may run either way. */
static void TestReferenceValues(void)
{
  const PetscReal square[] = {0., 0., 1., 0., 1., 1., 0., 1.}, corner[] = {0., 0., 1., 0., 0., 1.};
  const PetscReal shifted[] = {0.25, 0.25, 1.25, 0.25, 1.25, 1.25, 0.25, 1.25};
  const PetscInt  one[] = {0, 1, 2, 3}, back[] = {0, 3, 2, 1}, halves[] = {0, 1, 2, 0, 2, 3};
  const PetscReal full[4][4] = {{34., -4., 4., -4.}, {1., 29., 1., -1.}, {4., -4., 34., -4.}, {1., -1., 1., 29.}};
  const PetscReal cut[3][4]  = {{46., -6., -2., -6.}, {43., 57., 3., -23.}, {43., -23., 3., 57.}};
  const PetscReal D_cut[3]   = {1. / 48., 5. / 96., 5. / 96.};
  static Surface  nonmortar, mortar;
  static Coupling pair;

  Flat(ELEMENT_QUAD4, 4, square, 1, one, &nonmortar);
  Flat(ELEMENT_TRI3, 4, square, 2, halves, &mortar);
  Couple(&nonmortar, &mortar, &pair);
  for (PetscInt a = 0; a < 4; a++) {
    CHECK_NEAR(pair.D[a], 0.25, EXACT);
    for (PetscInt b = 0; b < 4; b++) CHECK_NEAR(pair.M[a][b], full[a][b] / 120., EXACT);
  }
  for (PetscInt reversed = 0; reversed < 2; reversed++) {
    Flat(ELEMENT_TRI3, 3, corner, 1, one, &nonmortar);
    Flat(ELEMENT_QUAD4, 4, shifted, 1, reversed ? back : one, &mortar);
    Couple(&nonmortar, &mortar, &pair);
    CHECK_NEAR(pair.area, 0.125, EXACT);
    for (PetscInt a = 0; a < 3; a++) {
      CHECK_NEAR(pair.D[a], D_cut[a], EXACT);
      for (PetscInt b = 0; b < 4; b++) CHECK_NEAR(pair.M[a][b], cut[a][b] / 1536., EXACT);
    }
  }
}

/* The unit square in the plane z = height as n x m cells, its inner vertices shaken, straight edges. */
static void Tiling(ElementType type, PetscInt n, PetscInt m, PetscReal height, PetscReal shake, Surface *s)
{
  const PetscInt order = ElementOrder(type), columns = order * n + 1, triangles = ElementLinear(type) == ELEMENT_TRI3;
  const PetscInt steps[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  const PetscInt lower[6] = {0, 1, 2, 4, 5, 8}, upper[6] = {0, 2, 3, 8, 6, 7};
  const ElementType own = order == 1 ? ELEMENT_QUAD4 : ELEMENT_QUAD9;

  *s = (Surface){.type = type, .num_nodes = columns * (order * m + 1)};
  for (PetscInt i = 0; i < s->num_nodes; i++) {
    const PetscInt  column = i % columns, row = i / columns;
    const PetscBool inner = column > 0 && column < order * n && row > 0 && row < order * m ? PETSC_TRUE : PETSC_FALSE;

    s->X[i][0] = (column + (inner ? order * Uniform(-shake, shake) : 0.)) / (order * n);
    s->X[i][1] = (row + (inner ? order * Uniform(-shake, shake) : 0.)) / (order * m);
    s->X[i][2] = height;
    s->N[i][2] = 1.;
  }
  for (PetscInt cell = 0; cell < n * m; cell++) {
    PetscInt nodes[9];

    for (PetscInt i = 0; i < ElementNumNodes(own); i++) {
      const PetscInt column = order * (cell % n) + steps[i][0] * order / 2;
      const PetscInt row    = order * (cell / n) + steps[i][1] * order / 2;

      nodes[i] = row * columns + column;
    }
    for (PetscInt i = 4; i < 9 && order == 2; i++) { /* between their vertices; the middle lies on the diagonal 0-2 */
      const PetscReal *a = s->X[nodes[i < 8 ? i - 4 : 0]], *b = s->X[nodes[i < 8 ? (i - 3) % 4 : 2]];

      for (PetscInt k = 0; k < 2; k++) s->X[nodes[i]][k] = 0.5 * (a[k] + b[k]);
      if (i == 8 && !triangles) {
        for (PetscInt k = 0; k < 2; k++)
          s->X[nodes[8]][k] = 0.25 * (s->X[nodes[0]][k] + s->X[nodes[1]][k] + s->X[nodes[2]][k] + s->X[nodes[3]][k]);
      }
    }
    for (PetscInt half = 0; half < (triangles ? 2 : 1); half++) {
      for (PetscInt i = 0; i < ElementNumNodes(type); i++)
        s->nodes[s->num_facets][i] = triangles ? nodes[half ? upper[i] : lower[i]] : nodes[i];
      s->num_facets++;
    }
  }
}

/* Flat tilings that do not match, at a distance, anywhere in space: sum_b M_ab = D_aa, M x_m = D (x_s + gap n), the gap
   itself, and the area. */
static void TestFlat(ElementType own, ElementType other)
{
  const PetscReal distance = 0.1;
  static Surface  nonmortar, mortar;
  static Coupling pair;

  for (PetscInt trial = 0; trial < 6; trial++) {
    PetscReal Q[3][3];

    RandomFrame(Q);
    Tiling(own, 2 + trial % 2, 2, 0., 0.25, &nonmortar);
    Tiling(other, 2, 3 - trial % 2, distance, 0.25, &mortar);
    SurfaceTurn(Q, &nonmortar);
    SurfaceTurn(Q, &mortar);
    Couple(&nonmortar, &mortar, &pair);
    CHECK_NEAR(pair.area, 1., EXACT);
    for (PetscInt a = 0; a < nonmortar.num_nodes; a++) {
      PetscReal row = 0., moved[DIM] = {0.};

      if (pair.D[a] == 0.) continue; /* the middle of a cell that was cut into tri3 */
      CHECK(pair.D[a] > 0.);
      CHECK_NEAR(pair.gap[a], distance * pair.D[a], EXACT);
      for (PetscInt b = 0; b < mortar.num_nodes; b++) {
        row += pair.M[a][b];
        for (PetscInt k = 0; k < DIM; k++) moved[k] += pair.M[a][b] * mortar.X[b][k];
      }
      CHECK_NEAR(row, pair.D[a], EXACT);
      for (PetscInt k = 0; k < DIM; k++)
        CHECK_NEAR(moved[k], pair.D[a] * (nonmortar.X[a][k] + distance * Q[2][k]), EXACT);
    }
  }
}

/* D and M do not notice that everything is turned together, nor where a facet's nodes begin. */
static void TestRigidMotion(ElementType own, ElementType other)
{
  static Surface  nonmortar, mortar;
  static Coupling before, after;
  PetscReal       Q[3][3];
  const PetscInt  n = ElementNumNodes(ElementLinear(own));

  Tiling(own, 2, 2, 0., 0.25, &nonmortar);
  Tiling(other, 3, 2, 0.02, 0.25, &mortar);
  Couple(&nonmortar, &mortar, &before);
  RandomFrame(Q);
  SurfaceTurn(Q, &nonmortar);
  SurfaceTurn(Q, &mortar);
  for (PetscInt f = 0; f < nonmortar.num_facets; f++) { /* vertices and middles begin one later */
    PetscInt nodes[ELEMENT_MAX_FACET_NODES];

    for (PetscInt i = 0; i < ElementNumNodes(own); i++) nodes[i] = nonmortar.nodes[f][i];
    for (PetscInt i = 0; i < PetscMin(2 * n, ElementNumNodes(own)); i++)
      nonmortar.nodes[f][i] = nodes[i / n * n + (i % n + 1) % n];
  }
  Couple(&nonmortar, &mortar, &after);
  for (PetscInt a = 0; a < nonmortar.num_nodes; a++) {
    CHECK_NEAR(before.D[a], after.D[a], EXACT);
    for (PetscInt b = 0; b < mortar.num_nodes; b++) CHECK_NEAR(before.M[a][b], after.M[a][b], EXACT);
  }
}

/* Lines of a grid between -1 and 2, some closer together than 1e-9. */
static void GridLines(PetscInt n, PetscReal lines[])
{
  const PetscReal thin = 1e-10;

  for (PetscInt i = 0; i < n; i++) lines[i] = -1. + 3. * i / (n - 1) + (i > 0 && i + 1 < n ? Uniform(-0.2, 0.2) : 0.);
  for (PetscInt i = 2; i + 1 < n; i++) {
    if (Uniform(0., 1.) < 0.25) lines[i] = lines[i - 1] + thin;
  }
}

/* Corners of a triangle or a convex quad inside of the grid, some of them on its nodes. [out] corner - [num][2] */
static void RandomCorners(PetscInt num_lines, const PetscReal x[], const PetscReal y[], PetscInt num,
                          PetscReal corner[][2])
{
  PetscBool inside;

  do {
    const PetscReal s = Uniform(0.3, 1.2), t = Uniform(0.8, 1.2); /* the corner opposite to the first; s + t > 1 */

    for (PetscInt i = 0; i < 3; i++) {
      const PetscBool shared = Uniform(0., 1.) < 0.5 ? PETSC_TRUE : PETSC_FALSE;
      PetscReal      *own    = corner[i < 2 ? i : num - 1];

      own[0] = shared ? x[1 + (PetscInt)Uniform(0., num_lines - 2)] : Uniform(-0.3, 1.3);
      own[1] = shared ? y[1 + (PetscInt)Uniform(0., num_lines - 2)] : Uniform(-0.3, 1.3);
    }
    inside = PETSC_TRUE;
    for (PetscInt k = 0; k < 2 && num == 4; k++) {
      corner[2][k] = corner[0][k] + s * (corner[1][k] - corner[0][k]) + t * (corner[3][k] - corner[0][k]);
      if (!(corner[2][k] >= -1. && corner[2][k] <= 2.)) inside = PETSC_FALSE;
    }
  } while (!inside);
}

/* Random facets on a sheared grid of quads and triangles, slivers among them. Corners are often nodes of the
   grid, so that facets share vertices and edges with it. What they have in common adds up to the facet. */
static void TestFuzz(PetscInt num_pairs)
{
  enum { LINES = 7, CELLS = LINES - 1 };

  for (PetscInt pair = 0; pair < num_pairs;) {
    PetscReal       x[LINES], y[LINES], corner[4][2], X[12] = {0.}, N[12] = {0.}, sum = 0., area, size = 0.;
    const PetscReal shear[2] = {Uniform(-0.5, 0.5), Uniform(-0.5, 0.5)};
    const PetscInt  num      = Uniform(0., 1.) < 0.5 ? 3 : 4;
    const ClipFacet facet    = {num == 3 ? ELEMENT_TRI3 : ELEMENT_QUAD4, X, N};

    GridLines(LINES, x);
    GridLines(LINES, y);
    RandomCorners(LINES, x, y, num, corner);
    for (PetscInt i = 0; i < num; i++) { /* sheared with the grid */
      X[3 * i]     = corner[i][0] + shear[0] * corner[i][1];
      X[3 * i + 1] = corner[i][1] + shear[1] * corner[i][0];
      for (PetscInt k = 0; k < 2; k++) size = PetscMax(size, PetscAbsReal(X[3 * i + k] - X[k]));
    }
    area = 0.;
    for (PetscInt i = 1; i + 1 < num; i++)
      area += 0.5 * ((X[3 * i] - X[0]) * (X[3 * i + 4] - X[1]) - (X[3 * i + 1] - X[1]) * (X[3 * i + 3] - X[0]));
    for (PetscInt i = 0; i < num; i++) N[3 * i + 2] = area > 0. ? 1. : -1.;
    for (PetscInt cell = 0; cell < CELLS * CELLS; cell++) {
      const PetscInt  i = cell % CELLS, j = cell / CELLS, num_halves = (i + j) % 2 + 1;
      const PetscReal p[4][2] = {{x[i], y[j]}, {x[i + 1], y[j]}, {x[i + 1], y[j + 1]}, {x[i], y[j + 1]}};

      for (PetscInt half = 0; half < num_halves; half++) {
        const PetscInt  whole[4] = {0, 1, 2, 3}, halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
        const PetscInt *nodes = num_halves == 1 ? whole : halves[half];
        PetscReal       Y[12] = {0.};
        const ClipFacet other = {num_halves == 1 ? ELEMENT_QUAD4 : ELEMENT_TRI3, Y, NULL};

        for (PetscInt v = 0; v < (num_halves == 1 ? 4 : 3); v++) {
          Y[3 * v]     = p[nodes[v]][0] + shear[0] * p[nodes[v]][1];
          Y[3 * v + 1] = p[nodes[v]][1] + shear[1] * p[nodes[v]][0];
        }
        for (PetscInt q = ClipPolygons(&facet, &other, 1, points); q > 0; q--) sum += points[q - 1].weight;
        pair++;
      }
    }
    CHECK_NEAR(sum, PetscAbsReal(area),
               1e-12 * size * size + 16. * PETSC_MACHINE_EPSILON * size); /* places are rounded */
  }
}

/* A facet of any type around the unit square, its nodes moved in the plane and out of it, and the normals of its nodes. */
static void CurvedFacet(ElementType type, PetscReal in_plane, PetscReal out_of_plane, PetscReal X[], PetscReal N[])
{
  const PetscInt n = ElementNumNodes(type);

  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < 2; k++) X[DIM * i + k] = ElementNode(type, i)[k] + Uniform(-in_plane, in_plane);
    X[DIM * i + 2] = Uniform(-out_of_plane, out_of_plane);
  }
  for (PetscInt i = 0; i < n; i++) {
    PetscReal phi[ELEMENT_MAX_NODES];

    ElementSurface(type, X, ElementNode(type, i), NULL, phi, &N[DIM * i]);
  }
}

/* Points of curved facets of all types: each lies before its place on the mortar facet, along the plane's normal. A facet
   inside of one mortar facet is covered: int phi is that of its own rule, true areas included. The rules are
   of high degree, since bilinear maps and curved areas are no polynomials in the plane. */
static void TestCurved(ElementType own, ElementType other)
{
  for (PetscInt trial = 0; trial < 50; trial++) {
    const PetscInt  n = ElementNumNodes(own), flat = trial % 2;
    PetscReal       X[DIM * ELEMENT_MAX_FACET_NODES], N[DIM * ELEMENT_MAX_FACET_NODES], normal[DIM] = {0.};
    PetscReal       Y[DIM * ELEMENT_MAX_FACET_NODES], unused[DIM * ELEMENT_MAX_FACET_NODES], phi[ELEMENT_MAX_NODES];
    PetscReal       xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], integral[ELEMENT_MAX_NODES] = {0.};
    const PetscInt  num_rule = QuadratureRule(own, 14, xi, w);
    const ClipFacet facet = {own, X, N}, mortar = {other, Y, NULL};
    const PetscReal scale = 6., tolerance = flat ? 1e-12 : 1e-7;
    PetscInt        num;

    CurvedFacet(own, 0.05, flat ? 0. : 0.05, X, N);
    CurvedFacet(other, 0.03, 0.03, Y, unused);
    for (PetscInt i = 0; i < ElementNumNodes(other); i++) { /* far larger, also a triangle */
      for (PetscInt k = 0; k < 2; k++) Y[DIM * i + k] = scale * (Y[DIM * i + k] - 0.25);
      Y[DIM * i + 2] += 0.2;
    }
    for (PetscInt i = 0; i < DIM * n; i++) normal[i % DIM] += N[i];
    FrameNormalize(DIM, normal);
    num = ClipPolygons(&facet, &mortar, 14, points);
    CHECK(num > 0 && num < CLIP_MAX_POLYGON_POINTS);
    for (PetscInt q = 0; q < num; q++) {
      PetscReal x[DIM], y[DIM];

      ElementSurface(other, Y, points[q].eta, y, phi, NULL);
      ElementSurface(own, X, points[q].xi, x, phi, NULL);
      for (PetscInt i = 0; i < n; i++) integral[i] += points[q].weight * phi[i];
      CHECK(points[q].weight > 0.);
      for (PetscInt k = 0; k < 2; k++) CHECK(points[q].xi[k] > -EXACT && points[q].xi[k] < 1. + EXACT);
      for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(y[k] - x[k], points[q].gap * normal[k], 1e-11);
    }
    for (PetscInt q = 0; q < num_rule; q++) {
      const PetscReal ds = w[q] * ElementSurface(own, X, &xi[2 * q], NULL, phi, NULL);

      for (PetscInt i = 0; i < n; i++) integral[i] -= ds * phi[i];
    }
    for (PetscInt i = 0; i < n; i++) CHECK_NEAR(integral[i], 0., tolerance);
  }
}

/* A dart is cut as two triangles, and so is a quad with a corner of 180 degrees; facets seen edge-on have no overlap. */
static void TestOdd(void)
{
  const PetscReal dart[]     = {0., 0., 0., 1., 0., 0., 0.3, 0.3, 0., 0., 1., 0.},
                  straight[] = {0., 0., 0., 1., 0., 0., 0.5, 0.5, 0., 0., 1., 0.};
  const PetscReal N[]        = {0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1.},
                  edge_on[]  = {-9., 0.2, -9., 9., 0.2, -9., 0., 0.2, 9.};
  const PetscReal cover[] = {-9., -9., 0.1, 9., -9., 0.1, 0., 9., 0.1}, away[] = {2., 2., 0., 3., 2., 0., 2., 3., 0.};
  const ClipFacet facet = {ELEMENT_QUAD4, dart, N}, mortar = {ELEMENT_TRI3, cover, NULL},
                  far      = {ELEMENT_TRI3, away, NULL};
  const ClipFacet triangle = {ELEMENT_QUAD4, straight, N}, thin = {ELEMENT_TRI3, edge_on, NULL};
  PetscReal       area[2] = {0., 0.};

  for (PetscInt q = ClipPolygons(&triangle, &mortar, 4, points); q > 0; q--) area[0] += points[q - 1].weight;
  CHECK_NEAR(area[0], 0.5, EXACT);
  for (PetscInt q = ClipPolygons(&facet, &mortar, 4, points); q > 0; q--) area[1] += points[q - 1].weight;
  CHECK(area[1] > 0.);
  CHECK(ClipPolygons(&triangle, &far, 4, points) == 0);
  CHECK(ClipPolygons(&triangle, &thin, 4, points) == 0);
}

/* A small triangle over the corner of a curved facet: the points of a low degree still tell its shape functions apart. */
static void TestCorner(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type), degree = 5;
  const PetscReal Y[] = {-0.1, -0.1, 0.2, 0.3, -0.1, 0.2, -0.1, 0.3, 0.2}, bulge     = 0.1;
  PetscReal       X[DIM * ELEMENT_MAX_FACET_NODES], N[DIM * ELEMENT_MAX_FACET_NODES] = {0.};
  PetscReal       xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS];
  const ClipFacet facet = {type, X, N}, mortar = {ELEMENT_TRI3, Y, NULL};
  PetscInt        num;
  DualBasis       dual;

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *node = ElementNode(type, i);

    X[DIM * i]     = node[0];
    X[DIM * i + 1] = node[1];
    X[DIM * i + 2] = bulge * (node[0] * (1. - node[0]) + node[1] * (1. - node[1]));
    N[DIM * i + 2] = 1.;
  }
  num = ClipPolygons(&facet, &mortar, degree, points);
  for (PetscInt q = 0; q < num; q++) {
    xi[2 * q]     = points[q].xi[0];
    xi[2 * q + 1] = points[q].xi[1];
    w[q]          = points[q].weight;
  }
  CHECK(num > 0 && DualBasisCreate(type, num, xi, w, NULL, &dual));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal sum[ELEMENT_MAX_NODES] = {0.}, phi[ELEMENT_MAX_NODES], psi[DUAL_MAX];

    for (PetscInt q = 0; q < num; q++) {
      ElementShape(type, &xi[2 * q], phi, NULL);
      DualShape(type, phi);
      DualBasisEvaluate(&dual, &xi[2 * q], psi);
      for (PetscInt j = 0; j < n; j++) sum[j] += w[q] * psi[i] * phi[j];
    }
    for (PetscInt j = 0; j < n; j++) CHECK_NEAR(sum[j], i == j ? dual.D[i] : 0., EXACT);
  }
}

/* The far layer lies behind the near one, and is seen only where that ends. */
static void TestSees(void)
{
  const PetscReal X[]    = {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.},
                  N[]    = {0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1.};
  const PetscReal near[] = {0., 0., 0.1, 0., 1., 0.1, 0.5, 1., 0.1, 0.5, 0., 0.1}, left[] = {0.25, 0.5},
                  right[] = {0.75, 0.5};
  const ClipFacet facet = {ELEMENT_QUAD4, X, N}, layer = {ELEMENT_QUAD4, near, NULL};
  PetscReal       gap;

  CHECK(ClipSees(&facet, &layer, left, &gap));
  CHECK_NEAR(gap, 0.1, EXACT);
  CHECK(!ClipSees(&facet, &layer, right, &gap));
}

int main(int argc, char **argv)
{
  PetscInt num_pairs = 100000;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-fuzz_pairs", &num_pairs, NULL));
  TestReferenceValues();
  for (PetscInt i = 0; i < NUM_TYPES; i++) {
    for (PetscInt j = 0; j < NUM_TYPES; j++) {
      TestFlat(TYPES[i], TYPES[j]);
      TestRigidMotion(TYPES[i], TYPES[j]);
      TestCurved(TYPES[i], TYPES[j]);
    }
  }
  TestOdd();
  TestCorner(ELEMENT_TRI6);
  TestCorner(ELEMENT_QUAD9);
  TestSees();
  TestFuzz(num_pairs);
  PetscCall(PetscFinalize());
  return 0;
}
