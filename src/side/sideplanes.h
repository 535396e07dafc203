/* sideplanes.h -- planes of symmetry at which sides end. Private. */
#ifndef MORTISE_SIDEPLANES_H
#define MORTISE_SIDEPLANES_H

#include "side/sidesums.h"

enum { SIDE_PLANES_MAX = 6 }; /* directions; with more of them, sides that are held normal are curved */

/* Directions of flat sides that are held normal, and the nodes of another side that are on such sides. The
   body continues behind them as its mirror image, if the other side meets them at a right angle. */
typedef struct {
  PetscInt  num;
  PetscReal normal[SIDE_PLANES_MAX][3];
  PetscInt *on; /* bits of the directions of each node [sums->num] */
} SidePlanes;

/* Finds the planes. Collective.
   [in] sums - of the other side; [in] held - facets of this rank of sides that are held normal, NULL for no
   planes; [out] planes - owned by the caller, SidePlanesDestroy() */
PetscErrorCode SidePlanesCreate(Level *level, const SideSums *sums, const Facets *held, SidePlanes *planes);
PetscErrorCode SidePlanesDestroy(SidePlanes *planes);

/* Normals of the other side where it ends, at the corners of facets. */
typedef struct {
  const PetscReal *skip;   /* not 0 at corners that have no part in it [num][F] */
  const PetscReal *mean;   /* means over facets [num][F][dim] */
  const PetscReal *end;    /* extrapolated [num][F][dim] */
  const PetscReal *spread; /* of these [num][F] */
} SideEnds;

/* Drops the directions that the other side does not meet at a right angle: most of its normals at ends,
   extrapolated, are not far from there for means over one side, or for their own spread. Collective. */
PetscErrorCode SidePlanesJudge(const SideSums *nodes, PetscInt dim, const SideEnds *ends, SidePlanes *planes);

/* Makes a normal tangential to planes. Where these leave one direction, it is exact. Not collective.
   [in] on - bits of planes; [in,out] normal - unit [dim] */
void SidePlanesProject(const SidePlanes *planes, PetscInt dim, PetscInt on, PetscReal normal[]);

/* The mirror image of a vector in a plane, in place. Not collective. [in,out] v - [dim] */
void SidePlanesReflect(const SidePlanes *planes, PetscInt dim, PetscInt plane, PetscReal v[]);

/* The mirror image R A R of a matrix, in place. Not collective. [in,out] A - [dim][dim] */
void SidePlanesReflectMatrix(const SidePlanes *planes, PetscInt dim, PetscInt plane, PetscReal A[]);

#endif
