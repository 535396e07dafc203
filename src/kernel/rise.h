/* rise.h -- how far a smooth side is above its facets (eqs. 4.5, 4.5a). */
#ifndef MORTISE_RISE_H
#define MORTISE_RISE_H

#include "kernel/element.h"
#include "kernel/quadric.h"

enum {
  RISE_EDGES = 4,
  /* vectors of one facet: at the nodes of second order, two for each edge, three inside a triangle */
  RISE_CUBIC  = ELEMENT_MAX_FACET_NODES,
  RISE_INSIDE = RISE_CUBIC + 2 * RISE_EDGES,
  RISE_TERMS  = RISE_INSIDE + 3
};

/* What is known of the side at the nodes of a facet of first or second order. */
typedef struct {
  const PetscReal *X, *normal; /* nodes and unit normals [num_nodes][dim] */
  const PetscReal *curvature;  /* shape operators [num_nodes][dim][dim], NULL where they are not of third order */
  const Quadric   *quadric;    /* of the facet, or NULL */
} RiseFacet;

/* Adds what the curve has beyond the parabola over each edge: it has the normals of both ends. A triangle's
   inside is on the quadric, or where the curvatures put it. Edges that bend by less than twice of what is
   added stay parabolas. Not collective.
   [in,out] rise - set at the nodes: zero for a facet of second order, else by ArcBulge() [RISE_TERMS][dim] */
void RiseComplete(ElementType type, const RiseFacet *facet, PetscReal rise[]);

/* The rise at xi. Not collective. [in] type - of first or second order; [out] at - [dim] */
void RiseAt(ElementType type, const PetscReal rise[], const PetscReal xi[], PetscReal at[]);

/* The same along a direction. Not collective. [in] n - [dim] */
PetscReal RiseAlong(ElementType type, const PetscReal rise[], const PetscReal xi[], const PetscReal n[]);

/* Whether any is not zero. Not collective. */
PetscBool RiseIsAny(ElementType type, const PetscReal rise[]);

#endif
