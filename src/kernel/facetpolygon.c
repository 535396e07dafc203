/* facetpolygon.c -- facets in space as polygons in the plane of one of them.

   Triangles and quads are polygons. Quads that are not convex are taken in parts. So are facets of second
   order, unless their middle nodes are those of straight edges. */
#include "kernel/frame.h"
#include "kernel/facetpolygon.h"
#include "kernel/polygon.h"

/* A node that is off by less than this share is where a straight facet has it. */
static const PetscReal STRAIGHT_POLYGON = 1e-12;
/* Least area of the triangles at the corners of a quad, as a share of the mean one. Below it an angle is
   nearly straight, and Newton's method may fail. */
static const PetscReal CONVEX_SHARE = 1e-2;

void FacetPolygonProjectPoints(const FacetPlane *plane, PetscInt n, const PetscReal X[], PetscReal P[])
{
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt t = 0; t < 2; t++) {
      const PetscReal *tangent = &plane->Q[3 * (1 + t)];

      P[2 * i + t] = 0.;
      for (PetscInt k = 0; k < 3; k++) P[2 * i + t] += tangent[k] * (X[3 * i + k] - plane->origin[k]);
    }
  }
}

void FacetPolygonSetPlane(const ClipFacet *nonmortar, FacetPlane *plane)
{
  const PetscInt n         = ElementNumNodes(nonmortar->type);
  PetscReal      normal[3] = {0.}, P[2 * ELEMENT_MAX_FACET_NODES];

  for (PetscInt k = 0; k < 3; k++) {
    plane->origin[k] = 0.;
    for (PetscInt i = 0; i < n; i++) {
      plane->origin[k] += nonmortar->X[3 * i + k] / n;
      normal[k] += nonmortar->N[3 * i + k];
    }
  }
  FrameNormalize(3, normal);
  FrameFromNormal(3, normal, plane->Q);
  FacetPolygonProjectPoints(plane, n, nonmortar->X, P);
  plane->size = 0.;
  for (PetscInt i = 0; i < 2 * n; i++) plane->size = PetscMax(plane->size, 2. * PetscAbsReal(P[i]));
}

/* Whether the corners 0 and 2 have the same middle as 1 and 3. [in] P - [4][2] */
static PetscBool FacetPolygonIsParallelogram_Private(const PetscReal P[], PetscReal size)
{
  for (PetscInt k = 0; k < 2; k++) {
    if (PetscAbsReal(P[k] - P[2 + k] + P[4 + k] - P[6 + k]) > POLYGON_SAME_POINT * size) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The linear or bilinear map to a polygon. [in] P - [num][2]; [out] map - of (1, s, t, s t) [4][2] */
static void FacetPolygonSetMap_Private(PetscInt num, const PetscReal P[], PetscReal map[])
{
  for (PetscInt k = 0; k < 2; k++) {
    const PetscReal last = P[2 * (num - 1) + k];

    map[k]     = P[k];
    map[2 + k] = P[2 + k] - P[k];
    map[4 + k] = last - P[k];
    map[6 + k] = num == 4 ? P[k] - P[2 + k] + P[4 + k] - last : 0.;
  }
}

/* Appends the part with the given nodes of the facet, turned anticlockwise; none where it has no area. */
static void FacetPolygonAddPart_Private(PetscInt num, const PetscInt nodes[], PetscReal size, FacetPolygon *shadow)
{
  FacetPart *part = &shadow->parts[shadow->num_parts];
  PetscReal  P[2 * POLYGON_MAX_CORNERS], area;

  for (PetscInt i = 0; i < 2 * num; i++) P[i] = shadow->plane[2 * nodes[i / 2] + i % 2];
  area = PolygonArea(num, P);
  if (PetscAbsReal(area) <= POLYGON_NO_AREA * size * size) return;
  part->type   = num == 3 ? ELEMENT_TRI3 : ELEMENT_QUAD4;
  part->affine = num == 3 ? PETSC_TRUE : FacetPolygonIsParallelogram_Private(P, size);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt node = nodes[area > 0. ? i : num - 1 - i];

    for (PetscInt k = 0; k < 2; k++) {
      part->reference[2 * i + k] = ElementNode(shadow->facet->type, node)[k];
      part->plane[2 * i + k]     = shadow->plane[2 * node + k];
    }
  }
  FacetPolygonSetMap_Private(num, part->reference, part->to_reference);
  FacetPolygonSetMap_Private(num, part->plane, part->to_plane);
  shadow->area += PetscAbsReal(area);
  shadow->num_parts++;
}

/* Appends a quad, or two triangles that meet at its flattest corner, where it is not convex.
   [in] nodes - [4] */
static void FacetPolygonAddQuad_Private(const PetscInt nodes[], PetscReal size, FacetPolygon *shadow)
{
  PetscReal corner[4], sum = 0., sense;
  PetscInt  flattest = 0;

  for (PetscInt i = 0; i < 4; i++) {
    PetscReal P[6];

    for (PetscInt j = 0; j < 3; j++) {
      for (PetscInt k = 0; k < 2; k++) P[2 * j + k] = shadow->plane[2 * nodes[(i + 3 + j) % 4] + k];
    }
    corner[i] = PolygonArea(3, P);
    sum += corner[i];
  }
  sense = sum > 0. ? 1. : -1.;
  for (PetscInt i = 1; i < 4; i++) {
    if (sense * corner[i] < sense * corner[flattest]) flattest = i;
  }
  if (sense * corner[flattest] > CONVEX_SHARE * 0.25 * PetscAbsReal(sum)) {
    FacetPolygonAddPart_Private(4, nodes, size, shadow);
  } else {
    for (PetscInt half = 0; half < 2; half++) {
      const PetscInt triangle[3] = {nodes[flattest], nodes[(flattest + 1 + half) % 4],
                                    nodes[(flattest + 2 + half) % 4]};

      FacetPolygonAddPart_Private(3, triangle, size, shadow);
    }
  }
}

/* Whether the middle nodes are, in the plane, those of the facet of first order with the same vertices. Then
   both have the same map from the reference cell into the plane, however the facet bulges out of it. */
static PetscBool FacetPolygonIsStraight_Private(const FacetPolygon *shadow, PetscReal size)
{
  const ElementType type = shadow->facet->type, linear = ElementLinear(type);

  for (PetscInt i = ElementNumNodes(linear); i < ElementNumNodes(type); i++) {
    PetscReal phi[ELEMENT_MAX_NODES];

    ElementShape(linear, ElementNode(type, i), phi, NULL);
    for (PetscInt k = 0; k < 2; k++) {
      PetscReal off = -shadow->plane[2 * i + k];

      for (PetscInt v = 0; v < ElementNumNodes(linear); v++) off += phi[v] * shadow->plane[2 * v + k];
      if (PetscAbsReal(off) > STRAIGHT_POLYGON * size) return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

/* The parts of a facet whose nodes are in the plane. */
void FacetPolygonSplit(const FacetPlane *plane, FacetPolygon *shadow)
{
  static const PetscInt tri6[4][3]  = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  static const PetscInt quad9[4][4] = {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  static const PetscInt whole[4]    = {0, 1, 2, 3};
  const PetscReal       size        = plane->size;
  const ElementType     type        = shadow->facet->type;

  shadow->num_parts = 0;
  shadow->area      = 0.;
  switch (FacetPolygonIsStraight_Private(shadow, size) ? ElementLinear(type) : type) {
  case ELEMENT_TRI3: FacetPolygonAddPart_Private(3, whole, size, shadow); break;
  case ELEMENT_QUAD4: FacetPolygonAddQuad_Private(whole, size, shadow); break;
  case ELEMENT_TRI6:
    for (PetscInt i = 0; i < 4; i++) FacetPolygonAddPart_Private(3, tri6[i], size, shadow);
    break;
  default:
    for (PetscInt i = 0; i < 4; i++) FacetPolygonAddQuad_Private(quad9[i], size, shadow);
  }
}

void FacetPolygonProject(const FacetPlane *plane, const ClipFacet *facet, FacetPolygon *shadow)
{
  shadow->facet = facet;
  FacetPolygonProjectPoints(plane, ElementNumNodes(facet->type), facet->X, shadow->plane);
}

/* Whether the boxes of the polygons of two shadows meet. */
PetscBool FacetPolygonsMeet(const FacetPolygon *a, const FacetPolygon *b)
{
  const FacetPolygon *shadow[2] = {a, b};
  PetscReal           box[2][4];

  for (PetscInt s = 0; s < 2; s++) {
    for (PetscInt k = 0; k < 2; k++) {
      box[s][k] = box[s][2 + k] = shadow[s]->plane[k];
      for (PetscInt i = 1; i < ElementNumNodes(shadow[s]->facet->type); i++) {
        box[s][k]     = PetscMin(box[s][k], shadow[s]->plane[2 * i + k]);
        box[s][2 + k] = PetscMax(box[s][2 + k], shadow[s]->plane[2 * i + k]);
      }
    }
  }
  return box[0][0] <= box[1][2] && box[0][1] <= box[1][3] && box[1][0] <= box[0][2] && box[1][1] <= box[0][3]
             ? PETSC_TRUE
             : PETSC_FALSE;
}
