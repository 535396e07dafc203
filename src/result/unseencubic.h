/* unseencubic.h -- what quadrilaterals and hexahedra of order 2 leave of a cubic displacement. */
#ifndef MORTISE_UNSEENCUBIC_H
#define MORTISE_UNSEENCUBIC_H

#include "result/compliance.h"

/* A parallelogram or parallelepiped, and in it the second derivatives of a stress. */
typedef struct {
  PetscInt  dim, material;
  PetscReal middle[CELL_MAX_DIM];
  PetscReal axis[CELL_MAX_DIM][CELL_MAX_DIM];     /* edges */
  PetscReal gradient[CELL_MAX_DIM][CELL_MAX_DIM]; /* of the reference coordinates, 0 to 1 along the edges */
  PetscReal second[CELL_MAX_DIM][CELL_MAX_DIM][CELL_STRESSES];
} UnseenCubic;

/* Mean over the cell of eps : C : eps. A cubic displacement has such stresses, and the cell a function with
   its values at the nodes: eps is the strain of their difference. Not collective.
   [in] shear - whether eps counts without its change of volume, which is projected (eq. 9.1) */
PetscErrorCode UnseenCubicEnergy(const UnseenCubic *cubic, PetscBool shear, Compliance *compliance, PetscReal *mean);

#endif
