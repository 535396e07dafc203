/* pair.h -- D, M, weighted gap and normals of one contact pair on one level (eqs. 3.2-3.4).

   D_ab = int psi_a phi^s_b,  M_ab = int psi_a phi^m_b(pi(.)),  G_a = int psi_a g  over the covered part of
   the nonmortar side. Rows of removed nodes (fixed along the normal, or hardly covered) are redistributed to
   their kept neighbours (eq. 5.1): this gives D few entries off its diagonal. Facets are integrated by their
   rank.

   With multipliers at vertices of quadratic facets alone (MULTIPLIERS_VERTICES), psi is dual to the linear
   shape functions. D is written for u~ of u = u~ + to_nodal u~ on the nonmortar side. A vertex keeps its
   displacement; the unknown at a middle node is its displacement less the mean of the two ends (eq. 3.6). On
   tri6, psi is dual to phi~, and u~ is that of eq. 3.5, with other unknowns at nodes with multipliers as
   well. M applies to u. */
#ifndef MORTISE_PAIR_H
#define MORTISE_PAIR_H

#include "level/level.h"
#include "support/support.h"

/* Where the covered part of the nonmortar side ends within a facet. */
typedef struct {
  PetscReal x[3], normal[3]; /* of the nonmortar side */
  PetscInt  node, mortar;    /* a local node of the nonmortar facet, a global one of the mortar facet */
} OverlapBoundary;

struct _n_Pair {
  const ScenePair *spec;    /* borrowed */
  Level           *level;   /* borrowed */
  PetscInt         num;     /* multiplier nodes owned by this rank */
  PetscInt        *nodes;   /* their local node numbers, ascending [num] */
  PetscReal       *D;       /* weights D_aa > 0 [num] */
  PetscReal       *gap;     /* nodal gaps G_a / D_aa, signed, open > 0 [num] */
  PetscReal       *share;   /* sum of the row of D over D_aa: gaps and slips over it are geometric ones [num] */
  PetscReal       *overlap; /* the largest -g at a point of the facets around a node, plus its change by curves [num] */
  PetscReal       *normal;  /* unit, out of the nonmortar body [num][dim] */
  PetscReal *frame; /* rows (n, t..) orthonormal; t along the fixed direction where there is one [num][dim][dim] */
  PetscBool *partly_covered; /* whether a facet around the node is covered in part; boundary has where [num] */
  PetscBool *fully_covered;  /* whether a facet around the node is covered completely [num] */
  PetscReal *cover;          /* the part of the facets around the node that is covered, 0..1 [num] */
  PetscBool *slides;         /* with friction: whether a support ever moves the node along its partner [num] */
  PetscBool *oblique;        /* nodes without a multiplier because supports hold them obliquely, or NULL [num_nodes] */
  PetscInt   num_beyond;
  PetscInt
      *beyond; /* local nodes without a multiplier that the partner hardly covers: they lie outside it [num_beyond] */
  PetscInt         num_boundary;
  OverlapBoundary *boundary; /* of facets of this rank [num_boundary] */
  Mat              D_other;  /* D_ac, c without a multiplier (node x node), or NULL where there is none */
  Mat to_nodal, from_nodal;  /* u = u~ + to_nodal u~, u~ = u + from_nodal u (node x node), or NULL where u~ = u */
  Mat M;                     /* node x node, rows of multiplier nodes; NULL for an obstacle */
  Mat arm; /* of a tie: its term beside M across a gap (5.4), and beside held nodes (5.5); blocks of size dim, or NULL */
  Mat passed; /* of a tie: w_ac Pi_c for rows that held nodes c pass on (eq. 5.5), blocks of size dim, or NULL */
  struct _n_PairPoints *points;                                      /* where the pair was integrated (pairpoints.h) */
  PetscInt              num_facets_nonmortar, num_facets_mortar;     /* of all ranks */
  PetscInt              num_multipliers, num_removed, num_uncovered; /* nodes of all ranks */
  PetscReal             reach;                                       /* search radius */
  PetscBool smooth[2];      /* whether the nonmortar, the mortar side is smooth: gaps are those of curves (eq. 4.5) */
  PetscReal curve_error[2]; /* largest error of gaps by the curvature of each side between nodes; 0 if gaps are given */
};
typedef struct _n_Pair *Pair;

/* Collective. */
PetscErrorCode PairDestroy(Pair *pair);

#endif
