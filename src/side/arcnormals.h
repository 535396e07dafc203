/* arcnormals.h -- normals that a bisected level has at its nodes (level->arcs). Not collective. */
#ifndef MORTISE_ARCNORMALS_H
#define MORTISE_ARCNORMALS_H

#include "side/sideshape.h"

/* Whether two unit normals differ by more than roundoff. [in] a, b - [dim] */
PetscBool ArcNormalsDiffer(PetscInt dim, const PetscReal a[], const PetscReal b[]);

/* Gives corners of a side the normals of level->arcs, where these are known. [in,out] shape - with normals */
PetscErrorCode ArcNormalsTake(const Level *level, const Facets *facets, SideShape *shape);

#endif
