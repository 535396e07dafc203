/* smoothgap.c -- gaps between smooth sides.

   Facets of first order deviate from a curved side by an eighth of the square of their length over the
   radius. On most meshes that is as much as an interference fit, or the approach of two bodies. Nodes are on
   the curved side, and their normals determine its curve between them. In integrals, points stay on the
   facets. Only the gap is that of the curves, to first order: their distance from the facets along the ray is
   added. A formula of the gap is evaluated on the curve instead: it need not fall along the normal. */
#include "kernel/rise.h"
#include "kernel/vector.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/smoothgap.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Normals that differ by less are parallel. */
static const PetscReal TURN_ROUNDING = 1e-11;

/* Largest deviation of a straight facet from its curve. It is that of an arc, since half of an edge may be
   straight. */
static PetscReal SmoothGapPolygonError_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal N[])
{
  PetscReal most = 0;

  for (PetscInt e = 0; e < ElementNumEdges(type); e++) {
    const PetscInt *ends = ElementEdgeNodes(type, e);
    PetscReal       turn = 0, length = 0;

    for (PetscInt k = 0; k < dim; k++) {
      const PetscReal d = X[ends[1] * dim + k] - X[ends[0] * dim + k];

      turn += d * (N[ends[1] * dim + k] - N[ends[0] * dim + k]);
      length += d * d;
    }
    if (PetscAbsReal(turn) > TURN_ROUNDING * PetscSqrtReal(length)) most = PetscMax(most, PetscAbsReal(turn) / 8);
  }
  return most;
}

/* Largest deviation of a facet from its curve: a parabola deviates by s gamma^2 / 16 from an arc of angle 2
   gamma and rise s, a curve of degree 4 by s gamma^4 / 54. [in] rise - of the facet */
static PetscReal SmoothGapCurveError_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal N[],
                                             const PetscReal rise[])
{
  const PetscInt num  = ElementNumNodes(ElementLinear(type));
  PetscReal      most = 0;

  for (PetscInt e = 0; e < ElementNumEdges(ElementLinear(type)); e++) {
    const PetscInt  *ends    = ElementEdgeNodes(ElementLinear(type), e);
    const PetscReal *more    = &rise[(RISE_CUBIC + 2 * e) * dim];
    PetscReal        squares = 0, turn = 0;

    for (PetscInt k = 0; k < dim; k++) {
      const PetscReal s = rise[(num + e) * dim + k], mean = 0.5 * (X[ends[0] * dim + k] + X[ends[1] * dim + k]);

      squares += ElementOrder(type) > 1 ? PetscSqr(X[(num + e) * dim + k] - mean) : s * s;
      turn += PetscSqr(N[ends[1] * dim + k] - N[ends[0] * dim + k]); // (2 sin gamma)^2
    }
    turn *= VectorNorm(2 * dim, more) > 0 ? turn / 864 : 1. / 64;
    most = PetscMax(most, PetscSqrtReal(squares) * turn);
  }
  return most;
}

/* The rise of a facet of first order. Its vertices that hang are below the curve: the rise is that of the
   facet between places on the curve, and the rise of these. [in,out] X - of the vertices, then on the
   curve */
static void SmoothGapRiseFacet_Private(const Level *level, const Facets *facets, PetscInt f, const SideShape *shape,
                                       PetscReal X[], PetscReal rise[])
{
  const ElementType type = facets->type[f], high = ElementOfOrder(type, 2);
  const PetscInt    dim = level->dim, num                = ElementNumNodes(type);
  PetscReal         phi[ELEMENT_MAX_NODES], hangs[3 * F] = {0};

  for (PetscInt i = 0; i < num * dim && level->hanging.rise; i++) {
    hangs[i] = level->hanging.rise[facets->nodes[f * F + i / dim] * dim + i % dim];
    X[i] += hangs[i];
  }
  SideShapeGetRise(shape, f, type, X, rise);
  for (PetscInt k = 0; k < ElementNumNodes(high) && level->hanging.rise; k++) {
    ElementShape(type, ElementNode(high, k), phi, NULL);
    for (PetscInt i = 0; i < num * dim; i++) rise[k * dim + i % dim] += phi[i / dim] * hangs[i];
  }
}

/* The formula of the gap; NULL where it is measured. */
static Expression SmoothGapFormula_Private(const ScenePair *spec)
{
  return spec->gap ? spec->gap : spec->obstacle.gap;
}

/* How far a gap by a formula is from linear, on the facet or on its curve: the sum over the nodes of second
   order. [in] X - of the vertices, on the facet; [in] bulge - or NULL */
static PetscErrorCode SmoothGapFormulaBend_Private(Expression gap, ElementType type, const PetscReal X[],
                                                   const PetscReal bulge[], PetscReal *bend, PetscBool *known)
{
  const ElementType high = ElementOfOrder(type, 2);
  const PetscInt    dim = ElementDim(type) + 1, num = ElementNumNodes(type);
  PetscReal         value[F], x[3], phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  *bend  = 0;
  *known = PETSC_TRUE;
  for (PetscInt k = 0; k < ElementNumNodes(high) && *known; k++) {
    PetscReal mean = 0;

    ElementSurface(type, X, ElementNode(high, k), x, phi, NULL);
    for (PetscInt d = 0; d < dim && bulge; d++) x[d] += bulge[k * dim + d];
    PetscCall(ExpressionTry(gap, dim, x, &value[k], known));
    for (PetscInt i = 0; i < num && k >= num; i++) mean += phi[i] * value[i];
    if (k >= num) *bend += PetscAbsReal(value[k] - mean);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the gap by a formula is nearer to linear on the curve than on the facet. Displacements are linear
   there: so its mean is nearer to the gaps at nodes. It is the curve for an obstacle that follows it, the
   facet for one that is flat or convex. [in] X - of the vertices, on the curve */
static PetscErrorCode SmoothGapFormulaFollows_Private(Expression gap, ElementType type, const PetscReal X[],
                                                      const PetscReal bulge[], PetscBool *follows)
{
  const PetscInt num = ElementNumNodes(type) * (ElementDim(type) + 1);
  PetscReal      below[3 * F], facet, curve;
  PetscBool      known[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) below[i] = X[i] - bulge[i]; // of vertices that hang
  PetscCall(SmoothGapFormulaBend_Private(gap, type, below, NULL, &facet, &known[0]));
  PetscCall(SmoothGapFormulaBend_Private(gap, type, below, bulge, &curve, &known[1]));
  *follows = (PetscBool)(known[0] && known[1] && curve < facet);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmoothGapCreate(Level *level, const ScenePair *spec, const Facets *facets, const SideShape *shape,
                               PetscBool polygonal, PetscReal **rises, PetscReal *left)
{
  const PetscInt   dim     = level->dim;
  const Expression formula = SmoothGapFormula_Private(spec);
  PetscReal        X[3 * F], largest[2] = {0, 0};

  PetscFunctionBeginUser;
  *rises = NULL;
  *left  = 0;
  if (formula && polygonal) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(facets->num * RISE_TERMS * dim + 1,
                         rises)); // not NULL on ranks without facets, too: NULL means that no rank has a curve
  for (PetscInt f = 0; f < facets->num; f++) {
    const ElementType type                 = facets->type[f];
    const PetscReal  *N                    = &shape->normal[f * F * dim];
    PetscReal         rise[RISE_TERMS * 3] = {0};
    PetscBool         any;

    ContactFacetCoordinates(level, facets, f, X);
    if (polygonal && ElementOrder(type) == 1)
      largest[0] = PetscMax(largest[0], SmoothGapPolygonError_Private(dim, type, X, N));
    if (polygonal && ElementOrder(type) == 1) continue;
    if (ElementOrder(type) == 1)
      SmoothGapRiseFacet_Private(level, facets, f, shape, X, rise);
    else if (!polygonal && !formula)
      SideShapeGetRise(shape, f, type, X, rise);
    any = RiseIsAny(type, rise);
    if (formula && any) PetscCall(SmoothGapFormulaFollows_Private(formula, type, X, rise, &any));
    if (formula && !any) continue;
    largest[0] = PetscMax(largest[0], SmoothGapCurveError_Private(dim, type, X, N, rise));
    if (!any) continue;
    largest[1] = 1;
    PetscCall(PetscArraycpy(&(*rises)[f * RISE_TERMS * dim], rise, RISE_TERMS * dim));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPIU_REAL, MPIU_MAX, level->comm));
  *left = largest[0];
  if (largest[1] == 0) PetscCall(PetscFree(*rises));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The direction of the ray through a point: that of the normals there; in space, before a mesh, that of the
   facet's plane. [out] n - [dim] */
static void SmoothGapAlongRay_Private(const FacetPartner *partner, const ClipFacet *facet, const PetscReal xi[],
                                      PetscReal n[])
{
  const PetscInt  dim = partner->dim;
  const PetscBool one = dim == 3 && partner->mortar ? PETSC_TRUE : PETSC_FALSE;
  PetscReal       phi[ELEMENT_MAX_NODES];

  ElementShape(facet->type, xi, phi, NULL);
  for (PetscInt k = 0; k < dim; k++) n[k] = 0;
  for (PetscInt i = 0; i < ElementNumNodes(facet->type); i++) {
    for (PetscInt k = 0; k < dim; k++) n[k] += (one ? 1 : phi[i]) * facet->N[i * dim + k];
  }
  FrameNormalize(dim, n);
}

/* The gap on the facet by a formula, and that on the curve less this. */
static PetscErrorCode SmoothGapOfFormula_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                 const PetscReal own[], ClipPoint *point, PetscReal *off)
{
  const Expression formula = SmoothGapFormula_Private(partner->spec);
  PetscReal        x[3], rise[3] = {0, 0, 0}, phi[ELEMENT_MAX_NODES], gap;
  PetscBool        rises = PETSC_FALSE;

  PetscFunctionBeginUser;
  *off = 0;
  if (own) RiseAt(facet->type, own, point->xi, rise);
  ElementSurface(facet->type, facet->X, point->xi, x, phi, NULL);
  PetscCall(ExpressionEvaluate(formula, partner->dim, x, &point->gap));
  for (PetscInt k = 0; k < partner->dim; k++) {
    rises = (PetscBool)(rises || rise[k] != 0);
    x[k] += rise[k];
  }
  if (!rises) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionEvaluate(formula, partner->dim, x, &gap));
  *off = gap - point->gap;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmoothGapApply(const FacetPartner *partner, const ClipFacet *facet, const PetscReal rise[],
                              OverlapPoints *list, PetscReal *most)
{
  const MortarSurface *mortar  = partner->mortar;
  const PetscReal     *rise_m  = mortar ? mortar->rises : NULL;
  const Expression     formula = SmoothGapFormula_Private(partner->spec);

  PetscFunctionBeginUser;
  *most = 0;
  if (!formula && !rise && !rise_m) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = 0; p < list->num; p++) {
    ClipPoint     *point = &list->point[p];
    const PetscInt f     = list->facet[p];
    PetscReal      n[3], off = 0;

    SmoothGapAlongRay_Private(partner, facet, point->xi, n);
    if (formula)
      PetscCall(SmoothGapOfFormula_Private(partner, facet, rise, point, &off));
    else if (rise)
      off -= RiseAlong(facet->type, rise, point->xi, n);
    if (!formula && rise_m) off += RiseAlong(mortar->type[f], &rise_m[f * RISE_TERMS * partner->dim], point->eta, n);
    point->gap += off;
    *most = PetscMax(*most, PetscAbsReal(off));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
