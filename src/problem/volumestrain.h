/* volumestrain.h -- mean dilatation of one cell. */
#ifndef MORTISE_VOLUMESTRAIN_H
#define MORTISE_VOLUMESTRAIN_H

#include "problem/elasticity.h"

/* Coordinates of a cell's nodes. [out] X - [num_nodes][dim] */
void VolumeStrainCoordinates(const Level *level, PetscInt c, PetscReal X[]);

/* Pi of a cell whose points are known already.
   [in] x - [rule->num][dim]; [in] w - weights with det J and the measure [rule->num]; [in,out] grad -
   derivatives of shape functions, which become div [rule->num][num_nodes][dim] */
void VolumeStrainDilatation(Scene scene, DilatationKind kind, const ElementRule *rule, const PetscReal x[],
                            const PetscReal w[], PetscReal grad[], Dilatation *dilatation);

/* The message for cells of a material that lock, with the remedy. [out] sentence - [len] */
void VolumeStrainLockingText(Scene scene, PetscInt material, ElementType type, PetscReal poisson, char sentence[],
                             size_t len);

#endif
