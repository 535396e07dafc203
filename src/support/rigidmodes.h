/* rigidmodes.h -- the rigid body modes that supports leave to the components of bodies (eq. 12.1).

   A motion of a component is six numbers (t, r). It moves a point x by t + r x (x - c) / s, with c the centre
   of the component's box and s half its diagonal. In a plane t_z = r_x = r_y = 0; of a ring only t_y, along
   its axis, is rigid. */
#ifndef MORTISE_RIGIDMODES_H
#define MORTISE_RIGIDMODES_H

#include "support/components.h"
#include "support/support.h"

enum { RIGID_COMPONENTS = 6 };

typedef struct {
  PetscInt   num_bodies;
  Components components;
  PetscReal *frames;    /* c and s of each component [components.num][4] */
  PetscBool *loose;     /* components with a motion [components.num] */
  PetscBool *floating;  /* bodies with such a component [num_bodies] */
  PetscInt   num;       /* motions of all components */
  PetscInt  *component; /* whose each is, ascending [num] */
  PetscReal *mode;      /* orthonormal within a component [num][RIGID_COMPONENTS] */
} RigidModes;

/* The motions of each component without displacement in fixed directions. The same on all ranks.
   Collective. */
PetscErrorCode RigidModesCreate(Level *level, const Support *support, PetscInt num_bodies, RigidModes *modes);
PetscErrorCode RigidModesDestroy(RigidModes *modes);
/* Displacement of a point by a motion. Not collective.
   [in] frame - c and s; [in] x - [dim]; [out] u - [dim] */
void RigidModesAt(PetscInt dim, const PetscReal frame[], const PetscReal mode[], const PetscReal x[], PetscReal u[]);

#endif
