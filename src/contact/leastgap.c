/* leastgap.c -- the least gap of a facet at an edge of its pair.

   At an edge of the mortar side the gap has a bend or a step within a facet of the nonmortar side. At an edge
   of the nonmortar side in the plane, rays turn, and the gap bends as well. The least gap is at a corner of
   the pieces that mortar facets cover. On one piece the gap is smooth: it is continued from the points of
   quadrature. */
#include "contact/leastgap.h"
#include "base/compat.h"
#include "contact/overlappoints.h"
#include "kernel/disjointsets.h"
#include "kernel/frame.h"
#include "kernel/rise.h"
#include "kernel/vector.h"

/* Mortar facets have an edge between them if their normals differ there by 2 degrees; cosine. */
static const PetscReal SAME_PIECE = 0.99939082701909576;
/* A direction of contact that is 15.5 degrees from its facet is that of a node at an edge: facets of smooth
   sides meet at less than 31; cosine. */
static const PetscReal OWN_DIRECTION = 0.963630453208623;

/* Gaps that bend or jump within a facet differ at its points from the linear function fitted to them. At the
   vertices that function is off by at most so many times as much: 13 times for a sphere on square facets. */
static const PetscReal APART_COUNTS = 64;

/* The unit normal of a mortar facet at one of its nodes: that of its curve. [out] n - [dim] */
static void LeastGapGetNormal_Private(const MortarSurface *mortar, PetscInt dim, PetscInt f, PetscInt i, PetscReal n[])
{
  const PetscInt  first = f * ELEMENT_MAX_FACET_NODES * dim;
  const PetscBool rises =
      (PetscBool)(mortar->rises && RiseIsAny(mortar->type[f], &mortar->rises[f * RISE_TERMS * dim]));
  PetscReal x[3], phi[ELEMENT_MAX_NODES];

  if (!rises) ElementSurface(mortar->type[f], &mortar->coords[first], ElementNode(mortar->type[f], i), x, phi, n);
  for (PetscInt k = 0; k < dim && rises; k++) n[k] = mortar->normals[first + i * dim + k];
  FrameNormalize(dim, n);
}

/* Whether two mortar facets are neighbours on one smooth piece: they share a node, and have one normal
   there. */
static PetscBool LeastGapJoins_Private(const MortarSurface *mortar, PetscInt dim, PetscInt a, PetscInt b)
{
  PetscReal n[2][3];

  for (PetscInt i = 0; i < ElementNumNodes(mortar->type[a]); i++) {
    for (PetscInt j = 0; j < ElementNumNodes(mortar->type[b]); j++) {
      if (mortar->nodes[a * ELEMENT_MAX_FACET_NODES + i] != mortar->nodes[b * ELEMENT_MAX_FACET_NODES + j]) continue;
      LeastGapGetNormal_Private(mortar, dim, a, i, n[0]);
      LeastGapGetNormal_Private(mortar, dim, b, j, n[1]);
      return (PetscBool)(VectorDot(dim, n[0], n[1]) >= SAME_PIECE);
    }
  }
  return PETSC_FALSE;
}

/* Unites neighbours on one smooth piece. Thousands of mortar facets may be over a coarse one: only those that
   share a node are compared.
   [in] facets - mortar facets [num]; [in,out] parent - their sets [num] */
static PetscErrorCode LeastGapUnite_Private(const FacetPartner *partner, PetscInt num, const PetscInt facets[],
                                            PetscInt parent[])
{
  const MortarSurface *mortar = partner->mortar;
  PetscInt            *node, *owner, corners = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num * ELEMENT_MAX_FACET_NODES, &node, num * ELEMENT_MAX_FACET_NODES, &owner));
  for (PetscInt a = 0; a < num; a++) {
    for (PetscInt i = 0; i < ElementNumNodes(mortar->type[facets[a]]); i++) {
      node[corners]    = mortar->nodes[facets[a] * ELEMENT_MAX_FACET_NODES + i];
      owner[corners++] = a;
    }
  }
  PetscCall(PetscSortIntWithArray(corners, node, owner));
  for (PetscInt c = 0; c < corners; c++) {
    for (PetscInt d = c + 1; d < corners && node[d] == node[c]; d++) {
      const PetscInt a = owner[c], b = owner[d];

      if (DisjointSetsFind(parent, a) == DisjointSetsFind(parent, b)) continue;
      if (LeastGapJoins_Private(mortar, partner->dim, facets[a], facets[b])) DisjointSetsUnite(parent, a, b);
    }
  }
  PetscCall(PetscFree2(node, owner));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the mortar facets over a facet are several smooth pieces. */
static PetscErrorCode LeastGapHasMortarEdge_Private(const FacetPartner *partner, const OverlapPoints *list,
                                                    PetscBool *edge)
{
  PetscInt *facets, *parent, num = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(list->num, &facets, list->num, &parent));
  for (PetscInt p = 0; p < list->num; p++)
    if (p == 0 || list->facet[p] != list->facet[p - 1]) facets[num++] = list->facet[p];
  DisjointSetsInitialize(num, parent);
  if (num > 1) PetscCall(LeastGapUnite_Private(partner, num, facets, parent));
  *edge = PETSC_FALSE;
  for (PetscInt a = 0; a < num; a++) *edge = (PetscBool)(*edge || DisjointSetsFind(parent, a) != 0);
  PetscCall(PetscFree2(facets, parent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether rays turn on a facet, in the plane, because it ends at an edge. */
static PetscBool LeastGapHasOwnEdge_Private(PetscInt dim, const ClipFacet *facet)
{
  PetscReal x[3], phi[ELEMENT_MAX_NODES], n[3];

  for (PetscInt i = 0; i < ElementNumNodes(facet->type) && dim == 2; i++) {
    ElementSurface(facet->type, facet->X, ElementNode(facet->type, i), x, phi, n);
    FrameNormalize(dim, n);
    if (VectorDot(dim, n, &facet->N[i * dim]) < OWN_DIRECTION) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* The cosine between the ray through a point of a line and the normal of a mortar line. */
static PetscReal LeastGapCosine_Private(const ClipFacet *facet, const ClipFacet *mortar, const PetscReal xi[])
{
  const PetscReal middle = 0.5;
  PetscReal       phi[ELEMENT_MAX_NODES], x[2], m[2], n[2] = {0, 0};

  ElementShape(facet->type, xi, phi, NULL);
  for (PetscInt i = 0; i < 2 * ElementNumNodes(facet->type); i++) n[i % 2] += phi[i / 2] * facet->N[i];
  ElementSurface(mortar->type, mortar->X, &middle, x, phi, m);
  return VectorDot(2, n, m) / PetscSqrtReal(VectorDot(2, n, n) * VectorDot(2, m, m));
}

/* The gap of a line at xi: times the cosine it is linear on straight lines, else the polynomial through all
   points. */
static PetscReal LeastGapContinueLine_Private(const ClipFacet *facet, const ClipFacet *mortar, PetscInt num,
                                              const ClipPoint points[], const PetscReal xi[])
{
  PetscReal distance = 0;

  for (PetscInt p = 0; p < num; p++) {
    PetscReal term = points[p].gap * LeastGapCosine_Private(facet, mortar, points[p].xi);

    for (PetscInt q = 0; q < num; q++)
      if (q != p) term *= (xi[0] - points[q].xi[0]) / (points[p].xi[0] - points[q].xi[0]);
    distance += term;
  }
  return distance / LeastGapCosine_Private(facet, mortar, xi);
}

/* A linear function of xi. */
typedef struct {
  PetscReal mean, at[2], slope[2];
} LinearGap;

/* The linear function fitted to points. False where they are too few to tell. [in] directions - of xi: 1 of a
   line, 2 of a facet in space */
static PetscBool LeastGapFit_Private(PetscInt directions, PetscInt num, const ClipPoint points[], LinearGap *fit)
{
  PetscReal weight = 0, A[3] = {0, 0, 0}, b[2] = {0, 0}, det; // A: xx, yy, xy

  *fit = (LinearGap){0};
  for (PetscInt p = 0; p < num; p++) {
    weight += points[p].weight;
    fit->mean += points[p].weight * points[p].gap;
    for (PetscInt k = 0; k < directions; k++) fit->at[k] += points[p].weight * points[p].xi[k];
  }
  fit->mean /= weight;
  for (PetscInt k = 0; k < directions; k++) fit->at[k] /= weight;
  for (PetscInt p = 0; p < num; p++) {
    const PetscReal w = points[p].weight, d[2] = {points[p].xi[0] - fit->at[0], points[p].xi[1] - fit->at[1]};

    A[0] += w * d[0] * d[0];
    A[1] += directions == 2 ? w * d[1] * d[1] : 0;
    A[2] += directions == 2 ? w * d[0] * d[1] : 0;
    for (PetscInt k = 0; k < directions; k++) b[k] += w * d[k] * points[p].gap;
  }
  if (directions == 1) A[1] = 1;
  det = A[0] * A[1] - A[2] * A[2];
  if (!(det > 0)) return PETSC_FALSE;
  fit->slope[0] = (A[1] * b[0] - A[2] * b[1]) / det;
  fit->slope[1] = (A[0] * b[1] - A[2] * b[0]) / det;
  return PETSC_TRUE;
}

/* [in] xi - two coordinates, of a line one */
static PetscReal LeastGapEvaluate_Private(PetscInt directions, const LinearGap *fit, const PetscReal xi[])
{
  PetscReal gap = fit->mean;

  for (PetscInt k = 0; k < directions; k++) gap += fit->slope[k] * (xi[k] - fit->at[k]);
  return gap;
}

/* The gap in space at xi: the linear function fitted to the points. */
static PetscReal LeastGapContinuePlane_Private(PetscInt num, const ClipPoint points[], const PetscReal xi[])
{
  LinearGap fit;

  return LeastGapFit_Private(2, num, points, &fit) ? LeastGapEvaluate_Private(2, &fit, xi) : PETSC_MIN_REAL;
}

PetscReal LeastGapAtVertices(const ClipFacet *facet, const OverlapPoints *list)
{
  const PetscInt directions = ElementDim(facet->type);
  PetscReal      apart = 0, least = PETSC_MAX_REAL;
  LinearGap      fit;

  if (!list->num || !LeastGapFit_Private(directions, list->num, list->point, &fit)) return PETSC_MAX_REAL;
  for (PetscInt p = 0; p < list->num; p++)
    apart = PetscMax(apart,
                     PetscAbsReal(list->point[p].gap - LeastGapEvaluate_Private(directions, &fit, list->point[p].xi)));
  for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(facet->type)); i++)
    least = PetscMin(least, LeastGapEvaluate_Private(directions, &fit, ElementNode(facet->type, i)));
  return least + APART_COUNTS * apart;
}

PetscErrorCode LeastGapAtEdge(const FacetPartner *partner, const ClipFacet *facet, const OverlapPoints *list,
                              PetscReal *least)
{
  PetscBool  edge = LeastGapHasOwnEdge_Private(partner->dim, facet);
  PetscReal *xi;

  PetscFunctionBeginUser;
  *least = PETSC_MIN_REAL;
  if (!partner->mortar || partner->spec->gap) PetscFunctionReturn(PETSC_SUCCESS); // an edge does not bend a given gap
  if (!edge) PetscCall(LeastGapHasMortarEdge_Private(partner, list, &edge));
  if (!edge) PetscFunctionReturn(PETSC_SUCCESS);
  *least = PETSC_MAX_REAL;
  PetscCall(PetscMalloc1(2 * CLIP_MAX_CORNERS, &xi));
  for (PetscInt p = 0, end; p < list->num; p = end) {
    const ClipFacet mortar  = OverlapPointsMortarFacet(partner, list->facet[p]);
    const PetscInt  corners = ClipCorners(facet, &mortar, xi);

    for (end = p + 1; end < list->num && list->facet[end] == list->facet[p];) end++;
    for (PetscInt i = 0; i < corners; i++) {
      const PetscReal gap = partner->dim == 2
                                ? LeastGapContinueLine_Private(facet, &mortar, end - p, &list->point[p], &xi[2 * i])
                                : LeastGapContinuePlane_Private(end - p, &list->point[p], &xi[2 * i]);

      *least = PetscMin(*least, gap);
    }
  }
  PetscCall(PetscFree(xi));
  PetscFunctionReturn(PETSC_SUCCESS);
}
