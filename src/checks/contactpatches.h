/* contactpatches.h -- the connected patches of a pair's contact area.

   Nodes in contact that share a facet of the nonmortar side belong to one patch. So do nodes on both sides of
   a node whose constraint was redistributed. A node stands for the part of its facets that is nearer to it
   than to their other nodes. Patches do not depend on the partition. */
#ifndef MORTISE_CONTACTPATCHES_H
#define MORTISE_CONTACTPATCHES_H

#include "result/fields.h"

/* The same on all ranks; NAN where a number does not exist. Units are the user's; in a plane those of the
   given thickness, axisymmetric ones of the whole ring. */
typedef struct {
  PetscInt  nodes;                  /* in contact */
  PetscReal area;                   /* where the pressure is positive: integral of the dual functions of these nodes */
  PetscReal normal_force, force[3]; /* integral of the pressure; what the mortar side exerts on the nonmortar body */
  PetscReal max_pressure, mean_pressure;
  PetscReal centre[3]; /* centroid of the area */
  PetscReal moment[3]; /* of the force about the centroid; in a plane the first is about z; NAN if axisymmetric */
  PetscReal extent[2], axis[2][3]; /* length along the principal axes of the area, the longer first; in a plane one */
  PetscReal width;  /* the shorter extent; of nearly circular patches that of the ellipse with the same second moments,
                      which turns with the scene */
  PetscReal across; /* the shorter extent; of a bent strip in space, such as a ring, its width */
  PetscBool bent;   /* whether it is such a strip */
  PetscReal facets; /* width: facets of the nonmortar side across */
  PetscReal facet_size; /* mean length of one of these facets */
} ContactPatch;

/* Patches of one pair, by falling normal force; equal ones by their centres. */
typedef struct {
  PetscInt      num;
  ContactPatch *patch; /* [num] */
  PetscInt *row_patch; /* of each row of vi->B, -1 of those that are not in contact or of other pairs [vi->num_rows] */
} ContactPatches;

/* None where nothing is in contact, and none of a tie. Collective. [out] patches - owned by the caller,
   ContactPatchesDestroy() */
PetscErrorCode ContactPatchesCreate(Fields fields, PetscInt p, ContactPatches *patches);
PetscErrorCode ContactPatchesDestroy(ContactPatches *patches);

#endif
