/* sidekinks.c -- edges where two surfaces of a part meet at less than 44 degrees (eq. 4.1a).

   A mean normal there is tilted to both surfaces. Arcs from it would rise above the facets on both sides, by
   more than the overlap of a fit. A fillet looks alike: its first facets leave the quadric at an angle, too.
   But it goes on to turn. Behind an edge the surface is straight, or it ends. */
#include "side/sidekinks.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Least angle of a kink, in radians: quadrics of surfaces without one agree to a hundredth of it. */
static const PetscReal KINK = 0.05;
/* A surface that turns evenly has turned twice the angle of its first facet at the end of that. Below this
   multiple it is straight. */
static const PetscReal TURNS_ON = 1.5;

typedef struct {
  Level           *level;
  const Facets    *facets;
  const SideSums  *nodes;
  const PetscReal *about;
  SideShape       *shape;
  PetscReal       *own;  /* normal of the facet's quadric, zero where it has none [num][F][3] */
  PetscReal       *kink; /* not 0 at nodes of kinks [num][F] */
} Kinks;

static PetscBool KinksOnQuadric_Private(const Kinks *kinks, PetscInt c)
{
  return (PetscBool)(VectorNorm(3, &kinks->own[3 * c]) > 0);
}

static void KinksSetOwn_Private(Kinks *kinks)
{
  for (PetscInt f = 0; f < kinks->facets->num; f++) {
    const Quadric *quadric = &kinks->shape->quadric[f];

    if (VectorNorm(3, &quadric->c[QUADRIC_LINEAR]) == 0) continue;
    for (PetscInt i = 0; i < ElementNumNodes(kinks->facets->type[f]); i++) {
      PetscReal x[3];

      for (PetscInt k = 0; k < 3; k++)
        x[k] = SideGetPosition(kinks->level, kinks->facets, f, i, k) - quadric->origin[k];
      (void)QuadricValue(quadric->c, x, &kinks->own[3 * (f * F + i)]);
      FrameNormalize(3, &kinks->own[3 * (f * F + i)]);
    }
  }
}

/* Marks nodes between two quadrics. Unit normals in two groups differ by an angle. If the smaller group has a
   sixth of them or more, 1 - |mean|^2 is at least an eighth of its square. Collective. */
static PetscErrorCode KinksMarkBetween_Private(Kinks *kinks)
{
  const PetscInt num = kinks->facets->num * F;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * 4, &sums));
  for (PetscInt c = 0; c < num; c++) {
    if (!KinksOnQuadric_Private(kinks, c)) continue;
    PetscCall(PetscArraycpy(&sums[4 * c], &kinks->own[3 * c], 3));
    sums[4 * c + 3] = 1;
  }
  PetscCall(SideSumAtNodes(kinks->nodes, 4, kinks->shape->ridge, sums));
  for (PetscInt c = 0; c < num; c++) {
    const PetscReal square = VectorDot(3, &sums[4 * c], &sums[4 * c]), count = sums[4 * c + 3];

    if (square < count * count * (1 - KINK * KINK / 8)) kinks->kink[c] = 1;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The quadric of corner i, at corner j. Returns the distance of j from it, positive outside.
   [out] n - its unit normal there */
static PetscReal KinksGetDistance_Private(const Kinks *kinks, PetscInt f, PetscInt i, PetscInt j, PetscReal n[3])
{
  PetscReal d[3], value;

  SideGetWay(kinks->level, kinks->facets, f, i, j, d);
  value = QuadricValue(&kinks->about[(f * F + i) * QUADRIC_MONOMIALS], d, n);
  return value / FrameNormalize(3, n);
}

/* Whether a part of a facet leaves a quadric at an angle along its edge from corner i to k, and does not turn
   on. Corner j of the part is on none. Angles are small: a distance over a length, differences of normals. */
static PetscBool KinksLeaves_Private(const Kinks *kinks, PetscInt f, PetscInt i, PetscInt k, PetscInt j)
{
  const PetscInt ends[2] = {i, k};
  PetscReal      edge[3], way[3], n[3], along, length, angle = 0, turn = 0;

  if (VectorNorm(3, &kinks->about[(f * F + j) * QUADRIC_MONOMIALS + QUADRIC_LINEAR]) > 0) return PETSC_FALSE;
  SideGetWay(kinks->level, kinks->facets, f, i, k, edge);
  SideGetWay(kinks->level, kinks->facets, f, i, j, way);
  FrameNormalize(3, edge);
  along = VectorDot(3, way, edge);
  for (PetscInt l = 0; l < 3; l++) way[l] -= along * edge[l];
  length = FrameNormalize(3, way);
  for (PetscInt e = 0; e < 2; e++) {
    if (VectorNorm(3, &kinks->about[(f * F + ends[e]) * QUADRIC_MONOMIALS + QUADRIC_LINEAR]) == 0) return PETSC_FALSE;
    angle -= KinksGetDistance_Private(kinks, f, ends[e], j, n) / length / 2;
    turn += (VectorDot(3, &kinks->shape->normal[3 * (f * F + j)], way) - VectorDot(3, n, way)) / 2;
  }
  return (PetscBool)(PetscAbsReal(angle) > KINK && turn / angle < TURNS_ON);
}

/* Marks nodes where facets on no quadric leave one. */
static void KinksMarkBeside_Private(Kinks *kinks)
{
  for (PetscInt f = 0; f < kinks->facets->num; f++) {
    const PetscInt *corner;
    PetscInt        corners, parts;

    if (KinksOnQuadric_Private(kinks, f * F)) continue;
    FrameGetParts(ElementNumNodes(kinks->facets->type[f]), &parts, &corners, &corner);
    for (PetscInt p = 0; p < parts * corners; p++) {
      const PetscInt *part = &corner[p / corners * corners];
      const PetscInt  i = corner[p], k = part[(p + 1) % corners], j = part[(p + 2) % corners];

      if (KinksLeaves_Private(kinks, f, i, k, j)) kinks->kink[f * F + i] = kinks->kink[f * F + k] = 1;
    }
  }
}

/* What corners at a node sum: normals of facets on no quadric, their number, the number of others; then unit
   vectors o to the middles of facets, and n.o with the normal of each. */
enum { KINK_NORMAL, KINK_FREE = 3, KINK_ON, KINK_SUMS, KINK_WAY = 0, KINK_ACROSS = 3, KINK_WAYS };

/* Gives corners at kinks the normals of their own parts. Collective. [out] split - corners that have
   become those of a feature edge [num][F] */
static PetscErrorCode KinksSetNormals_Private(Kinks *kinks, const PetscReal weighted[], PetscReal share[],
                                              PetscBool split[])
{
  const PetscInt num = kinks->facets->num * F;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * KINK_SUMS, &sums));
  for (PetscInt f = 0; f < kinks->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(kinks->facets->type[f]); i++) {
      PetscReal      *at = &sums[(f * F + i) * KINK_SUMS];
      const PetscBool on = KinksOnQuadric_Private(kinks, f * F + i);

      at[on ? KINK_ON : KINK_FREE] = 1;
      for (PetscInt k = 0; k < 3 && !on; k++) at[KINK_NORMAL + k] = weighted[3 * (f * F + i) + k];
    }
  }
  PetscCall(SideSumAtNodes(kinks->nodes, KINK_SUMS, kinks->shape->ridge, sums));
  for (PetscInt c = 0; c < num; c++) {
    PetscReal      *at = &sums[c * KINK_SUMS];
    const PetscBool on = KinksOnQuadric_Private(kinks, c);

    split[c] = (PetscBool)(kinks->kink[c] > 0 && at[KINK_ON] > 0 && kinks->shape->ridge[c] == 0);
    if (!split[c]) continue;
    share[c] *= PetscMin(at[on ? KINK_ON : KINK_FREE] / (at[KINK_ON] + at[KINK_FREE]), 0.5);
    FrameNormalize(3, &at[KINK_NORMAL]);
    PetscCall(PetscArraycpy(&kinks->shape->normal[3 * c], on ? &kinks->own[3 * c] : &at[KINK_NORMAL], 3));
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether kinks are convex: normals of the other facets around lean towards these. Collective. */
static PetscErrorCode KinksSetRidges_Private(Kinks *kinks, const PetscBool split[])
{
  const PetscInt   num    = kinks->facets->num * F;
  const PetscReal *normal = kinks->shape->normal;
  PetscReal       *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num * KINK_WAYS, &sums));
  for (PetscInt f = 0; f < kinks->facets->num; f++) {
    const PetscInt corners = ElementNumNodes(ElementLinear(kinks->facets->type[f]));

    for (PetscInt i = 0; i < ElementNumNodes(kinks->facets->type[f]); i++) {
      PetscReal *at = &sums[(f * F + i) * KINK_WAYS];

      for (PetscInt v = 0; v < corners; v++) {
        PetscReal d[3];

        SideGetWay(kinks->level, kinks->facets, f, i, v, d);
        for (PetscInt k = 0; k < 3; k++) at[KINK_WAY + k] += d[k];
      }
      FrameNormalize(3, &at[KINK_WAY]);
      at[KINK_ACROSS] = VectorDot(3, &normal[3 * (f * F + i)], &at[KINK_WAY]);
    }
  }
  PetscCall(SideSumAtNodes(kinks->nodes, KINK_WAYS, kinks->shape->ridge, sums));
  for (PetscInt c = 0; c < num; c++) {
    const PetscReal *at = &sums[c * KINK_WAYS];

    if (split[c]) kinks->shape->ridge[c] = at[KINK_ACROSS] - VectorDot(3, &normal[3 * c], &at[KINK_WAY]) > 0 ? 1 : -1;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideKinksSplit(const SmoothSide *side, const PetscReal weighted[], const PetscReal about[],
                              PetscReal share[], SideShape *shape, PetscBool *any)
{
  const PetscInt num = side->facets->num * F;
  Kinks kinks = {.level = side->level, .facets = side->facets, .nodes = side->nodes, .about = about, .shape = shape};
  PetscBool *split;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(num * 3, &kinks.own, num, &kinks.kink, num, &split));
  KinksSetOwn_Private(&kinks);
  PetscCall(KinksMarkBetween_Private(&kinks));
  KinksMarkBeside_Private(&kinks);
  PetscCall(SideSumAtNodes(side->nodes, 1, shape->ridge, kinks.kink));
  PetscCall(KinksSetNormals_Private(&kinks, weighted, share, split));
  PetscCall(KinksSetRidges_Private(&kinks, split));
  *any = PETSC_FALSE;
  for (PetscInt c = 0; c < num; c++) *any = (PetscBool)(*any || split[c]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, side->level->comm));
  PetscCall(PetscFree3(kinks.own, kinks.kink, split));
  PetscFunctionReturn(PETSC_SUCCESS);
}
