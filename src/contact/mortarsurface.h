/* mortarsurface.h -- the mortar facets that may meet the nonmortar facets of this rank, as plain arrays. */
#ifndef MORTISE_MORTARSURFACE_H
#define MORTISE_MORTARSURFACE_H

#include "kernel/boxtree.h"
#include "kernel/clip.h"
#include "level/level.h"
#include "side/sideshape.h"

/* The mortar facets of all ranks that may meet this rank's nonmortar facets, with a box tree. Their order
   depends on the partition; queries return ascending indices. */
typedef struct {
  PetscInt     num;
  ElementType *type;            /* [num] */
  PetscInt    *nodes;           /* global nodes [num][ELEMENT_MAX_FACET_NODES] */
  PetscInt    *cell, *material; /* cells that they belong to, counted over all ranks, and their materials [num] */
  PetscReal   *coords;          /* [num][ELEMENT_MAX_FACET_NODES][dim] */
  /* Of the smooth shape at the nodes, zero without a shape [num][ELEMENT_MAX_FACET_NODES][dim],
     [..][dim][dim]. */
  PetscReal *normals, *curvature;
  PetscReal *rises; /* of smooth sides (rise.h), or NULL [num][RISE_TERMS][dim] */
  PetscBool  edged; /* whether it has a convex feature edge, on any rank */
  BoxTree    tree;
} MortarSurface;

/* Sends to each rank the mortar facets within reach of its nonmortar facets. These are at least the facets
   whose boxes meet the box of a nonmortar facet, widened by the reach. Collective.
   [in] shape, rises - of the mortar facets (smoothgap.h); optional, may be NULL on all ranks;
   [out] surface - owned by the caller, MortarSurfaceDestroy() */
PetscErrorCode MortarSurfaceCreate(Level *level, const Facets *nonmortar, const Facets *mortar, const SideShape *shape,
                                   const PetscReal rises[], PetscReal reach, MortarSurface *surface);
PetscErrorCode MortarSurfaceDestroy(MortarSurface *surface);
/* Creates the tree of its facets again, after they have moved. Not collective. */
PetscErrorCode MortarSurfaceUpdateTree(PetscInt dim, MortarSurface *surface);
/* Values at nodes of any rank. Collective.
   [in] u - dim per node; nodes - global [num]; [out] values - [num][dim] */
PetscErrorCode MortarSurfaceFetch(Vec u, PetscInt dim, PetscInt num, const PetscInt nodes[], PetscReal values[]);
/* The mortar facets that rays from a nonmortar facet may meet within the reach, in front or behind, and few
   others. So all queries of a side take n log n operations for any reach. The rays go along the normals
   between those at the nodes. Not collective.
   [in] reach - at most that of the surface; [out] hits - ascending, borrowed until the next query
   [num_hits] */
PetscErrorCode MortarSurfaceQuery(const MortarSurface *surface, PetscInt dim, const ClipFacet *facet, PetscReal reach,
                                  PetscInt *num_hits, const PetscInt *hits[]);

#endif
