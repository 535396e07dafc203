/* arcsums.h -- the offset of an edge from what its facets ask for. Not collective. */
#ifndef MORTISE_ARCSUMS_H
#define MORTISE_ARCSUMS_H

#include <petscsys.h>

enum { ARC_SUMS = 15 };

/* The offset x of an edge, from those o by its facets: the least one with o.x = |o|^2 for all. Facets of one
   patch give the same o, of different patches others, and the edge is on both. Sides fixed along their
   normal stay flat. Returns whether the offset is not zero.
   [in] sums - of ArcSumsAddOffset(), and of ArcSumsAddPlane() along which there must be none [ARC_SUMS];
   [out] offset - [dim] */
PetscBool ArcSumsToOffset(PetscInt dim, const PetscScalar sums[], PetscReal offset[]);
void      ArcSumsAddOffset(PetscInt dim, const PetscReal offset[], PetscScalar sums[]);
void      ArcSumsAddPlane(PetscInt dim, const PetscReal normal[], PetscScalar sums[]);

#endif
