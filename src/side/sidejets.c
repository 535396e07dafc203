/* sidejets.c -- polynomials through the nodes around a node (eq. 4.1c).

   In the frame of its normal the surface around a node is a height z = p(x, y) over the tangent plane. p has
   degree 4, and its gradient at the node corrects the normal. The nodes of the facets around have heights,
   and their own normals and curvatures give slopes and second derivatives there. So the facets around the
   node are enough, and sums over these make the least squares, in any partition. Normals depend on those of
   neighbours: a few sweeps repeat this, the first ones for degree 3 without curvatures, which are not known
   yet. The method is that of osculating jets with normals.

   References:
     [1] F. Cazals, M. Pouget, Comput. Aided Geom. Des. 22 (2005) 121-146.
     [2] J. Goldfeather, V. Interrante, ACM Trans. Graph. 23 (2004) 45-63. */
#include "side/sidejets.h"
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

enum {
  F            = ELEMENT_MAX_FACET_NODES,
  CUBIC        = 9,  /* coefficients of degree 1 to 3 */
  QUARTIC      = 14, /* of degree 1 to 4 */
  FIRST_SWEEPS = 2,  /* of degree 3 */
  SWEEPS       = 8,
  MATRIX       = QUARTIC * (QUARTIC + 1) / 2,
  SUM_RIGHT    = MATRIX, /* behind the lower triangle of the matrix */
  SUM_COUNT    = MATRIX + QUARTIC,
  SUMS
};

/* Neighbours that turn by more than 60 degrees are no heights over the tangent plane. */
static const PetscReal LEAST_TURN = 0.5;
/* Weights of slopes and second derivatives, as shares of that of heights: derivatives of a term of degree 5
   are 5 and 20 times as large. */
static const PetscReal SLOPES = 1. / 5, SECONDS = 1. / 20;
/* Added to the diagonal, as a share of its mean: coefficients that nodes do not determine become small. */
static const PetscReal UNDETERMINED = 1e-8;

/* Error of a normal over what is left of (4.1d): 1.8 to 2 on a torus, 1.1 to 1.2 on waves, because errors of
   curvatures compensate a part. */
static const PetscReal OF_LEFT = 2;

/* The cosine of planes that are orthogonal. */
static const PetscReal ORTHOGONAL = 1e-6;

/* What is known of a node. */
typedef enum { NODE_POSITION, NODE_NORMAL, NODE_JET } NodeKind;

typedef struct {
  PetscReal normal[3], curvature[9]; /* S = dn/dx */
  PetscReal size;                    /* mean distance of its neighbours */
  PetscReal p[QUARTIC];              /* height / size, of positions / size, in the frame of base */
  PetscReal base[9];
  NodeKind  kind;
  PetscBool done; /* p is known */
} Node;

typedef struct {
  const SmoothSide *side;
  Node             *node; /* [side->nodes->num] */
  PetscInt          num;  /* coefficients in this sweep */
} Jets;

/* What to do with corners i and j of one part of facet f, from i to j. */
typedef void (*JetsVisit)(Jets *jets, PetscInt f, PetscInt i, PetscInt j, PetscReal sums[]);

static void JetsVisitPairs_Private(Jets *jets, JetsVisit visit, PetscReal sums[])
{
  for (PetscInt f = 0; f < jets->side->facets->num; f++) {
    const PetscInt *corner;
    PetscInt        corners, parts;

    FrameGetParts(ElementNumNodes(jets->side->facets->type[f]), &parts, &corners, &corner);
    for (PetscInt p = 0; p < parts * corners; p++) {
      for (PetscInt q = 1; q < corners; q++)
        visit(jets, f, corner[p], corner[p / corners * corners + (p + q) % corners], sums);
    }
  }
}

/* Sums distances of neighbours, heights over the tangent plane, and 1. */
enum { SIZE_LENGTH, SIZE_HEIGHT, SIZE_COUNT, SIZES };

static void JetsAddSize_Private(Jets *jets, PetscInt f, PetscInt i, PetscInt j, PetscReal sums[])
{
  const PetscInt node = jets->side->nodes->corner[f * F + i];
  PetscReal     *at   = &sums[node * SIZES], d[3];

  SideGetWay(jets->side->level, jets->side->facets, f, i, j, d);
  at[SIZE_LENGTH] += VectorNorm(3, d);
  at[SIZE_HEIGHT] += PetscAbsReal(VectorDot(3, d, jets->node[node].normal));
  at[SIZE_COUNT] += 1;
}

/* Whether two planes of symmetry meet at a node and are not orthogonal. The normal is tangential to both, but
   the facets around and their images in each plane do not surround the node. */
static PetscBool JetsIsOblique_Private(const Jets *jets, PetscInt node)
{
  const PetscInt on = jets->side->planes->on[node];

  for (PetscInt q = 0; q < jets->side->planes->num; q++) {
    for (PetscInt r = 0; r < q; r++) {
      if (!(on >> q & 1) || !(on >> r & 1)) continue;
      if (PetscAbsReal(VectorDot(3, jets->side->planes->normal[q], jets->side->planes->normal[r])) > ORTHOGONAL)
        return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* Sets what is known before. Collective. [in] exact - [num][F][3]; [out] any - whether a node needs a jet */
static PetscErrorCode JetsBegin_Private(Jets *jets, const PetscReal exact[], PetscBool *any)
{
  PetscReal *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(jets->side->nodes->num * SIZES, &sums));
  for (PetscInt f = 0; f < jets->side->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(jets->side->facets->type[f]); i++) {
      const PetscInt  c     = f * F + i;
      Node           *node  = &jets->node[jets->side->nodes->corner[c]];
      const PetscBool known = (PetscBool)(VectorNorm(3, &exact[3 * c]) > 0);

      if (jets->side->share[c] < INNER_TURN || jets->side->shape->ridge[c] != 0) continue;
      node->kind = known || JetsIsOblique_Private(jets, jets->side->nodes->corner[c]) ? NODE_NORMAL : NODE_JET;
      PetscCall(PetscArraycpy(node->normal, known ? &exact[3 * c] : &jets->side->shape->normal[3 * c], 3));
    }
  }
  JetsVisitPairs_Private(jets, JetsAddSize_Private, sums);
  PetscCall(SideSumsShare(jets->side->nodes, SIZES, sums));
  *any = PETSC_FALSE;
  for (PetscInt n = 0; n < jets->side->nodes->num; n++) {
    const PetscReal *at   = &sums[n * SIZES];
    Node            *node = &jets->node[n];

    if (node->kind != NODE_JET) continue;
    node->size = at[SIZE_LENGTH] / at[SIZE_COUNT];
    if (at[SIZE_HEIGHT] <= FLAT_SIDE * at[SIZE_LENGTH]) node->kind = NODE_NORMAL;
    *any = (PetscBool)(*any || node->kind == NODE_JET);
  }
  PetscCall(PetscFree(sums));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, jets->side->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The derivative of all monomials at a place, a times by x and b times by y. [out] m - [QUARTIC] */
static void JetMonomials_Private(PetscReal x, PetscReal y, PetscInt a, PetscInt b, PetscReal m[])
{
  static const PetscReal factor[3][5] = {{1, 1, 1, 1, 1}, {0, 1, 2, 3, 4}, {0, 0, 2, 6, 12}}; // of powers
  PetscReal              X[5]         = {1, x, x * x, x * x * x, x * x * x * x};
  PetscReal              Y[5]         = {1, y, y * y, y * y * y, y * y * y * y};
  PetscInt               n            = 0;

  for (PetscInt degree = 1; degree <= 4; degree++) {
    for (PetscInt j = 0; j <= degree; j++, n++)
      m[n] = degree - j < a || j < b ? 0 : factor[a][degree - j] * X[degree - j - a] * factor[b][j] * Y[j - b];
  }
}

/* Adds an equation m.p = right to the least squares. */
static void JetAddRow_Private(PetscInt num, PetscReal weight, const PetscReal m[], PetscReal right, PetscReal sums[])
{
  PetscInt n = 0;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j <= i; j++) sums[n++] += weight * m[i] * m[j];
    sums[SUM_RIGHT + i] += weight * m[i] * right;
  }
  sums[SUM_COUNT] += 1;
}

/* Slopes and second derivatives of the surface at a place, from its normal n and S: n is normal to both
   tangents t_a = e_a - n_a / n_z e_z, and n_z p_ab = -t_a.S t_b. */
static void JetAddDerivatives_Private(PetscInt num, const PetscReal Q[9], const Node *at, PetscReal size, PetscReal x,
                                      PetscReal y, PetscReal sums[])
{
  PetscReal n[3], t[2][3], m[QUARTIC];

  for (PetscInt k = 0; k < 3; k++) n[k] = VectorDot(3, &Q[3 * k], at->normal); // Q has rows (e_z, e_x, e_y)
  for (PetscInt a = 0; a < 2; a++) {
    JetMonomials_Private(x, y, a == 0, a == 1, m);
    JetAddRow_Private(num, PetscSqr(SLOPES * n[0]), m, -n[1 + a] / n[0], sums);
    for (PetscInt k = 0; k < 3; k++) t[a][k] = Q[3 * (1 + a) + k] - n[1 + a] / n[0] * Q[k];
  }
  if (num == CUBIC || at->kind != NODE_JET) return;
  for (PetscInt a = 0; a < 2; a++) {
    for (PetscInt b = 0; b <= a; b++) {
      PetscReal St[3], second;

      for (PetscInt k = 0; k < 3; k++) St[k] = VectorDot(3, &at->curvature[3 * k], t[b]);
      second = -VectorDot(3, t[a], St) / n[0] * size;
      JetMonomials_Private(x, y, (a == 0) + (b == 0), (a == 1) + (b == 1), m);
      JetAddRow_Private(num, PetscSqr(SECONDS * n[0]) * (x * x + y * y), m, second, sums);
    }
  }
}

/* Adds what another node at the distance d says of the surface around a node. [in,out] at - [SUMS] */
static void JetsAddNode_Private(const Jets *jets, const Node *node, const Node *other, const PetscReal d[3],
                                PetscReal at[])
{
  const PetscReal x = VectorDot(3, d, &node->base[3]) / node->size, y = VectorDot(3, d, &node->base[6]) / node->size;
  PetscReal       m[QUARTIC];

  if (other->kind != NODE_POSITION && VectorDot(3, node->normal, other->normal) < LEAST_TURN) return;
  if (!(x * x + y * y > 0)) return;
  JetMonomials_Private(x, y, 0, 0, m);
  JetAddRow_Private(jets->num, 1 / (x * x + y * y), m, VectorDot(3, d, node->base) / node->size, at);
  if (other->kind != NODE_POSITION) JetAddDerivatives_Private(jets->num, node->base, other, node->size, x, y, at);
}

/* Adds what another node says of the surface around a node, and so do its images behind planes of symmetry,
   from plane q on. [in] d - from the node to the other one */
static void JetsAddImages_Private(const Jets *jets, PetscInt own, PetscInt q, const Node *other, const PetscReal d[3],
                                  PetscReal sums[])
{
  Node      image = *other;
  PetscReal way[3];

  while (q < jets->side->planes->num && !(jets->side->planes->on[own] >> q & 1)) q++;
  if (q == jets->side->planes->num) {
    JetsAddNode_Private(jets, &jets->node[own], other, d, &sums[own * SUMS]);
    return;
  }
  for (PetscInt k = 0; k < 3; k++) way[k] = d[k];
  SidePlanesReflect(jets->side->planes, 3, q, way);
  SidePlanesReflect(jets->side->planes, 3, q, image.normal);
  SidePlanesReflectMatrix(jets->side->planes, 3, q, image.curvature);
  JetsAddImages_Private(jets, own, q + 1, other, d, sums);
  JetsAddImages_Private(jets, own, q + 1, &image, way, sums);
}

/* Adds what corner j says of the surface around the node of corner i. */
static void JetsAddPair_Private(Jets *jets, PetscInt f, PetscInt i, PetscInt j, PetscReal sums[])
{
  const PetscInt own = jets->side->nodes->corner[f * F + i];
  PetscReal      d[3];

  if (jets->node[own].kind != NODE_JET) return;
  SideGetWay(jets->side->level, jets->side->facets, f, i, j, d);
  JetsAddImages_Private(jets, own, 0, &jets->node[jets->side->nodes->corner[f * F + j]], d, sums);
}

/* Coefficients of least squares. Returns whether there are enough equations. */
static PetscBool JetSolve_Private(PetscInt num, const PetscReal sums[], PetscReal p[QUARTIC])
{
  PetscReal A[QUARTIC * QUARTIC], mean = 0;
  PetscInt  n = 0;

  if (sums[SUM_COUNT] < 2 * num) return PETSC_FALSE; // two facets count each neighbour
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j <= i; j++) A[i * num + j] = A[j * num + i] = sums[n++];
    mean += A[i * num + i] / (PetscReal)num;
  }
  for (PetscInt i = 0; i < num; i++) A[i * num + i] += UNDETERMINED * mean;
  if (!DenseCholesky(num, A)) return PETSC_FALSE;
  for (PetscInt i = 0; i < QUARTIC; i++) p[i] = i < num ? sums[SUM_RIGHT + i] : 0;
  DenseCholeskySolve(num, A, p);
  return PETSC_TRUE;
}

/* The normal of a jet at a place x, y, in the frame of its node. [out] n - unit [3] */
static void JetGetNormal_Private(const Node *node, PetscReal x, PetscReal y, PetscReal n[3])
{
  PetscReal m[QUARTIC], slope[2];

  for (PetscInt a = 0; a < 2; a++) {
    JetMonomials_Private(x, y, a == 0, a == 1, m);
    slope[a] = VectorDot(QUARTIC, m, node->p);
  }
  for (PetscInt k = 0; k < 3; k++) n[k] = node->base[k] - slope[0] * node->base[3 + k] - slope[1] * node->base[6 + k];
  FrameNormalize(3, n);
}

/* The shape operator of a jet at its node: n.t = 0 for both tangents, t_a.S t_b = -n_z p_ab. [out] S - [9] */
static void JetGetCurvature_Private(const Node *node, PetscReal S[9])
{
  const PetscReal *Q = node->base, *p = node->p;
  const PetscReal  second[4] = {2 * p[2], p[3], p[3], 2 * p[4]}, square = 1 + p[0] * p[0] + p[1] * p[1];
  PetscReal        dual[2][3]; // dual_a.t_b is 1 for a = b, else 0

  for (PetscInt k = 0; k < 3; k++) {
    for (PetscInt a = 0; a < 2; a++)
      dual[a][k] = Q[3 * (1 + a) + k] + p[a] / square * (Q[k] - p[0] * Q[3 + k] - p[1] * Q[6 + k]);
    S[k] = S[3 + k] = S[6 + k] = 0;
  }
  for (PetscInt k = 0; k < 9; k++) {
    for (PetscInt ab = 0; ab < 4; ab++)
      S[k] -= second[ab] / (PetscSqrtReal(square) * node->size) * dual[ab / 2][k / 3] * dual[ab % 2][k % 3];
  }
}

/* One sweep over all nodes. Collective. */
static PetscErrorCode JetsSweep_Private(Jets *jets)
{
  PetscReal *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(jets->side->nodes->num * SUMS, &sums));
  for (PetscInt n = 0; n < jets->side->nodes->num; n++) FrameFromNormal(3, jets->node[n].normal, jets->node[n].base);
  JetsVisitPairs_Private(jets, JetsAddPair_Private, sums);
  PetscCall(SideSumsShare(jets->side->nodes, SUMS, sums));
  for (PetscInt n = 0; n < jets->side->nodes->num; n++) {
    Node *node = &jets->node[n];

    if (node->kind != NODE_JET) continue;
    node->done = JetSolve_Private(jets->num, &sums[n * SUMS], node->p);
    if (!node->done) continue;
    JetGetNormal_Private(node, 0, 0, node->normal);
    SidePlanesProject(jets->side->planes, 3, jets->side->planes->on[n], node->normal);
    JetGetCurvature_Private(node, node->curvature);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes a normal that is not far from the mean over facets. Returns whether it did. */
static PetscBool JetTake_Private(const PetscReal mean[3], const PetscReal n[3], PetscReal exact[3])
{
  if (!(VectorDot(3, mean, n) >= SURELY_SMOOTH)) return PETSC_FALSE;
  for (PetscInt k = 0; k < 3; k++) exact[k] = n[k];
  return PETSC_TRUE;
}

/* Ends of patches next to nodes with jets: the mean normal of these there. Collective.
   [in,out] fit - its normals and spreads */
static PetscErrorCode JetsSetEnds_Private(Jets *jets, SideFit *fit)
{
  const PetscInt num = jets->side->facets->num * F;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * 4, &sums));
  for (PetscInt f = 0; f < jets->side->facets->num; f++) {
    const PetscInt corners = ElementNumNodes(jets->side->facets->type[f]);

    for (PetscInt i = 0; i < corners; i++) {
      for (PetscInt j = 0; j < corners; j++) {
        const Node *other = &jets->node[jets->side->nodes->corner[f * F + j]];
        PetscReal   d[3], n[3];

        if (i == j || !other->done || jets->node[jets->side->nodes->corner[f * F + i]].kind != NODE_POSITION) continue;
        SideGetWay(jets->side->level, jets->side->facets, f, j, i, d);
        JetGetNormal_Private(other, VectorDot(3, d, &other->base[3]) / other->size,
                             VectorDot(3, d, &other->base[6]) / other->size, n);
        for (PetscInt k = 0; k < 3; k++) sums[(f * F + i) * 4 + k] += n[k];
        sums[(f * F + i) * 4 + 3] += 1;
      }
    }
  }
  PetscCall(SideSumAtNodes(jets->side->nodes, 4, jets->side->shape->ridge, sums));
  for (PetscInt c = 0; c < num; c++) {
    const PetscReal length = FrameNormalize(3, &sums[4 * c]);

    if (VectorNorm(3, &fit->normal[3 * c]) > 0 || length == 0) continue;
    fit->spread[c] = PetscSqrtReal(PetscMax(0, 1 - PetscSqr(length / sums[4 * c + 3])));
    (void)JetTake_Private(&jets->side->shape->normal[3 * c], &sums[4 * c], &fit->normal[3 * c]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of the squares of what is left of (4.1d), and of their number. */
enum { LEFT_SQUARES, LEFT_COUNT, LEFTS };

/* Adds what the angle of the chord to another node differs from the mean of the normal's angle along it. The
   smaller one of two means counts, with and without curvatures: if there are much shorter chords at an end,
   curvatures have errors of the angle over these. */
static void JetsAddLeft_Private(Jets *jets, PetscInt f, PetscInt i, PetscInt j, PetscReal sums[])
{
  const PetscInt own  = jets->side->nodes->corner[f * F + i];
  const Node    *from = &jets->node[own], *to = &jets->node[jets->side->nodes->corner[f * F + j]];
  PetscReal      d[3], left[2]                = {0, 0}, length;

  if (!from->done || !to->done) return;
  SideGetWay(jets->side->level, jets->side->facets, f, i, j, d);
  length = FrameNormalize(3, d);
  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal bend = VectorDot(3, &from->curvature[3 * k], d) - VectorDot(3, &to->curvature[3 * k], d);

    left[0] += d[k] * (from->normal[k] + to->normal[k]) / 2;
    left[1] += d[k] * ((from->normal[k] + to->normal[k]) / 2 + length * bend / 12);
  }
  sums[own * LEFTS + LEFT_SQUARES] += PetscMin(PetscSqr(left[0]), PetscSqr(left[1]));
  sums[own * LEFTS + LEFT_COUNT] += 1;
}

/* Errors of the normals of polynomials. Collective. [in,out] fit - its errors */
static PetscErrorCode JetsSetErrors_Private(Jets *jets, SideFit *fit)
{
  PetscReal *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(jets->side->nodes->num * LEFTS, &sums));
  JetsVisitPairs_Private(jets, JetsAddLeft_Private, sums);
  PetscCall(SideSumsShare(jets->side->nodes, LEFTS, sums));
  for (PetscInt c = 0; c < jets->side->facets->num * F; c++) {
    const PetscReal *at = &sums[jets->side->nodes->corner[c] * LEFTS];

    if (c % F >= ElementNumNodes(jets->side->facets->type[c / F])) continue;
    fit->error[c] = at[LEFT_COUNT] > 0 ? OF_LEFT * PetscSqrtReal(2 * at[LEFT_SQUARES] / at[LEFT_COUNT]) : 0;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideJetsGetNormals(const SmoothSide *side, SideFit *fit)
{
  const SideSums *nodes = side->nodes;
  Jets            jets  = {.side = side, .num = CUBIC};
  PetscBool       any;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(nodes->num, &jets.node));
  PetscCall(JetsBegin_Private(&jets, fit->normal, &any));
  for (PetscInt sweep = 0; sweep < SWEEPS && any; sweep++) {
    jets.num = sweep < FIRST_SWEEPS ? CUBIC : QUARTIC;
    PetscCall(JetsSweep_Private(&jets));
  }
  for (PetscInt f = 0; f < nodes->facets->num && any; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(nodes->facets->type[f]); i++) {
      const PetscInt c    = f * F + i;
      Node          *node = &jets.node[nodes->corner[c]];

      if (node->kind != NODE_JET || !node->done || side->shape->ridge[c] != 0) continue;
      if (JetTake_Private(&side->shape->normal[3 * c], node->normal, &fit->normal[3 * c])) {
        PetscCall(PetscArraycpy(&fit->curvature[9 * c], node->curvature, 9));
      } else { // the mean stays, and its error is told
        PetscCall(PetscArraycpy(node->normal, &side->shape->normal[3 * c], 3));
        PetscCall(PetscArrayzero(node->curvature, 9));
      }
    }
  }
  if (any) PetscCall(JetsSetErrors_Private(&jets, fit));
  if (any) PetscCall(JetsSetEnds_Private(&jets, fit));
  PetscCall(PetscFree(jets.node));
  PetscFunctionReturn(PETSC_SUCCESS);
}
