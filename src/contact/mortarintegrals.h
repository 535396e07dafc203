/* mortarintegrals.h -- normals and integrals of the nonmortar side as sums at nodes. */
#ifndef MORTISE_MORTARINTEGRALS_H
#define MORTISE_MORTARINTEGRALS_H

#include "contact/carryingnodes.h"
#include "contact/facetintegrals.h"
#include "contact/pairpoints.h"

/* Unit normals of the nonmortar side at its nodes, zero elsewhere (eq. 4.1). Collective.
   [in] shape - of the side;
   [out] normals - ghosted, dim per node, owned by the caller */
PetscErrorCode NodalNormalsCreate(Level *level, const Facets *facets, const SideShape *shape, Vec *normals);

/* Directions of contact at the nodes of the nonmortar side, between its own normals and the partner's, by the
   curvatures of both (eq. 4.3). A node that faces no partner within reach takes the direction of its facets'
   other nodes, or keeps its own normal. At a convex edge of the nonmortar side it is the normal of a smooth
   partner. Collective. [in] shape - of the side; [in,out] normals - ghosted */
PetscErrorCode ContactNormalSet(Level *level, const FacetPartner *partner, const Facets *facets, const SideShape *shape,
                                Vec normals);
/* Whether a side has a convex edge on any rank. Collective. [in] shape - of the side */
PetscErrorCode ContactNormalHasEdge(const Level *level, const SideShape *shape, PetscBool *edge);

/* Sums the contributions of all ranks to normals, and normalizes; zero stays zero. Collective.
   [in,out] normals - ghosted */
PetscErrorCode NodalNormalsShare(Level *level, Vec normals);

/* Gives hanging nodes the directions of those that they hang on, interpolated and normalized. A node on which
   nodes of the side hang, and which has no facet of the side, gets the mean of theirs. Without hanging nodes
   nothing happens. Collective. [in,out] normals - ghosted */
PetscErrorCode NodalNormalsConform(Level *level, Vec normals);

/* Where facets meet at more than 44 degrees, takes the node's normal from those that face the other side.
   Collective.
   [in] sees - whether each facet does [facets->num]; [in,out] normals - ghosted, as created; [out] changed -
   whether there is such a node */
PetscErrorCode NodalNormalsSharpen(Level *level, const Facets *facets, const PetscBool sees[], Vec normals,
                                   PetscBool *changed);

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
