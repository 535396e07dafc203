/* mortarintegrals.h -- integrals of the nonmortar side as sums at nodes. */
#ifndef MORTISE_MORTARINTEGRALS_H
#define MORTISE_MORTARINTEGRALS_H

#include "contact/carryingnodes.h"
#include "contact/facetintegrals.h"
#include "contact/pairpoints.h"

/* Integrals of all facets, as sums at nodes. */
typedef struct {
  Vec D, full, G;     /* ghosted, one per node */
  Vec overlap;        /* the largest -g at a point of the facets around a node: ghosted, one per node */
  Vec measure, cover; /* of the facets around a node, of their covered parts: ghosted, one per node */
  Mat M;              /* node x node, or NULL */
  Mat arm;            /* of a tie across a gap: unknown x unknown, block size dim, or NULL (leverarm.h) */
  Mat D_other;        /* int psi_a phi_c of nodes c that never carry a multiplier (node x node), or NULL (eq. 3.6) */
  Vec fully_covered,
      partly_covered; /* whether a facet around a node is covered altogether, in part: ghosted, one per node */
  PetscInt         num_boundary;
  OverlapBoundary *boundary; /* of this rank's facets [num_boundary] */
  PetscBool       *covered;  /* of this rank's facets */
  PairPoints       points;   /* of this rank's facets, NULL where gaps are measured alone */
  CarryingNodes    carrying; /* of this rank's facets: the nodes of all these sums */
  ElementType     *carrier;  /* which of a facet's nodes may carry multipliers: the first ones, as of this type */
} MortarIntegrals;

/* D, G and M of a pair, before any row is redistributed. Collective.
   [in] normals - ghosted; [out] sums - owned by the caller, except M, the arm, the overlap boundary and the
   points, which the pair takes over */
PetscErrorCode MortarIntegralsCreate(Level *level, const FacetPartner *partner, const Facets *facets, Vec normals,
                                     MortarIntegrals *sums);
PetscErrorCode MortarIntegralsDestroy(MortarIntegrals *sums);

/* Creates an empty matrix of blocks of size bs, node x node, preallocated for the entries of each facet in
   the rows of its nodes. Collective.
   [in] entries - number of blocks of each facet [facets->num]; [out] A - owned by the caller */
PetscErrorCode MortarIntegralsCreateMat(Level *level, const Facets *facets, const PetscInt entries[], PetscInt bs,
                                        Mat *A);

#endif
