/* rigid.h -- the rigid motions that supports leave to bodies (floor 5; T25).

   A motion of a body is written as six numbers (t, r): it moves a point x by t + r x (x - c) / s, with c the centre of the
   body's box and s half its diagonal. In a plane t_z = r_x = r_y = 0; of a ring only t_y, along its axis, is rigid. */
#ifndef MORTISE_RIGID_H
#define MORTISE_RIGID_H

#include <mortise/support.h>

enum { RIGID_COMPONENTS = 6 };

typedef struct {
  PetscInt   num_bodies;
  PetscReal *frames;   /* c and s of each body [num_bodies][4] */
  PetscBool *floating; /* bodies with a motion [num_bodies] */
  PetscInt   num;      /* motions of all bodies */
  PetscInt  *body;     /* whose each is, ascending [num] */
  PetscReal *motion;   /* orthonormal within a body [num][RIGID_COMPONENTS] */
} RigidMotions;

/* The motions of each body that leave its held directions alone. The same on all ranks. Collective. */
PetscErrorCode RigidMotionsCreate(const Level *level, const Support *support, PetscInt num_bodies,
                                  RigidMotions *motions);
PetscErrorCode RigidMotionsDestroy(RigidMotions *motions);
/* Where a motion takes a point. [in] frame - c and s; [in] x - [dim]; [out] u - [dim] */
void RigidMotionAt(PetscInt dim, const PetscReal frame[], const PetscReal motion[], const PetscReal x[], PetscReal u[]);

#endif
