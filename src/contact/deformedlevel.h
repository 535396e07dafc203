/* deformedlevel.h -- the level in the deformed configuration. */
#ifndef MORTISE_DEFORMEDLEVEL_H
#define MORTISE_DEFORMEDLEVEL_H

#include "contact/mortarsurface.h"
#include "contact/pairassembly.h"

/* The level with displaced nodes. Rotates the normals of the nonmortar side's shape, and moves mortar facets
   and their normals. Curvatures and rises stay: displacements have the interpolation of the mesh.
   Collective.
   [in,out] assembly - its shape and own normals;
   [in,out] surface - or NULL; [out] moved - a copy of the level that borrows all arrays except its
   coordinates, DeformedLevelDestroy() */
PetscErrorCode DeformedLevelCreate(Level *level, PairAssembly *assembly, MortarSurface *surface, Level *moved);
PetscErrorCode DeformedLevelDestroy(Level *moved);

#endif
