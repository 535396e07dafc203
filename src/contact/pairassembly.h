/* pairassembly.h -- a pair under assembly, from integrals to multipliers. */
#ifndef MORTISE_PAIRASSEMBLY_H
#define MORTISE_PAIRASSEMBLY_H

#include "contact/pair.h"
#include "contact/mortarintegrals.h"
#include "contact/redistribution.h"

typedef struct {
  const ScenePair  *spec;      /* borrowed */
  Facets            nonmortar; /* of this rank */
  SideShape         shape;     /* of these facets */
  PetscReal        *bulges;    /* of these facets, or NULL [num][ELEMENT_MAX_FACET_NODES][dim] */
  Vec               normals;   /* directions of contact: ghosted, dim per node */
  MortarIntegrals   sums;
  MultiplierStatus *status; /* [num_nodes] */
  PetscBool gap_only; /* whether gaps are measured alone, in any configuration: no M, and the pair knows its reach */
  Vec       displacement; /* with gap_only: from where the mesh is to that configuration, ghosted, or NULL; borrowed */
  PetscReal motion;       /* how far two points may have come nearer by it */
  Vec       own[2]; /* with a displacement: the side's own normals before and after it, ghosted, owned by the caller */
} PairAssembly;

/* Searches and integrates one pair. Collective. [in] assembly - zero but for gap_only and displacement; [in,out] pair - with its spec and level;
   [out] assembly - all but what MultiplierStatusResolve() decides, PairAssemblyDestroy() */
PetscErrorCode PairAssemblyCreate(Scene scene, Level *level, const Support *support, Pair pair, PairAssembly *assembly);
/* Frees all but what the pair has taken. */
PetscErrorCode PairAssemblyDestroy(PairAssembly *assembly);
/* The level with the nodes of this rank where a displacement takes them; normals of the nonmortar side's shape, and places and normals of
   mortar facets, follow. Curvatures and bulges stay: displacements are interpolated as the mesh is. Collective. [in,out] assembly - its shape
   and own normals; [in,out] surface - or NULL; [out] moved - a copy of the level that borrows all but its coordinates, DeformedLevelDestroy() */
PetscErrorCode DeformedLevelCreate(Level *level, PairAssembly *assembly, MortarSurface *surface, Level *moved);
PetscErrorCode DeformedLevelDestroy(Level *moved);

/* The farthest candidate: what the user said, or from the geometry. Collective. [in] mortar - NULL for an obstacle */
PetscErrorCode ReachChoose(const ScenePair *spec, Level *level, const Support *support, const Facets *nonmortar,
                           const Facets *mortar, PetscReal *reach);

/* A wider reach where bodies overlap by more than it initially. User error: they do, and it was given. Collective.
   [in,out] reach - as it was chosen */
PetscErrorCode ReachWiden(const ScenePair *spec, const Level *level, const Facets *nonmortar, const Facets *mortar,
                          PetscReal *reach);

/* How far nodes of a side lie inside a body whose side they are to meet, where none of that is within reach: the largest distance from
   the partner's side. Collective. [in] side, partner - of this rank; [in] body - of the partner; [in,out] depth - grows if there are such
   nodes farther away; [in,out] at - where the farthest is [dim] */
PetscErrorCode InitialOverlapFind(const Level *level, const Facets *side, PetscInt body, const Facets *partner,
                                  PetscReal reach, PetscReal *depth, PetscReal at[]);

/* Takes fixed directions out of the normals of nodes that are free enough, before rays are sent along them: a symmetry plane
   then cuts the side where the mirror image would go on. Not collective. [in,out] normals - ghosted */
PetscErrorCode MultiplierStatusProjectNormals(const Level *level, const Support *support, Vec normals);

/* Decides by coverage and supports which nodes may keep a multiplier; takes fixed directions out of their normals. Not collective. */
PetscErrorCode MultiplierStatusDecide(const Level *level, const Support *support, PairAssembly *assembly);

/* Where several pairs would constrain nearly the same direction of a node, the first of them does, or the nearest if they stand
   one behind the other before the same facets; a tie constrains every
   direction. Rows then depend on those of earlier pairs only, never in a circle. A pair that is left without a node that it
   could have had is a user error. Collective. [in,out] assemblies - [num] */
PetscErrorCode MultiplierStatusResolve(const Level *level, PetscInt num, PairAssembly assemblies[]);

#endif
