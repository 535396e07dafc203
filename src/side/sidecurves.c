/* sidecurves.c -- the curve through the nodes of a side in the plane (eq. 4.1b).

   The normal (4.1) of a node is that of the circle through it and its neighbours. Two more estimates are
   mirror images of the neighbours' normals in the parts between: circles through one neighbour and the next.
   Angles of parts are means of the normal's angle along them. So a mean of the three with the right weights
   is that of a polynomial through the angles of four parts. Where two circles agree the side is one: a line
   passes over into an arc there, and means would be wrong. */
#include "side/sidecurves.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

enum { F = ELEMENT_MAX_FACET_NODES, AHEAD = 0, BEHIND = 1, SIDES = 2 };

/* Circles agree if their normals differ by less than this share of the angle between two nodes. */
static const PetscReal SAME_CIRCLE = 1e-4;
/* The angle that the patch fills around an inner node, as a share of a full turn, is one up to this. */
static const PetscReal ONE_TURN = 0.2;

/* What the part ahead of a node, or behind it, says of its normal. */
typedef struct {
  PetscReal mirrored[2]; /* normal of the node at the other end, in this part */
  PetscReal length;
  PetscReal two;  /* length of both parts at the other end; 0 where that is an end of the patch */
  PetscReal same; /* 1 if the node's circle passes through the next part on this side as well, or is a line */
} Way;

/* Angles from a node's normal, ahead of it and behind: to the next node's normal, and to that of the part
   between. */
typedef struct {
  PetscReal node, part;
} Angles;

enum { WAYS = 2 * sizeof(Way) / sizeof(PetscReal), ANGLES = 2 * sizeof(Angles) / sizeof(PetscReal) };

typedef struct {
  const SmoothSide *smooth;
  PetscReal        *two;    /* length of both parts at a node [num][F] */
  Way (*way)[SIDES];        /* of each corner's node [num][F] */
  PetscReal (*next)[SIDES]; /* 1 if the circle of the node at the other end passes through one part more [num][F] */
  Angles (*angles)[SIDES];  /* of each corner's node [num][F] */
  PetscReal *exact;         /* normals [num][F][2] */
  PetscBool *mean;          /* whether the node's normal is the mean (4.1b) [num][F] */
} Curve;

/* Nodes of a facet along it. Returns the number of parts between them. [out] along - [3] */
static PetscInt FacetGetNodes_Private(ElementType type, PetscInt along[])
{
  const PetscInt parts = ElementOrder(type);

  along[0]     = 0;
  along[1]     = 2;
  along[parts] = 1;
  return parts;
}

/* Whether the patch surrounds the node of a corner. */
static PetscBool CurveIsInner_Private(const Curve *curve, PetscInt c)
{
  return (PetscBool)(PetscAbsReal(curve->smooth->share[c] - 1) < ONE_TURN && curve->smooth->shape->ridge[c] == 0);
}

static PetscReal NormalsDistance_Private(const PetscReal a[2], const PetscReal b[2])
{
  const PetscReal d[2] = {a[0] - b[0], a[1] - b[1]};

  return VectorNorm(2, d);
}

/* The mirror image of the normal at corner `from` in the part between two corners: the same circle at
   `at`. */
static void CurveMirror_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt from, const PetscReal n[2],
                                PetscReal image[2])
{
  PetscReal d[2], along;

  SideGetWay(curve->smooth->level, curve->smooth->facets, f, at, from, d);
  along = 2 * VectorDot(2, n, d) / VectorDot(2, d, d);
  for (PetscInt k = 0; k < 2; k++) image[k] = n[k] - along * d[k];
}

/* What to do at corner `at`, from which the part on this side leads to corner `to`. */
typedef void (*CurveVisit)(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscInt side);

static void CurveVisitWays_Private(const Curve *curve, CurveVisit visit)
{
  for (PetscInt f = 0; f < curve->smooth->facets->num; f++) {
    PetscInt       along[3];
    const PetscInt parts = FacetGetNodes_Private(curve->smooth->facets->type[f], along);

    for (PetscInt p = 0; p < parts; p++) {
      visit(curve, f, along[p], along[p + 1], AHEAD);
      visit(curve, f, along[p + 1], along[p], BEHIND);
    }
  }
}

static void CurveSetLength_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscInt side)
{
  Way      *way = &curve->way[f * F + at][side];
  PetscReal d[2];

  SideGetWay(curve->smooth->level, curve->smooth->facets, f, at, to, d);
  way->length = VectorNorm(2, d);
  curve->two[f * F + at] += way->length;
}

static void CurveSetMirror_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscInt side)
{
  const PetscReal *own   = &curve->smooth->shape->normal[(f * F + at) * 2],
                  *other = &curve->smooth->shape->normal[(f * F + to) * 2];
  Way      *way          = &curve->way[f * F + at][side];
  PetscReal image[2], turn;

  CurveMirror_Private(curve, f, at, to, own, image);
  way->same = CurveIsInner_Private(curve, f * F + at) && NormalsDistance_Private(own, image) <= FLAT_SIDE ? 1 : 0;
  if (!CurveIsInner_Private(curve, f * F + to)) return;
  CurveMirror_Private(curve, f, at, to, other, way->mirrored);
  turn     = NormalsDistance_Private(other, way->mirrored);
  way->two = curve->two[f * F + to];
  if (NormalsDistance_Private(own, way->mirrored) <= PetscMax(SAME_CIRCLE * turn, FLAT_SIDE)) way->same = 1;
}

/* The part behind a plane of symmetry is the mirror image of that before it. */
static void CurveAddImages_Private(const Curve *curve, PetscInt c)
{
  const PetscInt on = curve->smooth->planes->on[curve->smooth->nodes->corner[c]];

  for (PetscInt q = 0; q < curve->smooth->planes->num; q++) {
    for (PetscInt side = 0; side < SIDES && on >> q & 1; side++) {
      Way *way = curve->way[c];

      if (way[side].length > 0) continue;
      way[side] = way[1 - side];
      SidePlanesReflect(curve->smooth->planes, 2, q, way[side].mirrored);
      break;
    }
  }
}

static void CurveSetNext_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscInt side)
{
  if (CurveIsInner_Private(curve, f * F + to)) curve->next[f * F + at][side] = curve->way[f * F + to][side].same;
}

/* The weighted mean (4.1b) of the normals of three circles. Ways of length 0 at the other end have no
   circle. */
static void NormalsMean_Private(const PetscReal own[2], const Way way[SIDES], PetscReal n[2])
{
  const PetscReal length[SIDES] = {way[AHEAD].length, way[BEHIND].length};
  PetscReal       part[SIDES], rest = 1; // weights of the mirror images

  for (PetscInt s = 0; s < SIDES; s++) {
    const Way *other = &way[1 - s];

    part[s] = way[s].two > 0 ? length[1 - s] / (way[s].two + length[1 - s]) : 0; // of both circles on this side
    part[s] *= other->two > 0 ? other->two / (way[s].two + other->two) : 1;      // of this side
    rest -= part[s];
  }
  for (PetscInt k = 0; k < 2; k++)
    n[k] = rest * own[k] + part[AHEAD] * way[AHEAD].mirrored[k] + part[BEHIND] * way[BEHIND].mirrored[k];
  FrameNormalize(2, n);
}

/* Normals of inner nodes. [out] exact - [num][F][2] */
static void CurveSetInner_Private(const Curve *curve, PetscReal exact[])
{
  for (PetscInt f = 0; f < curve->smooth->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(curve->smooth->facets->type[f]); i++) {
      const PetscInt   c   = f * F + i;
      const PetscReal *own = &curve->smooth->shape->normal[c * 2], *next = curve->next[c];
      const Way       *way = curve->way[c];
      PetscReal       *n   = &exact[c * 2];

      if (!CurveIsInner_Private(curve, c)) continue;
      if (way[AHEAD].same > 0 || way[BEHIND].same > 0) {
        for (PetscInt k = 0; k < 2; k++) n[k] = own[k];
      } else if (next[AHEAD] > 0 || next[BEHIND] > 0) {
        for (PetscInt k = 0; k < 2; k++)
          n[k] = next[AHEAD] * way[AHEAD].mirrored[k] + next[BEHIND] * way[BEHIND].mirrored[k];
        FrameNormalize(2, n);
      } else {
        NormalsMean_Private(own, way, n);
        curve->mean[c] = PETSC_TRUE;
      }
    }
  }
}

/* The end of a patch next to an inner node: the circle there, turned by what the node's normal differs from
   its circle's. This is the angle of a cubic over both parts. [in,out] exact - at corner `at` */
static void CurveSetEnd_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscReal exact[])
{
  const PetscInt   c      = f * F + to;
  const PetscReal *circle = &curve->smooth->shape->normal[c * 2], *n = &exact[c * 2];
  const PetscReal  mine = curve->two[f * F + at], rest = curve->two[c] - mine;
  PetscReal       *end = &exact[(f * F + at) * 2], image[2], turn;

  if (CurveIsInner_Private(curve, f * F + at) || !CurveIsInner_Private(curve, c) || !(rest > 0)) return;
  CurveMirror_Private(curve, f, at, to, n, image);
  turn   = curve->mean[c] ? (n[0] * circle[1] - n[1] * circle[0]) * mine / rest : 0;
  end[0] = image[0] - turn * image[1];
  end[1] = image[1] + turn * image[0];
  FrameNormalize(2, end);
}

static void CurveSetEnds_Private(const Curve *curve, PetscReal exact[])
{
  for (PetscInt f = 0; f < curve->smooth->facets->num; f++) {
    PetscInt       along[3];
    const PetscInt parts = FacetGetNodes_Private(curve->smooth->facets->type[f], along);

    CurveSetEnd_Private(curve, f, along[0], along[1], exact);
    CurveSetEnd_Private(curve, f, along[parts], along[parts - 1], exact);
  }
}

static PetscReal NormalsAngle_Private(const PetscReal from[2], const PetscReal to[2])
{
  return PetscAtan2Real(from[0] * to[1] - from[1] * to[0], VectorDot(2, from, to));
}

static void CurveSetAngles_Private(const Curve *curve, PetscInt f, PetscInt at, PetscInt to, PetscInt side)
{
  const PetscReal *own = &curve->exact[(f * F + at) * 2], *other = &curve->exact[(f * F + to) * 2];
  PetscReal        d[2];

  SideGetWay(curve->smooth->level, curve->smooth->facets, f, side == AHEAD ? at : to, side == AHEAD ? to : at, d);
  curve->angles[f * F + at][side] =
      (Angles){NormalsAngle_Private(own, other), NormalsAngle_Private(own, (PetscReal[]){d[1], -d[0]})};
}

/* What is left of (4.1d) at a node: the quadratic through the angles of three nodes, integrated over both
   parts, less the angles of these. An error e of the node's normal leaves e (a + b)^2 / (6 a b), which grows
   with the ratio of the parts a and b. So (a + b)^2 / (4 a b) divides it. [in] way, angles - [SIDES] */
static PetscReal CurveGetLeft_Private(const Way way[SIDES], const Angles angles[SIDES])
{
  const PetscReal a = way[AHEAD].length, b = way[BEHIND].length;
  const PetscReal slope = (angles[AHEAD].node * b / a - angles[BEHIND].node * a / b) / (a + b);
  const PetscReal bend  = (angles[AHEAD].node / a + angles[BEHIND].node / b) / (a + b);

  return PetscAbsReal((slope * (a * a - b * b) / 2 + bend * (a * a * a + b * b * b) / 3 - a * angles[AHEAD].part -
                       b * angles[BEHIND].part) *
                      4 * a * b / ((a + b) * (a + b) * (a + b)));
}

/* Errors of normals that are means. Collective. [out] error - [num][F] */
static PetscErrorCode CurveSetErrors_Private(const Curve *curve, PetscReal error[])
{
  PetscFunctionBeginUser;
  CurveVisitWays_Private(curve, CurveSetAngles_Private);
  PetscCall(SideSumAtNodes(curve->smooth->nodes, ANGLES, curve->smooth->shape->ridge, (PetscReal *)curve->angles));
  for (PetscInt f = 0; f < curve->smooth->facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(curve->smooth->facets->type[f]); i++) {
      const PetscInt c      = f * F + i;
      Angles        *angles = curve->angles[c];

      if (!curve->mean[c]) continue;
      for (PetscInt s = 0;
           s < SIDES && curve->smooth->planes->num && curve->smooth->planes->on[curve->smooth->nodes->corner[c]]; s++) {
        if (angles[s].part == 0) angles[s] = (Angles){-angles[1 - s].node, -angles[1 - s].part};
      }
      error[c] = CurveGetLeft_Private(curve->way[c], angles);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideCurvesGetNormals(const SmoothSide *side, PetscReal exact[], PetscReal error[])
{
  const SideSums   *nodes  = side->nodes;
  const SidePlanes *planes = side->planes;
  const PetscReal  *ridge  = side->shape->ridge;
  const PetscInt    num    = side->facets->num * F;
  Curve             curve  = {.smooth = side, .exact = exact};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc5(num, &curve.two, num, &curve.way, num, &curve.next, num, &curve.mean, num, &curve.angles));
  CurveVisitWays_Private(&curve, CurveSetLength_Private);
  PetscCall(SideSumAtNodes(nodes, 1, ridge, curve.two));
  for (PetscInt c = 0; c < num && planes->num; c++) curve.two[c] *= planes->on[nodes->corner[c]] ? 2 : 1;
  CurveVisitWays_Private(&curve, CurveSetMirror_Private);
  PetscCall(SideSumAtNodes(nodes, WAYS, ridge, (PetscReal *)curve.way));
  for (PetscInt c = 0; c < num; c++) CurveAddImages_Private(&curve, c);
  CurveVisitWays_Private(&curve, CurveSetNext_Private);
  PetscCall(SideSumAtNodes(nodes, SIDES, ridge, (PetscReal *)curve.next));
  for (PetscInt c = 0; c < num && planes->num; c++) {
    PetscReal *next = curve.next[c];

    if (planes->on[nodes->corner[c]]) next[AHEAD] = next[BEHIND] = PetscMax(next[AHEAD], next[BEHIND]);
  }
  CurveSetInner_Private(&curve, exact);
  CurveSetEnds_Private(&curve, exact);
  PetscCall(CurveSetErrors_Private(&curve, error));
  PetscCall(PetscFree5(curve.two, curve.way, curve.next, curve.mean, curve.angles));
  PetscFunctionReturn(PETSC_SUCCESS);
}
