/* stressquadratic.h -- stresses of a cell as quadratic functions of the place. */
#ifndef MORTISE_STRESSQUADRATIC_H
#define MORTISE_STRESSQUADRATIC_H

#include "result/cellstress.h"
#include "result/stress.h"

/* About the middle of a cell's vertices. */
typedef struct {
  PetscInt  dim, material;
  PetscReal X[CELL_MAX_DIM * ELEMENT_MAX_NODES], middle[CELL_MAX_DIM];
  PetscReal slope[CELL_MAX_DIM * ELEMENT_MAX_NODES]; /* sum_i slope_i value_i is that of values at vertices */
  PetscReal first[CELL_MAX_DIM][CELL_STRESSES], second[CELL_MAX_DIM][CELL_MAX_DIM][CELL_STRESSES]; /* derivatives */
} StressQuadratic;

/* Whether all nodes of a cell lie where its vertices put them. [in] X - of its nodes [num_nodes][dim] */
PetscBool StressCellIsStraight(ElementType type, PetscInt dim, const PetscReal X[]);

/* Slopes of nodal stresses at vertices: means of those over cells, by their volumes. Collective.
   [in] volume - [num_cells]; [out] slopes - ghosted, owned by the caller */
PetscErrorCode StressCreateSlopes(Level *level, const NodalStressArrays *stress, const PetscReal volume[], Vec *slopes);

/* Returns PETSC_FALSE for a cell without volume. Not collective.
   [in] slopes - local, of StressCreateSlopes() */
PetscBool StressQuadraticSet(const Level *level, PetscInt c, const NodeMaterials *at, const PetscScalar slopes[],
                             StressQuadratic *quadratic);

/* At a place, less the stress in the middle. Not collective.
   [in] linear - whether with the linear part; [out] stress - [CELL_STRESSES] */
void StressQuadraticEvaluate(const StressQuadratic *quadratic, const PetscReal x[], PetscBool linear,
                             PetscReal stress[]);

#endif
