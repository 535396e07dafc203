/* sidequadrics.c -- quadrics through the nodes around a node (eq. 4.1a).

   Surfaces of machine parts are planes, cylinders, cones and spheres, and nodes of files lie on them. Let
   m(x) be the ten monomials up to degree 2. A quadric c.m(x) = 0 through points x_k has c.G c = 0, with the
   sum G of m(x_k) m(x_k)'. A node sums G of the facets around it, then G of its neighbours: points up to two
   facets away. Both sums are over facets, in any partition. Nodes with too few points take the quadrics of
   neighbours that pass through them: where a side ends or passes over into another surface. */
#include "side/sidequadrics.h"
#include "base/compat.h"
#include "level/plexpoints.h"
#include "kernel/dense.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

enum {
  F         = ELEMENT_MAX_FACET_NODES,
  MONOMIALS = QUADRIC_MONOMIALS,
  LINEAR    = QUADRIC_LINEAR,
  SQUARE    = QUADRIC_SQUARE,
  GRAM      = MONOMIALS * (MONOMIALS + 1) / 2,
  FREE      = 8, /* a quadric through the origin with a gradient of one along the normal */
  EVIDENCE  = 2, /* points more than any quadric passes through */
  SPREADS   = 4  /* facets that a quadric is carried over to other nodes */
};

/* What a corner sums: G, and the number of facets at its node, then of points around. */
enum { SUM_COUNT = GRAM, SUMS };

/* Root of the mean square distance of points on a quadric, of theirs from the node. */
static const PetscReal ON_QUADRIC = 1e-5, CONFIRMS = 1e-4;
/* Eigenvalues of G below this share are zero: of several quadrics, the flattest one counts. */
static const PetscReal NO_EIGENVALUE = 1e-12;

static PetscInt GramIndex_Private(PetscInt i, PetscInt j)
{
  const PetscInt row = PetscMin(i, j), column = PetscMax(i, j);

  return row * MONOMIALS - row * (row + 1) / 2 + column;
}

/* G of a point is added. */
static void GramAddPoint_Private(const PetscReal x[3], PetscReal G[GRAM])
{
  PetscReal m[MONOMIALS];

  QuadricMonomials(x, m);
  for (PetscInt i = 0; i < MONOMIALS; i++) {
    for (PetscInt j = i; j < MONOMIALS; j++) G[GramIndex_Private(i, j)] += m[i] * m[j];
  }
}

/* Both halves of G. */
static void GramFill_Private(const PetscReal G[GRAM], PetscReal H[MONOMIALS][MONOMIALS])
{
  PetscInt n = 0;

  for (PetscInt i = 0; i < MONOMIALS; i++) {
    for (PetscInt j = i; j < MONOMIALS; j++) H[i][j] = H[j][i] = G[n++];
  }
}

/* B G B'. [in] B - [rows][MONOMIALS]; [out] H - [rows][rows] */
static void GramTransform_Private(PetscInt rows, const PetscReal B[], const PetscReal G[GRAM], PetscReal H[])
{
  PetscReal full[MONOMIALS][MONOMIALS];

  GramFill_Private(G, full);
  for (PetscInt i = 0; i < rows; i++) {
    PetscReal BG[MONOMIALS] = {0};

    for (PetscInt l = 0; l < MONOMIALS; l++) {
      if (B[i * MONOMIALS + l] == 0) continue;
      for (PetscInt k = 0; k < MONOMIALS; k++) BG[k] += B[i * MONOMIALS + l] * full[l][k];
    }
    for (PetscInt j = i; j < rows; j++) H[i * rows + j] = H[j * rows + i] = VectorDot(MONOMIALS, BG, &B[j * MONOMIALS]);
  }
}

/* Rows of monomials m(x) of a matrix become those of m(x + d). */
static void GramShiftRows_Private(const PetscReal d[3], PetscReal H[MONOMIALS][MONOMIALS])
{
  PetscInt n = SQUARE;

  for (PetscInt i = 0; i < 3; i++) {
    for (PetscInt j = i; j < 3; j++, n++) {
      for (PetscInt k = 0; k < MONOMIALS; k++)
        H[n][k] += d[j] * H[LINEAR + i][k] + d[i] * H[LINEAR + j][k] + d[i] * d[j] * H[0][k];
    }
  }
  for (PetscInt i = 0; i < 3; i++) {
    for (PetscInt k = 0; k < MONOMIALS; k++) H[LINEAR + i][k] += d[i] * H[0][k];
  }
}

/* G of points about one origin, added to that about another. [in] d - from the new origin to the old one */
static void GramAddShifted_Private(const PetscReal d[3], const PetscReal G[GRAM], PetscReal sum[GRAM])
{
  PetscReal H[MONOMIALS][MONOMIALS], C[MONOMIALS][MONOMIALS];
  PetscInt  n = 0;

  GramFill_Private(G, H);
  GramShiftRows_Private(d, H);
  for (PetscInt i = 0; i < MONOMIALS; i++) {
    for (PetscInt j = 0; j < MONOMIALS; j++) C[i][j] = H[j][i];
  }
  GramShiftRows_Private(d, C);
  for (PetscInt i = 0; i < MONOMIALS; i++) {
    for (PetscInt j = i; j < MONOMIALS; j++) sum[n++] += C[i][j];
  }
}

/* The gradient of a quadric at a point is made one long. Returns whether the quadric passes through the point
   and is close to a normal there. [in] scale - length that distances are compared with; [in,out] c - about
   the point */
static PetscBool QuadricPasses_Private(const PetscReal normal[3], PetscReal scale, PetscReal c[MONOMIALS])
{
  const PetscReal slope = VectorNorm(3, &c[LINEAR]);

  if (!(slope > 0)) return PETSC_FALSE;
  for (PetscInt k = 0; k < MONOMIALS; k++) c[k] /= slope;
  return (PetscBool)(PetscAbsReal(c[0]) <= ON_QUADRIC * scale && VectorDot(3, &c[LINEAR], normal) >= SURELY_SMOOTH);
}

/* The mean square distance of the points of G from the origin. */
static PetscReal GramSquare_Private(const PetscReal G[GRAM])
{
  return (G[GramIndex_Private(1, 1)] + G[GramIndex_Private(2, 2)] + G[GramIndex_Private(3, 3)]) / G[0];
}

/* The flattest quadric through the points of G and the origin: its squares are minimal.
   Returns whether the points lie on it. [in] normal - close to its own; [out] c - coefficients */
static PetscBool QuadricFit_Private(const PetscReal G[GRAM], const PetscReal normal[3], PetscReal c[MONOMIALS])
{
  const PetscReal size                      = PetscSqrtReal(GramSquare_Private(G));
  PetscReal       B[(1 + FREE) * MONOMIALS] = {0}, Q[9], H[(1 + FREE) * (1 + FREE)], A[FREE * FREE], V[FREE * FREE];
  PetscReal       value[FREE], most = 0, distance;

  FrameFromNormal(3, normal, Q);
  for (PetscInt k = 0; k < 9; k++) B[k / 3 * MONOMIALS + LINEAR + k % 3] = Q[k];
  for (PetscInt i = 3; i < 1 + FREE; i++) B[i * MONOMIALS + SQUARE + i - 3] = 1 / size;
  GramTransform_Private(1 + FREE, B, G, H);
  for (PetscInt k = 0; k < FREE * FREE; k++) A[k] = H[(1 + k / FREE) * (1 + FREE) + 1 + k % FREE];
  DenseEigen(FREE, A, value, V);
  for (PetscInt k = 0; k < FREE; k++) most = PetscMax(most, value[k]);
  distance = H[0];
  for (PetscInt l = 0; l < MONOMIALS; l++) c[l] = B[l];
  for (PetscInt k = 0; k < FREE; k++) {
    PetscReal along = 0;

    if (value[k] <= NO_EIGENVALUE * most) continue;
    for (PetscInt i = 0; i < FREE; i++) along -= V[i * FREE + k] * H[1 + i];
    distance -= along * along / value[k];
    for (PetscInt i = 0; i < FREE; i++) {
      for (PetscInt l = 0; l < MONOMIALS; l++) c[l] += V[i * FREE + k] * along / value[k] * B[(1 + i) * MONOMIALS + l];
    }
  }
  if (distance > G[0] * PetscSqr(ON_QUADRIC * size)) return PETSC_FALSE;
  return QuadricPasses_Private(normal, size, c);
}

/* Points of the facets around each node. [out] sums - [num][F][SUMS] */
static PetscErrorCode PatchSumPoints_Private(const SmoothSide *side, PetscReal sums[])
{
  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt  num = ElementNumNodes(side->facets->type[f]);
    const PetscInt *corner;
    PetscInt        corners, parts;

    FrameGetParts(num, &parts, &corners, &corner);
    for (PetscInt p = 0; p < parts * corners; p++) {
      const PetscInt i = corner[p];

      sums[(f * F + i) * SUMS + SUM_COUNT] += 1;
      for (PetscInt q = 0; q < corners; q++) {
        PetscReal d[3];

        SideGetWay(side->level, side->facets, f, i, corner[p / corners * corners + q], d);
        GramAddPoint_Private(d, &sums[(f * F + i) * SUMS]);
      }
    }
  }
  PetscCall(SideSumAtNodes(side->nodes, SUMS, side->shape->ridge, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a neighbour adds to the number of points in the two rings around a node: its edges to the outer ring,
   less one that ends where an edge of the next neighbour does. Both facets at the neighbour add half of it.
   [in] num - facets at the neighbour; [in] corners - of each */
static PetscReal PointsBehind_Private(const SmoothSide *side, PetscInt f, PetscInt j, PetscReal num, PetscInt corners)
{
  const PetscInt c = f * F + j, own = corners == 3 ? 4 : 3; // edges in the facets at the node, and one

  if (side->shape->ridge[c] != 0) return 0;
  return 0.5 * (num + (side->share[c] < INNER_TURN ? 1 : 0) - own);
}

/* Points of the facets around the neighbours of each node.
   [in] ring - of PatchSumPoints_Private(); [out] sums - [num][F][SUMS] */
static PetscErrorCode PatchSumRings_Private(const SmoothSide *side, const PetscReal ring[], PetscReal sums[])
{
  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt *corner;
    PetscInt        corners, parts;

    FrameGetParts(ElementNumNodes(side->facets->type[f]), &parts, &corners, &corner);
    for (PetscInt p = 0; p < parts * corners; p++) {
      const PetscInt i    = corner[p];
      PetscReal     *mine = &sums[(f * F + i) * SUMS];

      if (side->share[f * F + i] < INNER_TURN) continue;
      mine[SUM_COUNT] += corners - 2;
      for (PetscInt q = 1; q < corners; q++) {
        const PetscInt   j     = corner[p / corners * corners + (p + q) % corners];
        const PetscReal *other = &ring[(f * F + j) * SUMS];
        PetscReal        d[3];

        if (q == 1 || q == corners - 1) mine[SUM_COUNT] += PointsBehind_Private(side, f, j, other[SUM_COUNT], corners);
        if (side->shape->ridge[f * F + j] != 0) continue;
        SideGetWay(side->level, side->facets, f, i, j, d);
        GramAddShifted_Private(d, other, mine);
      }
    }
  }
  PetscCall(SideSumAtNodes(side->nodes, SUMS, side->shape->ridge, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fits quadrics to the points around inner nodes of the patch. [in] sums - of PatchSumRings_Private(); [out]
   quadric - about the node of each corner, zero where there is none [num][F][MONOMIALS] */
static PetscErrorCode PatchFit_Private(const SmoothSide *side, const PetscReal sums[], PetscReal quadric[])
{
  PetscInt *first; // corner of each node whose quadric is known, and one more

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(side->level->num_nodes, &first));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      const PetscInt c = f * F + i, node = side->facets->nodes[c];
      PetscReal     *own = &quadric[c * MONOMIALS];

      if (side->share[c] < INNER_TURN || side->shape->ridge[c] != 0) continue;
      if (first[node]) {
        PetscCall(PetscArraycpy(own, &quadric[(first[node] - 1) * MONOMIALS], MONOMIALS));
        continue;
      }
      first[node] = c + 1;
      if (sums[c * SUMS + SUM_COUNT] < FREE + EVIDENCE) continue;
      if (!QuadricFit_Private(&sums[c * SUMS], &side->shape->normal[c * 3], own))
        PetscCall(PetscArrayzero(own, MONOMIALS));
    }
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A neighbour's quadric about this corner's node. Returns whether there is one that passes through the node.
   [in] i, j - corners of facet f; [out] c - [MONOMIALS] */
static PetscBool PatchCarry_Private(const SmoothSide *side, const PetscReal quadric[], PetscInt f, PetscInt i,
                                    PetscInt j, PetscReal c[])
{
  const PetscReal *other = &quadric[(f * F + j) * MONOMIALS];
  PetscReal        d[3];

  if (VectorNorm(3, &other[LINEAR]) == 0) return PETSC_FALSE;
  SideGetWay(side->level, side->facets, f, j, i, d);
  c[0] = QuadricValue(other, d, &c[LINEAR]);
  for (PetscInt k = SQUARE; k < MONOMIALS; k++) c[k] = other[k];
  return QuadricPasses_Private(&side->shape->normal[(f * F + i) * 3], VectorNorm(3, d), c);
}

/* Drops quadrics that do not pass through the points around all inner neighbours, too: one through five lines
   of a mesh that is extruded always exists. Collective.
   [in] sums - of PatchSumRings_Private(); [in,out] quadric */
static PetscErrorCode PatchConfirm_Private(const SmoothSide *side, const PetscReal sums[], PetscReal quadric[])
{
  const PetscInt num = side->facets->num * F;
  PetscReal     *against;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num, &against));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt n = ElementNumNodes(side->facets->type[f]);

    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        const PetscReal *G = &sums[(f * F + j) * SUMS];
        PetscReal        c[MONOMIALS], distance = 0;

        if (i == j || side->share[f * F + j] < INNER_TURN || side->shape->ridge[f * F + j] != 0) continue;
        if (PatchCarry_Private(side, quadric, f, j, i, c))
          GramTransform_Private(1, c, G, &distance);
        else
          distance = PETSC_MAX_REAL;
        if (distance > G[0] * PetscSqr(CONFIRMS) * GramSquare_Private(G)) against[f * F + i] = 1;
      }
    }
  }
  PetscCall(SideSumAtNodes(side->nodes, 1, side->shape->ridge, against));
  for (PetscInt c = 0; c < num; c++) {
    if (against[c] > 0) PetscCall(PetscArrayzero(&quadric[c * MONOMIALS], MONOMIALS));
  }
  PetscCall(PetscFree(against));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes without a quadric take the mean of their neighbours'. Collective. [in,out] quadric */
static PetscErrorCode PatchSpread_Private(const SmoothSide *side, PetscReal quadric[])
{
  const PetscInt num = side->facets->num * F;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * MONOMIALS, &sums));
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt n = ElementNumNodes(side->facets->type[f]);

    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        PetscReal c[MONOMIALS];

        if (i == j || !PatchCarry_Private(side, quadric, f, i, j, c)) continue;
        for (PetscInt k = 0; k < MONOMIALS; k++) sums[(f * F + i) * MONOMIALS + k] += c[k];
      }
    }
  }
  PetscCall(SideSumAtNodes(side->nodes, MONOMIALS, side->shape->ridge, sums));
  for (PetscInt c = 0; c < num; c++) {
    PetscReal *own = &quadric[c * MONOMIALS], *sum = &sums[c * MONOMIALS];

    if (VectorNorm(3, &own[LINEAR]) > 0 || VectorNorm(3, &sum[LINEAR]) == 0 || side->shape->ridge[c] != 0) continue;
    for (PetscInt k = 0; k < MONOMIALS; k++) own[k] = sum[k] / VectorNorm(3, &sum[LINEAR]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The quadric of each facet: one of its corners', if it passes through all of its nodes.
   [in] quadric - of corners; [out] of_facet - zero where there is none [num] */
static void PatchSetFacets_Private(const SmoothSide *side, const PetscReal quadric[], Quadric of_facet[])
{
  for (PetscInt f = 0; f < side->facets->num; f++) {
    const PetscInt n     = ElementNumNodes(side->facets->type[f]);
    PetscBool      found = PETSC_FALSE;

    for (PetscInt i = 0; i < n && !found; i++) {
      PetscReal c[MONOMIALS];

      found = (PetscBool)(VectorNorm(3, &quadric[(f * F + i) * MONOMIALS + LINEAR]) > 0);
      for (PetscInt j = 0; j < n && found; j++)
        found = (PetscBool)(i == j || PatchCarry_Private(side, quadric, f, j, i, c));
      for (PetscInt k = 0; k < 3 && found; k++)
        of_facet[f].origin[k] = SideGetPosition(side->level, side->facets, f, i, k);
      for (PetscInt k = 0; k < MONOMIALS && found; k++) of_facet[f].c[k] = quadric[(f * F + i) * MONOMIALS + k];
    }
  }
}

/* Corners at feature edges have no quadric of their own: the normal there is that of their facet's.
   [in,out] exact - [num][F][3] */
static void PatchSetRidges_Private(const SmoothSide *side, const Quadric of_facet[], PetscReal exact[])
{
  for (PetscInt f = 0; f < side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(side->facets->type[f]); i++) {
      const PetscInt c = f * F + i;
      PetscReal      x[3];

      if (side->shape->ridge[c] == 0 || VectorNorm(3, &of_facet[f].c[LINEAR]) == 0) continue;
      for (PetscInt k = 0; k < 3; k++)
        x[k] = SideGetPosition(side->level, side->facets, f, i, k) - of_facet[f].origin[k];
      (void)QuadricValue(of_facet[f].c, x, &exact[3 * c]);
      FrameNormalize(3, &exact[3 * c]);
    }
  }
}

PetscErrorCode SideQuadricsGetNormals(const SmoothSide *side, Quadric of_facet[], PetscReal exact[], PetscReal about[])
{
  const PetscInt num = side->facets->num * F;
  PetscReal     *ring, *rings;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(about, num * MONOMIALS));
  PetscCall(PetscArrayzero(of_facet, side->facets->num));
  PetscCall(PetscCalloc2(num * SUMS, &ring, num * SUMS, &rings));
  PetscCall(PatchSumPoints_Private(side, ring));
  PetscCall(PatchSumRings_Private(side, ring, rings));
  PetscCall(PatchFit_Private(side, rings, about));
  PetscCall(PatchConfirm_Private(side, rings, about));
  for (PetscInt k = 0; k < SPREADS; k++) PetscCall(PatchSpread_Private(side, about));
  for (PetscInt c = 0; c < num; c++) PetscCall(PetscArraycpy(&exact[3 * c], &about[c * MONOMIALS + LINEAR], 3));
  PatchSetFacets_Private(side, about, of_facet);
  PatchSetRidges_Private(side, of_facet, exact);
  PetscCall(PetscFree2(ring, rings));
  PetscFunctionReturn(PETSC_SUCCESS);
}
