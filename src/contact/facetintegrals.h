/* facetintegrals.h -- integrals of one nonmortar facet with all its partners. */
#ifndef MORTISE_FACETINTEGRALS_H
#define MORTISE_FACETINTEGRALS_H

#include "kernel/dual.h"
#include "contact/pair.h"
#include "contact/overlappoints.h"

/* The nodes whose rows a facet has a part in: its own, or those that its hanging nodes hang on. */
typedef struct {
  const DualNodes *nodes;                          /* NULL where none hangs */
  PetscReal        N[3 * ELEMENT_MAX_FACET_NODES]; /* contact directions at them [n][dim] */
} FacetRows;

/* Contribution of one nonmortar facet, n of whose nodes carry multipliers, the first ones; arrays grow as
   needed. */
typedef struct {
  const FacetRows *rows;                             /* borrowed while it is computed */
  PetscInt         n;                                /* all nodes of the facet, or its vertices */
  PetscReal        size;                             /* of the facet, a length */
  PetscReal        measure, cover;                   /* of the facet, of its covered part */
  PetscBool        fully_covered, partly_covered;    /* covered completely; covered by a mesh in part */
  PetscReal        covered[ELEMENT_MAX_FACET_NODES]; /* D_ii: int_cov phi~_i = int psi_i */
  PetscReal        full[ELEMENT_MAX_FACET_NODES];    /* int phi~_i over the whole facet */
  PetscReal        gap[ELEMENT_MAX_FACET_NODES];     /* int psi_i g */
  PetscReal        least_gap; /* smallest gap at a point, less its change by curves; infinite where there is none */
  PetscReal D_other[ELEMENT_MAX_FACET_NODES][ELEMENT_MAX_FACET_NODES]; /* int psi_i phi_j of nodes j >= n, else zero */
  PetscInt  num_columns, max_columns;                                  /* mortar nodes met */
  PetscInt *columns;                                                   /* global nodes [num_columns] */
  PetscInt  num_boundary;
  OverlapBoundary *boundary; /* overlap boundary of a facet that is covered in part; without nodes [num_boundary] */
  PetscReal       *M;        /* int psi_i phi^m_j(pi) [num_columns][ELEMENT_MAX_FACET_NODES] */
  PetscBool        turns;    /* whether the contact directions at its nodes differ (eq. 4.6) */
  PetscBool        has_arm;  /* whether a tie has an arm on this facet (leverarm.h) */
  PetscReal       *arm;      /* of a tie: int psi_i block_j [num_columns][ELEMENT_MAX_FACET_NODES][dim][dim] */
} FacetIntegral;

/* The element whose shape functions multipliers of a facet are dual to: the facet's own, or the linear one
   (eq. 3.6). */
ElementType FacetIntegralCarrier(const ScenePair *spec, ElementType facet);

/* Integrates one facet. covered = 0 where nothing is within reach. Not collective.
   [in] rises - of the facet, or NULL; [in,out] list - workspace; afterwards its points, with the gaps of the
   integrals */
PetscErrorCode FacetIntegralCompute(const FacetPartner *partner, const ClipFacet *facet, const FacetRows *rows,
                                    const PetscReal rises[], OverlapPoints *list, FacetIntegral *integral);
PetscErrorCode FacetIntegralDestroy(FacetIntegral *integral);

#endif
