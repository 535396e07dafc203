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

/* Searches and integrates one pair. Collective.
   [in,out] pair - with its spec and level; [in,out] assembly - zero except for gap_only and displacement;
   then complete before MultiplierStatusResolve(); owned by the caller, PairAssemblyDestroy() */
PetscErrorCode PairAssemblyCreate(Scene scene, Level *level, const Support *support, Pair pair, PairAssembly *assembly);
/* Frees all data that the pair has not taken over. Collective. */
PetscErrorCode PairAssemblyDestroy(PairAssembly *assembly);
/* The level with displaced nodes. Rotates the normals of the nonmortar side's shape, and moves mortar facets
   and their normals. Curvatures and rises stay: displacements have the interpolation of the mesh.
   Collective.
   [in,out] assembly - its shape and own normals;
   [in,out] surface - or NULL; [out] moved - a copy of the level that borrows all arrays except its
   coordinates, DeformedLevelDestroy() */
PetscErrorCode DeformedLevelCreate(Level *level, PairAssembly *assembly, MortarSurface *surface, Level *moved);
PetscErrorCode DeformedLevelDestroy(Level *moved);

/* Chooses the reach: as given, or from the geometry. Collective. [in] mortar - NULL for an obstacle */
PetscErrorCode ReachChoose(const ScenePair *spec, Level *level, const Support *support, const Facets *nonmortar,
                           const Facets *mortar, PetscReal *reach);

/* Widens the reach where bodies initially overlap by more. User error: the reach was given by the user.
   Collective.
   [in,out] reach - of ReachChoose() */
PetscErrorCode ReachWiden(const ScenePair *spec, const Level *level, const Facets *nonmortar, const Facets *mortar,
                          PetscReal *reach);

/* The largest distance of nodes of a side from the partner's side. Only nodes inside the partner's body
   count, with no part of its side within reach. Collective.
   [in] side, partner - facets of this rank; [in] body - of the partner; [in,out] depth - increased if there
   is a node farther away; [in,out] at - position of that node [dim] */
PetscErrorCode InitialOverlapFind(const Level *level, const Facets *side, PetscInt body, const Facets *partner,
                                  PetscReal reach, PetscReal *depth, PetscReal at[]);

/* Removes fixed directions from the normals of nodes, before rays are sent along them. So rays at a plane of
   symmetry are those of the whole body. Nodes whose normal is nearly fixed keep it. Not collective.
   [in] oblique - nodes that keep it as well, of ObliqueHoldsFind(), or NULL;
   [in,out] normals - ghosted */
PetscErrorCode MultiplierStatusProjectNormals(const Level *level, const Support *support, const PetscBool oblique[],
                                              Vec normals);

/* Chooses the nodes that may keep a multiplier, by coverage and supports; removes fixed directions from their
   normals. Not collective. [in] oblique - nodes that have none, of ObliqueHoldsFind(), or NULL */
PetscErrorCode MultiplierStatusDecide(Level *level, const Support *support, const PetscBool oblique[],
                                      PairAssembly *assembly);

/* Resolves nodes of which several pairs would constrain nearly the same direction. The first of these pairs
   keeps the node, or the one with the nearest partner, if partners lie behind each other at the same facets.
   A tie constrains all directions. Rows then depend on those of earlier pairs only, without cycles. User
   error: a pair without any of its possible nodes. Collective.
   [in,out] assemblies - [num] */
PetscErrorCode MultiplierStatusResolve(const Level *level, PetscInt num, PairAssembly assemblies[]);

#endif
