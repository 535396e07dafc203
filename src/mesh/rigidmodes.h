/* rigidmodes.h -- the rigid motions that supports leave to the pieces of bodies (eq. 12.1).

   A motion of a piece is written as six numbers (t, r): it moves a point x by t + r x (x - c) / s, with c the centre of the
   piece's box and s half its diagonal. In a plane t_z = r_x = r_y = 0; of a ring only t_y, along its axis, is rigid. */
#ifndef MORTISE_RIGIDMODES_H
#define MORTISE_RIGIDMODES_H

#include "mesh/components.h"
#include "mesh/support.h"

enum { RIGID_COMPONENTS = 6 };

typedef struct {
  PetscInt   num_bodies;
  Pieces     pieces;
  PetscReal *frames;   /* c and s of each piece [pieces.num][4] */
  PetscBool *loose;    /* pieces with a motion [pieces.num] */
  PetscBool *floating; /* bodies with such a piece [num_bodies] */
  PetscInt   num;      /* motions of all pieces */
  PetscInt  *piece;    /* whose each is, ascending [num] */
  PetscReal *mode;     /* orthonormal within a piece [num][RIGID_COMPONENTS] */
} RigidModes;

/* The motions of each piece that leave its held directions alone. The same on all ranks. Collective. */
PetscErrorCode RigidModesCreate(Level *level, const Support *support, PetscInt num_bodies, RigidModes *modes);
PetscErrorCode RigidModesDestroy(RigidModes *modes);
/* Where a motion takes a point. [in] frame - c and s; [in] x - [dim]; [out] u - [dim] */
void RigidModesAt(PetscInt dim, const PetscReal frame[], const PetscReal mode[], const PetscReal x[], PetscReal u[]);

#endif
