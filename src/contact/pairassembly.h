/* pairassembly.h -- a pair under assembly, from integrals to multipliers. */
#ifndef MORTISE_PAIRASSEMBLY_H
#define MORTISE_PAIRASSEMBLY_H

#include "contact/pair.h"
#include "contact/mortarintegrals.h"
#include "contact/redistribution.h"

typedef struct {
  const ScenePair  *spec;       /* borrowed */
  Facets            nonmortar;  /* of this rank */
  SideShape         shape;      /* of these facets */
  PetscReal        *rises;      /* of these facets, or NULL [num][RISE_TERMS][dim] */
  Vec               normals;    /* directions of contact: ghosted, dim per node */
  Vec               directions; /* the same with their parts that supports fix, or NULL with gap_only */
  MortarIntegrals   sums;
  MultiplierStatus *status; /* [num_nodes] */
  PetscBool gap_only; /* whether gaps are measured alone, in any configuration: no M, and the pair knows its reach */
  Vec       displacement; /* with gap_only: from where the mesh is to that configuration, ghosted, or NULL; borrowed */
  PetscReal motion;       /* largest decrease of a distance by it */
  Vec       own[2]; /* with a displacement: the side's own normals before and after it, ghosted, owned by the caller */
} PairAssembly;

/* Frees all data that the pair has not taken over. Collective. */
PetscErrorCode PairAssemblyDestroy(PairAssembly *assembly);
#endif
