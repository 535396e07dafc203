/* pairpoints.h -- the quadrature points of a pair, kept for the error estimate. */
#ifndef MORTISE_PAIRPOINTS_H
#define MORTISE_PAIRPOINTS_H

#include "contact/overlappoints.h"

/* One point of this rank's covered nonmortar facets. */
typedef struct {
  PetscInt  facet;  /* in `facets` */
  PetscInt  mortar; /* among the mortar facets of this rank, -1 for an obstacle */
  PetscReal xi[2];  /* on the nonmortar facet's reference cell */
  PetscReal eta[2]; /* on the mortar facet's reference cell */
  PetscReal weight; /* of integrals over the nonmortar side, with the ring of an axisymmetric scene */
  PetscReal gap;    /* before any motion, with a given gap or offset; open > 0 */
} PairPoint;

struct _n_PairPoints {
  Facets       facets;          /* the nonmortar side's, of this rank */
  PetscReal   *rises;           /* of these facets, or NULL [facets][RISE_TERMS][dim] */
  Vec          normals;         /* directions of contact at its nodes: ghosted, dim per node */
  PetscInt     num, max;        /* points; room for them */
  PairPoint   *point;           /* facet after facet */
  PetscInt     num_mortar;      /* mortar facets that this rank has met, and others near them */
  ElementType *type;            /* [num_mortar] */
  PetscInt    *nodes;           /* global [num_mortar][ELEMENT_MAX_FACET_NODES] */
  PetscInt    *cell, *material; /* their cells, counted over all ranks, and materials [num_mortar] */
  PetscReal   *size;            /* largest edges [num_mortar] */
};
typedef struct _n_PairPoints *PairPoints;

/* Creates an empty list. Not collective. */
PetscErrorCode PairPointsCreate(PairPoints *points);
/* Appends the points of a facet. Not collective. */
PetscErrorCode PairPointsAdd(PairPoints points, PetscInt facet, const OverlapPoints *list);
/* Copies the data of the mortar facets of a surface. Not collective. [in] surface - of this rank */
PetscErrorCode PairPointsSetMortar(PairPoints points, PetscInt dim, const MortarSurface *surface);
/* NULL is accepted. Collective. */
PetscErrorCode PairPointsDestroy(PairPoints *points);

/* Values of the nodes of mortar facets. Collective. [in] v - bs per node, as of LevelCreateVec();
   [out] values - owned by the caller [num_mortar][ELEMENT_MAX_FACET_NODES][bs] */
PetscErrorCode PairPointsFetch(PairPoints points, Vec v, PetscInt bs, PetscReal **values);
/* Subtracts the term of a tie's arm from a jump (eq. 5.4). Not collective.
   [in] X, u - places and displacements of PairPointsFetch();
   [in,out] jump - [dim] */
void PairPointTakeArm(PairPoints points, const Level *level, const PairPoint *point, const PetscReal X[],
                      const PetscReal u[], PetscReal jump[]);

#endif
