/* cellstress.h -- the stress within a cell. */
#ifndef MORTISE_CELLSTRESS_H
#define MORTISE_CELLSTRESS_H

#include "level/level.h"
#include "kernel/dilatation.h"

enum { CELL_STRESSES = 6, CELL_MAX_DIM = 3 };

/* What is known of one cell; at its nodes [num_nodes][dim] each. */
typedef struct {
  PetscInt   material;
  PetscBool  constant;                                  /* whether C is the same everywhere */
  PetscReal  C[CELL_STRESSES * CELL_STRESSES], poisson; /* then of ElasticityHooke() */
  PetscReal  X[ELEMENT_MAX_NODES * CELL_MAX_DIM], u[ELEMENT_MAX_NODES * CELL_MAX_DIM];
  Dilatation pi;
  PetscReal  parts[DILATATION_MAX_FUNCTIONS]; /* of the change of volume without stress */
} CellStress;

/* Takes cell c of a level. Not collective. [in] stiffness - its rule of ElasticityRulesCreate(); u - at local
   nodes [num_nodes][dim] */
PetscErrorCode CellStressSet(Scene scene, const Level *level, PetscInt c, const ElementRule *stiffness,
                             const PetscScalar u[], CellStress *cell);
/* sigma = C (eps - eps_0) at point q of a rule, xx,yy,zz,yz,xz,xy; the change of volume is that of eq. 9.1.
   Not collective. [out] det - det J there; lost - div u - theta, which has no energy; 0 for plain cells;
   optional, may be NULL */
PetscErrorCode CellStressAtPoint(Scene scene, const CellStress *cell, const ElementRule *rule, PetscInt q,
                                 PetscReal stress[CELL_STRESSES], PetscReal *det, PetscReal *lost);

/* t = s n. Not collective. [in] stress - xx,yy,zz,yz,xz,xy; [in] n - [dim]; [out] t - [dim] */
void CellStressTraction(PetscInt dim, const PetscScalar stress[], const PetscReal n[], PetscReal t[]);

#endif
