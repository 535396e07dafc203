/* surface.h -- the two sides of a pair as plain arrays (private to the room). */
#ifndef MORTISE_SURFACE_H
#define MORTISE_SURFACE_H

#include <mortise/boxtree.h>
#include <mortise/mesh.h>

/* The whole mortar side on every rank, with a box tree. Facets in the order of their lowest global nodes' ranks do not
   matter: every candidate is integrated, and queries return ascending indices. */
typedef struct {
  PetscInt     num;
  ElementType *type;   /* [num] */
  PetscInt    *nodes;  /* global nodes [num][ELEMENT_MAX_FACET_NODES] */
  PetscReal   *coords; /* [num][ELEMENT_MAX_FACET_NODES][dim] */
  BoxTree      tree;
} MortarSurface;

/* Gathers facets of all ranks. Collective. */
PetscErrorCode MortarSurfaceCreate(Level *level, const Facets *facets, MortarSurface *surface);
PetscErrorCode MortarSurfaceDestroy(MortarSurface *surface);

/* Coordinates of a facet's nodes, [num_nodes][dim]. Not collective. */
void FacetCoordinates(const Level *level, const Facets *facets, PetscInt f, PetscReal X[]);
/* A box that holds the facet, curved or not. [out] box - lower, upper corner [2][dim] */
void FacetBox(PetscInt dim, ElementType type, const PetscReal X[], PetscReal box[]);
/* Largest distance between neighbouring vertices, or that of all of a side over all ranks. */
PetscReal      FacetSize(PetscInt dim, ElementType type, const PetscReal X[]);
PetscErrorCode FacetsMaxSize(const Level *level, const Facets *facets, PetscReal *size);

#endif
