/* refinement.h -- every cell of a DMPlex split into equal parts. Private to this module.

   Points of a type in the coarse DM have the same parts: products. The parts of all of them follow each other
   in the fine DM. So the origin of a fine point is known by its number. */
#ifndef MORTISE_REFINEMENT_H
#define MORTISE_REFINEMENT_H

#include "level/level.h"

enum { REFINEMENT_TYPES = 6, REFINEMENT_PRODUCTS = 4 }; /* vertex, edge, two facets, two solids; of one of them */

/* The parts of one type that each coarse point has. */
typedef struct {
  DMPolytopeType type;
  PetscInt       first, parts; /* fine point of the first coarse point; of each coarse point */
} RefinementProduct;

/* The coarse points of one type. */
typedef struct {
  DMPolytopeType    type;
  PetscInt          begin, end; /* coarse points */
  PetscInt          num_products;
  RefinementProduct product[REFINEMENT_PRODUCTS];
} RefinementSource;

typedef struct {
  PetscInt         num_sources;
  RefinementSource source[REFINEMENT_TYPES];
} Refinement;

/* Splits every cell of a DM, with the numbers of DMPlexTransform of type DMPLEXREFINEREGULAR. Labels,
   positions and the points of other ranks follow. Collective. [out] fine - owned by the caller */
PetscErrorCode RefinementCreate(DM coarse, Refinement *refinement, DM *fine);
/* The fine points that a coarse one is split into, type by type.
   [out] num - of types; first, parts - of each type [REFINEMENT_PRODUCTS] */
void RefinementGetParts(const Refinement *refinement, PetscInt point, PetscInt *num, PetscInt first[],
                        PetscInt parts[]);
/* The coarse point that a fine one is a part of.
   [out] vertex - whether that is a vertex; optional, may be NULL */
PetscInt RefinementGetSource(const Refinement *refinement, PetscInt point, PetscBool *vertex);

/* Parts of RefinementCreate() once the fine DM has its cones: labels, points of other ranks, positions.
   Collective. */
PetscErrorCode RefinementSetLabels(const Refinement *refinement, DM coarse, DM fine);
PetscErrorCode RefinementSetPointSF(const Refinement *refinement, DM coarse, DM fine);
PetscErrorCode RefinementSetCoords(const Refinement *refinement, DM coarse, DM fine);

#endif
