/* sideshape.h -- normals and curvatures of a side, from its facets (eqs. 4.1, 4.3).

   Facets that meet at less than 44 degrees belong to one smooth patch. Normals and curvatures are those of a
   patch: a facet at a feature edge has the normals of its own side of the edge. */
#ifndef MORTISE_SIDESHAPE_H
#define MORTISE_SIDESHAPE_H

#include "kernel/quadric.h"
#include "level/level.h"

/* All arrays are [num][ELEMENT_MAX_FACET_NODES]..., one entry for each node of each facet of this rank. */
typedef struct {
  PetscInt   num;
  PetscReal *normal; /* unit, outward, of the patch at the node [..][dim] */
  PetscReal *
      curvature; /* shape operator S = dn/dx in the tangent plane, symmetric, > 0 where convex; 0 on a flat patch, exactly
                           [..][dim][dim] */
  PetscBool *known, *smooth; /* whether the normal is better than a mean over facets, by (4.1a), (4.1b) or (4.1c);
                                whether (4.1c) has the curvature, too [..] */
  PetscReal *error;          /* of the normal, in radians, estimated by (4.1d); 0 where it is that of a circle or of a
                         quadric, or where the patch ends [..] */
  PetscReal *ridge;   /* 0 where the patch surrounds the node or ends with the side; at a feature edge 1 if that is
                           convex, -1 if not [..] */
  Quadric   *quadric; /* of each facet in space, whose nodes are from a file; NULL in the plane and for maps [num] */
} SideShape;

/* Computes normals and curvatures. Collective.
   [in] facets - of this rank; [in] held - facets of this rank of sides that are held normal, which may be
   planes of symmetry; NULL finds those of the scene; [out] shape - owned by the caller */
PetscErrorCode SideShapeCreate(Level *level, const Facets *facets, const Facets *held, SideShape *shape);
PetscErrorCode SideShapeDestroy(SideShape *shape);

/* Gives a facet the shape of another one. Not collective. [in] from, to - facets; [in,out] shape */
PetscErrorCode SideShapeMove(PetscInt dim, PetscInt from, PetscInt to, SideShape *shape);

/* Whether the normals at all nodes of a facet are better than means. Not collective.
   [in] type - of the facet */
PetscBool SideShapeIsKnown(const SideShape *shape, PetscInt f, ElementType type);

/* How far the side is above a facet, whose normals and curvatures are those of the shape (rise.h). Not
   collective.
   [in] type - of the facet; [in] X - its nodes [num_nodes][dim]; [out] rise - [RISE_TERMS][dim] */
void SideShapeGetRise(const SideShape *shape, PetscInt f, ElementType type, const PetscReal X[], PetscReal rise[]);

/* Whether a patch is curved anywhere on any rank. Collective. */
PetscErrorCode SideShapeIsCurved(const Level *level, const Facets *facets, const SideShape *shape, PetscBool *curved);

#endif
