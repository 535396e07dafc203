/* bodycounts.h -- sizes of bodies and of their regions, on all ranks. */
#ifndef MORTISE_BODYCOUNTS_H
#define MORTISE_BODYCOUNTS_H

#include "problem/vi.h"

typedef struct {
  PetscInt cells, nodes;
} BodyCount;

/* Collective. [out] counts - [num_bodies], the same on all ranks */
PetscErrorCode BodyCountsCompute(const Level *level, PetscInt num_bodies, BodyCount counts[]);

/* The cells of one material. */
typedef struct {
  const char          *name; /* of the region, NULL for cells in none */
  PetscInt             body, cells;
  PetscReal            volume; /* area times thickness in a plane, of the whole ring where axisymmetric */
  const SceneMaterial *material;
} RegionCount;

/* Materials of bodies with regions that have cells, by body, in the order typed, those in no region last.
   Collective. [out] counts - [num], owned by the caller, the same on all ranks; none where no body has
   regions */
PetscErrorCode RegionCountsCompute(Scene scene, const Level *level, PetscInt *num, RegionCount **counts);

#endif
