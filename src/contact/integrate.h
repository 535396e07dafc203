/* integrate.h -- the integrals of one nonmortar facet against everything it may touch (private to the room). */
#ifndef MORTISE_INTEGRATE_H
#define MORTISE_INTEGRATE_H

#include "surface.h"

/* Contribution of one nonmortar facet with n nodes; arrays grow as needed and are reused from facet to facet. */
typedef struct {
  PetscInt   n;                                /* nodes of the nonmortar facet */
  PetscReal  covered[ELEMENT_MAX_FACET_NODES]; /* D_ii: int_cov phi_i = int psi_i */
  PetscReal  full[ELEMENT_MAX_FACET_NODES];    /* int phi_i over the whole facet */
  PetscReal  gap[ELEMENT_MAX_FACET_NODES];     /* int psi_i g */
  PetscInt   num_columns, max_columns;         /* mortar nodes met */
  PetscInt  *columns;                          /* global nodes [num_columns] */
  PetscReal *M;                                /* int psi_i phi^m_j(pi) [num_columns][ELEMENT_MAX_FACET_NODES] */
} FacetIntegral;

/* What a facet is integrated against. */
typedef struct {
  const ScenePair     *spec;
  const MortarSurface *mortar; /* NULL for an obstacle */
  PetscInt             dim;
  PetscReal            reach;
} FacetPartner;

/* Integrates one facet. [in] X - its nodes [n][dim]; [in] N - unit normals at them [n][dim].
   covered = 0 where nothing is within reach. Not collective. */
PetscErrorCode FacetIntegrate(const FacetPartner *partner, ElementType type, const PetscReal X[], const PetscReal N[],
                              FacetIntegral *integral);
PetscErrorCode FacetIntegralDestroy(FacetIntegral *integral);

#endif
