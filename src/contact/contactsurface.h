/* contactsurface.h -- the two sides of a pair as plain arrays. */
#ifndef MORTISE_CONTACTSURFACE_H
#define MORTISE_CONTACTSURFACE_H

#include "kernel/boxtree.h"
#include "kernel/clip.h"
#include "mesh/mesh.h"
#include "mesh/sideshape.h"

/* Surfaces face each other, and a direction meets a facet, when the cosine with the facet's normal is below this: beyond 107 degrees. */
static const PetscReal FACING = -0.3;

/* The mortar facets of all ranks that may meet this rank's nonmortar facets, with a box tree. Their order depends on the
   partition; queries return ascending indices. */
typedef struct {
  PetscInt     num;
  ElementType *type;            /* [num] */
  PetscInt    *nodes;           /* global nodes [num][ELEMENT_MAX_FACET_NODES] */
  PetscInt    *cell, *material; /* cells that they belong to, counted over all ranks, and their materials [num] */
  PetscReal   *coords;          /* [num][ELEMENT_MAX_FACET_NODES][dim] */
  PetscReal   *normals,
      *curvature; /* of their patches, zero where no shape was given [num][ELEMENT_MAX_FACET_NODES][dim], [..][dim][dim] */
  PetscReal *bulges; /* of sides that are taken for smooth, or NULL [num][ELEMENT_MAX_FACET_NODES][dim] */
  BoxTree    tree;
} MortarSurface;

/* Brings the mortar facets within reach of this rank's nonmortar facets to this rank: at least those whose boxes meet that
   of a nonmortar facet, widened by the reach on all sides. Collective. [in] shape - of the mortar facets, optional, may be NULL;
   [out] surface - owned by the caller, MortarSurfaceDestroy() */
PetscErrorCode MortarSurfaceCreate(Level *level, const Facets *nonmortar, const Facets *mortar, const SideShape *shape,
                                   PetscReal reach, MortarSurface *surface);
PetscErrorCode MortarSurfaceDestroy(MortarSurface *surface);
/* Makes the tree of its facets anew. Not collective. */
PetscErrorCode MortarSurfaceUpdateTree(PetscInt dim, MortarSurface *surface);
/* Values at nodes of any rank. Collective. [in] u - dim per node; nodes - global [num]; [out] values - [num][dim] */
PetscErrorCode MortarSurfaceFetch(Vec u, PetscInt dim, PetscInt num, const PetscInt nodes[], PetscReal values[]);
/* The mortar facets that rays from a nonmortar facet may meet within the reach, in front or behind, and few others, so that
   all queries of a side take n log n however far they reach. The rays go along any normals between those at the nodes. Not
   collective. [in] reach - no more than that of the surface;
   [out] hits - ascending, borrowed until the next query [num_hits] */
PetscErrorCode MortarSurfaceQuery(const MortarSurface *surface, PetscInt dim, const ClipFacet *facet, PetscReal reach,
                                  PetscInt *num_hits, const PetscInt *hits[]);

/* Coordinates of a facet's nodes, [num_nodes][dim]. Not collective. */
void ContactFacetCoordinates(const Level *level, const Facets *facets, PetscInt f, PetscReal X[]);
/* Points whose convex hull holds the facet, curved or not (those of Bezier), and a box that does. The same goes for any field
   that is interpolated in its nodes. [in] X - [num_nodes][dim]; [out] hull - [num_nodes][dim]; [out] box - lower, upper corner [2][dim] */
void ContactFacetHull(PetscInt dim, ElementType type, const PetscReal X[], PetscReal hull[]);
void ContactFacetBox(PetscInt dim, ElementType type, const PetscReal X[], PetscReal box[]);
/* Largest distance between neighbouring vertices, or (collective) that of all of a side over all ranks. */
PetscReal      ContactFacetSize(PetscInt dim, ElementType type, const PetscReal X[]);
PetscErrorCode ContactFacetMaxSize(const Level *level, const Facets *facets, PetscReal *size);

#endif
