/* sideends.c -- normals where smooth patches of a side end: those of neighbours, extrapolated. */
#include "side/sideends.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "side/sidepatch.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Share of a full turn that the patch fills: more at an end of a line, less at a corner. A neighbour counts
   there if its patch fills more by FULLER. */
static const PetscReal END_TURN = 0.35, FULLER = 0.1;
/* Angles between 78 and 102 degrees, by their cosine, are those of rectangles that were cut. */
static const PetscReal RIGHT_ANGLE = 0.2;

typedef struct {
  Level           *level;
  const Facets    *facets;
  const SideSums  *nodes;
  const PetscReal *share;
  SideShape       *shape;
} Ends;

/* The normal at corner i extrapolated from its neighbour j: rotated by the curvature, or else reflected in
   the plane between them. Both are exact on circles and spheres, the first also on cylinders. Returns whether
   it differs from that at j. */
static PetscBool EndsTurnNormal_Private(const Ends *ends, PetscInt f, PetscInt i, PetscInt j, PetscBool known,
                                        PetscReal n[])
{
  const PetscInt   dim = ends->level->dim;
  const PetscReal *m = &ends->shape->normal[(f * F + j) * dim], *S = &ends->shape->curvature[(f * F + j) * dim * dim];
  PetscReal        dx[3] = {0}, t[3] = {0}, square, along;

  for (PetscInt k = 0; k < dim; k++)
    dx[k] = SideGetPosition(ends->level, ends->facets, f, i, k) - SideGetPosition(ends->level, ends->facets, f, j, k);
  for (PetscInt k = 0; k < dim * dim; k++) t[k / dim] += S[k] * dx[k % dim];
  square = VectorDot(dim, t, t);
  along  = VectorDot(dim, m, dx) / VectorDot(dim, dx, dx);
  for (PetscInt k = 0; k < dim; k++)
    n[k] = known && square < 1 ? t[k] + PetscSqrtReal(1 - square) * m[k] : m[k] - 2 * along * dx[k];
  return (PetscBool)(PetscMax(square, PetscSqr(along) * VectorDot(dim, dx, dx)) > FLAT_SIDE * FLAT_SIDE);
}

/* Whether two nodes of a facet lie on a line of its lattice: a mirror between others is not that of a
   cylinder. */
static PetscBool EndsOnOneLine_Private(ElementType type, PetscInt i, PetscInt j)
{
  const PetscReal *a = ElementNode(type, i), *b = ElementNode(type, j);

  if (ElementDim(type) == 1 || a[0] == b[0] || a[1] == b[1]) return PETSC_TRUE;
  return (PetscBool)(ElementNumNodes(ElementLinear(type)) == 3 && a[0] + a[1] == b[0] + b[1]);
}

/* Whether two nodes of a triangle lie along the diagonal of a rectangle that was cut into two: its longest
   edge, opposite to a right angle. */
static PetscBool EndsOnDiagonal_Private(const Ends *ends, PetscInt f, PetscInt i, PetscInt j)
{
  const ElementType type = ends->facets->type[f];
  const PetscReal  *a = ElementNode(type, i), *b = ElementNode(type, j);
  PetscReal         square[3] = {0, 0, 0};
  PetscInt          k, m, n;

  if (ElementNumNodes(ElementLinear(type)) != 3) return PETSC_FALSE;
  k = a[1] == b[1] ? 2 : a[0] == b[0] ? 1 : 0; // the vertex opposite to the edge along this line
  m = (k + 1) % 3;
  n = (k + 2) % 3;
  for (PetscInt d = 0; d < 3; d++) {
    const PetscReal x =
        SideGetPosition(ends->level, ends->facets, f, m, d) - SideGetPosition(ends->level, ends->facets, f, k, d);
    const PetscReal y =
        SideGetPosition(ends->level, ends->facets, f, n, d) - SideGetPosition(ends->level, ends->facets, f, k, d);

    square[k] += PetscSqr(x - y);
    square[m] += PetscSqr(y);
    square[n] += PetscSqr(x);
  }
  if (square[k] < PetscMax(square[m], square[n])) return PETSC_FALSE;
  return (PetscBool)(PetscAbsReal(square[m] + square[n] - square[k]) <
                     2 * RIGHT_ANGLE * PetscSqrtReal(square[m] * square[n]));
}

/* What neighbours add at the end of a patch: sums of normals that differ, along other lines than diagonals
   and along these; the number of the former, also of those that do not differ. */
enum { END_NORMAL, END_DIAGONAL = 3, END_COUNT = 6, END_SUMS };

/* Adds to a corner what a neighbour gives. [in,out] sums - [END_SUMS] */
static void EndsAddNeighbour_Private(const Ends *ends, PetscInt f, PetscInt i, PetscInt j, PetscBool known,
                                     PetscReal sums[])
{
  const PetscBool diagonal = (PetscBool)(!known && EndsOnDiagonal_Private(ends, f, i, j));
  PetscReal       n[3];

  if (!known && !EndsOnOneLine_Private(ends->facets->type[f], i, j)) return;
  if (!diagonal) sums[END_COUNT] += 1;
  if (!EndsTurnNormal_Private(ends, f, i, j, known, n)) return;
  for (PetscInt k = 0; k < ends->level->dim; k++) sums[(diagonal ? END_DIAGONAL : END_NORMAL) + k] += n[k];
}

/* Normals at the ends of patches, where facets are on one side only: extrapolated from neighbours with facets
   around them, from those across diagonals if there are no others. Collective. [in] least, most - share of
   those ends; known - of curvatures [num][F] */
static PetscErrorCode EndsSet_Private(Ends *ends, PetscReal least, PetscReal most, const PetscReal known[])
{
  const PetscInt dim = ends->level->dim;
  PetscReal     *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ends->facets->num * F * END_SUMS, &sums));
  for (PetscInt f = 0; f < ends->facets->num; f++) {
    const PetscInt num = ElementNumNodes(ends->facets->type[f]);

    for (PetscInt i = 0; i < num; i++) {
      const PetscReal share = ends->share[f * F + i];

      if (share < least || share >= most) continue;
      for (PetscInt j = 0; j < num; j++) {
        if (ends->share[f * F + j] < share + FULLER) continue;
        EndsAddNeighbour_Private(ends, f, i, j, (PetscBool)(known[f * F + j] > 0), &sums[(f * F + i) * END_SUMS]);
      }
    }
  }
  PetscCall(SideSumAtNodes(ends->nodes, END_SUMS, ends->shape->ridge, sums));
  for (PetscInt c = 0; c < ends->facets->num * F; c++) {
    PetscReal *n = &sums[c * END_SUMS + (sums[c * END_SUMS + END_COUNT] > 0 ? END_NORMAL : END_DIAGONAL)];

    if (FrameNormalize(dim, n) > 0) PetscCall(PetscArraycpy(&ends->shape->normal[c * dim], n, dim));
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideEndsSetNormals(Level *level, const SideSums *nodes, const PetscReal share[], const PetscReal known[],
                                  SideShape *shape)
{
  Ends ends = {.level = level, .facets = nodes->facets, .nodes = nodes, .share = share, .shape = shape};

  PetscFunctionBeginUser;
  PetscCall(EndsSet_Private(&ends, END_TURN, INNER_TURN, known));
  PetscCall(EndsSet_Private(&ends, 0, END_TURN, known));
  PetscFunctionReturn(PETSC_SUCCESS);
}
