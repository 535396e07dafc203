/* candidates.c -- which mortar facets the rays of one nonmortar facet may meet.

   The rays fill a tube about the facet's normals that is as long as the reach and hardly wider than the facet. A box around
   a tube that lies askew would hold ever more facets as they get smaller; slabs along the tube and across it do not. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/contactsurface.h"

/* Roundoff must not hide what touches the end of a facet: a query is wider by this share. */
static const PetscReal QUERY_SLACK = 1e-8;

/* Directions about a mean one. */
typedef struct {
  PetscReal mean[3], cosine; /* of the widest angle between them; 0 where it is a right one or more */
} Cone;

/* The cone of the normals: that of the Bezier points of their field, since what lies between two of them is in it, too. */
static Cone Cone_Private(PetscInt dim, ElementType type, const PetscReal N[])
{
  const PetscInt n    = ElementNumNodes(type);
  Cone           cone = {{0, 0, 0}, 1};
  PetscReal      hull[3 * ELEMENT_MAX_FACET_NODES];

  for (PetscInt i = 0; i < n * dim; i++) cone.mean[i % dim] += N[i];
  FrameNormalize(dim, cone.mean);
  FacetHull(dim, type, N, hull);
  for (PetscInt i = 0; i < n; i++) {
    PetscReal dot = 0;
    FrameNormalize(dim, &hull[i * dim]);
    for (PetscInt k = 0; k < dim; k++) dot += cone.mean[k] * hull[i * dim + k];
    cone.cosine = PetscMax(0, PetscMin(cone.cosine, dot));
  }
  return cone;
}

/* The largest component of unit vectors of the cone along a direction whose own component along the mean is given. */
static PetscReal Component_Private(const Cone *cone, PetscReal along)
{
  const PetscReal a = PetscAbsReal(along), c = cone->cosine;

  if (a >= c) return 1; // the direction lies in the cone
  return a * c + PetscSqrtReal((1 - a * a) * (1 - c * c));
}

/* The range of direction . x over a facet, widened. [in] hull - [n][dim] */
static BoxSlab Range_Private(PetscInt dim, PetscInt n, const PetscReal hull[], const PetscReal direction[],
                             PetscReal margin)
{
  BoxSlab range = {.lower = PETSC_MAX_REAL, .upper = PETSC_MIN_REAL};

  for (PetscInt i = 0; i < n; i++) {
    PetscReal x = 0;
    for (PetscInt k = 0; k < dim; k++) x += direction[k] * hull[i * dim + k];
    range.lower = PetscMin(range.lower, x);
    range.upper = PetscMax(range.upper, x);
  }
  for (PetscInt k = 0; k < dim; k++) range.direction[k] = direction[k];
  range.lower -= margin;
  range.upper += margin;
  return range;
}

PetscErrorCode MortarSurfaceQuery(const MortarSurface *surface, PetscInt dim, const ClipFacet *facet, PetscReal reach,
                                  PetscInt *num_hits, const PetscInt *hits[])
{
  const PetscInt  n         = ElementNumNodes(facet->type);
  const Cone      cone      = Cone_Private(dim, facet->type, facet->N);
  const PetscReal slack     = QUERY_SLACK * (reach + FacetSize(dim, facet->type, facet->X));
  PetscInt        num_slabs = 0;
  PetscReal       hull[3 * ELEMENT_MAX_FACET_NODES], Q[9], box[6];
  BoxSlab         slabs[3];

  PetscFunctionBeginUser;
  FacetHull(dim, facet->type, facet->X, hull);
  for (PetscInt k = 0; k < dim; k++) {
    const PetscReal axis[3] = {k == 0, k == 1, k == 2};
    const BoxSlab   range   = Range_Private(dim, n, hull, axis, Component_Private(&cone, cone.mean[k]) * reach + slack);
    box[k]                  = range.lower;
    box[dim + k]            = range.upper;
  }
  if (cone.cosine > 0) {
    FrameFromNormal(dim, cone.mean, Q);
    for (; num_slabs < dim; num_slabs++) {
      const PetscReal along = num_slabs == 0 ? 1 : 0;
      slabs[num_slabs] =
          Range_Private(dim, n, hull, &Q[num_slabs * dim], Component_Private(&cone, along) * reach + slack);
    }
  }
  PetscCall(BoxTreeQuerySlabs(surface->tree, box, num_slabs, slabs, num_hits, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}
