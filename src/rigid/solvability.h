/* solvability.h -- bodies that only contact can hold: whether a solution exists, and which motions stay free
   (eqs. 12.1-12.7).

   The columns z_k of Z are the rigid body modes that supports leave. Contact permits a motion Z q where C q
   <= 0, one row for each row of B; ties require C q = 0. phi = Z'f is the work of the loads on the modes. A
   solution exists exactly if phi.q <= 0 for all permitted q. By Farkas' lemma this holds exactly if phi = C'y
   with y >= 0: contact forces balance the loads. */
#ifndef MORTISE_SOLVABILITY_H
#define MORTISE_SOLVABILITY_H

#include "problem/vi.h"

typedef enum {
  SOLVABLE,          /* contact resists every rigid body mode */
  SOLVABLE_FREE,     /* some motions stay free, and the loads do no work on them */
  SOLVABLE_MARGINAL, /* some motion opens contacts at no cost: the pressure concentrates at an edge */
  SOLVABLE_NOT       /* the loads do work on a motion that nothing resists */
} SolvabilityStatus;

/* Motion of a body, or of a connected component of it: a point x moves by translation + rotation x (x -
   centre). */
typedef struct {
  PetscInt  body, piece;                 /* piece: of vi->rigid_modes.components */
  PetscBool whole;                       /* the body has one component */
  char      name[512];                   /* "lid", or "lid, piece 1 of 2 near (1.2, 0)" */
  PetscReal translation[3], rotation[3]; /* the translation is parallel to the rotation, unless that is zero */
  PetscReal centre[3]; /* point of the axis next to the component's centre; without rotation the centre */
  PetscReal work;      /* of the loads on this motion */
} BodyMotion;

/* The point where a row of B acts, and the components that it separates. */
typedef struct {
  PetscReal x[3];
  PetscInt  piece[2]; /* nonmortar, mortar; -1 for an obstacle */
} ContactPlace;

/* Constraints on rigid motions q: row.q <= 0, or row.q = 0 for ties. */
typedef struct {
  PetscInt      num;      /* on this rank */
  PetscReal    *rows;     /* [num][m] */
  PetscBool    *equality; /* rows of ties [num] */
  ContactPlace *place;    /* [num] */
} ContactRows;

/* One motion of several bodies, scaled so that the largest rotation is 1; without rotations the longest
   translation. */
typedef struct {
  PetscInt    num;
  BodyMotion *bodies;         /* bodies or their components that move [num] */
  PetscBool   turns;          /* there is a rotation */
  PetscBool   slides;         /* a contact neither opens nor stays where it is */
  PetscReal   work;           /* of the loads */
  char        sentence[2048]; /* "body lid tips about (1.2, 0), turning clockwise" */
} SceneMotion;

struct _n_Solvability {
  SolvabilityStatus status;
  PetscInt          m;     /* number of rigid body modes: vi->rigid_modes.num */
  Vec              *modes; /* T^-1 z_k [m] */
  ContactRows       nodal; /* C: rows of B, acting at their nodes; num = vi->num_rows */
  ContactRows
      overlap; /* the same, but at the overlap boundary instead of nodes beyond it; the same object without such nodes */
  ContactRows
      forces_at;    /* generators of all contact forces: overlap; with friction its cones at the nodes of their pairs */
  PetscBool cut;    /* some facet of a pair without friction is covered in part: overlap differs from nodal */
  PetscBool coarse; /* only nodes that end before the overlap boundary prevent balance: a finer mesh has a solution */
  /* with friction, else NULL: */
  PetscReal   *slide;        /* rows of tangents, which are zero in nodal [vi->num_rows] */
  PetscBool   *tangent;      /* rows of tangents [vi->num_rows] */
  ContactRows  friction;     /* generators of the cones of forces, which stand for the rows of nodal */
  PetscInt    *friction_row; /* of nodal, for each generator [friction.num] */
  PetscReal    part;         /* of the coefficients in friction */
  PetscReal   *work;         /* phi: of the loads on the modes, in the user's units [m] */
  PetscReal    forces;       /* sum of |f|, to which work is compared */
  PetscReal    undecided;    /* part of the forces that meshes of curved surfaces cannot decide; 0 for flat contact */
  PetscReal   *balance;      /* y: contact forces that balance the loads, nonzero in at most m rows [vi->num_rows] */
  PetscBool    slides;       /* motion is one that friction resists, too little or just enough */
  SceneMotion  motion;       /* that shows SOLVABLE_NOT or SOLVABLE_MARGINAL; num = 0 otherwise */
  PetscInt     num_free;
  SceneMotion *free;           /* basis of the free motions, after MinimumNormApply() [num_free] */
  SceneMotion  driven;         /* motion on which the loads do work in a state that is no solution, else num = 0 */
  PetscReal    slip;           /* largest change of a closed gap by MinimumNormApply() */
  Vec          start;          /* initial active set: 0 or 1 per unknown */
  Vec          regularization; /* diagonal added to A while solving, which makes it definite (eq. 12.6) */
  Vec          approach;       /* rigid motion until bodies touch; solvers count y from there */
};
typedef struct _n_Solvability *Solvability;

/* Decides whether contact can hold the rigid body modes that supports leave. Collective.
   [out] solvability - owned by the caller; NULL where supports leave no mode */
PetscErrorCode SolvabilityCreate(VI vi, Solvability *solvability);
PetscErrorCode SolvabilityDestroy(Solvability *solvability);
/* Decides anew for other loads and gaps of the same vi; nothing where there is no solvability. Collective. */
PetscErrorCode SolvabilityUpdate(VI vi, Solvability solvability);
/* After a failure: sets driven to the motion on which the loads do work with a little less friction, if there
   is one; nothing where there is no solvability. Collective. */
PetscErrorCode SolvabilityFindHardlyHeld(VI vi, Solvability solvability);

/* After bodies slid on and on: sets SOLVABLE_NOT and that motion, if contact takes less work on it than the
   loads do, under the pressures of this state and under all others (eq. 16.8a, 16.8e). With friction only.
   Collective.
   [in] friction - coupling and turning; [in] forces - of contact; [in] step - the last one of the
   proximal point iteration */
PetscErrorCode SolvabilityTestSliding(VI vi, Solvability solvability, const FrictionReport *friction, Vec forces,
                                      Vec step);

/* Whether a rigid motion of floating bodies changes all given gaps to zero, and no others. Collective.
   [in] gaps - of each pair, the same at all its nodes [vi->num_pairs]; [out] takes */
PetscErrorCode SolvabilityTakesGaps(VI vi, Solvability solvability, const PetscReal gaps[], PetscBool *takes);

/* Replaces a solution by that of least mean square displacement, among all that differ from it by free
   motions (eq. 12.7). Sets the free motions. Does nothing if solvability is NULL. Collective.
   [in,out] y - a solution */
PetscErrorCode MinimumNormApply(VI vi, Solvability solvability, Vec y);

/* A motion as numbers and as a sentence. Collective.
   [in] q - [m]; [out] motion - to be freed by SceneMotionDestroy() */
PetscErrorCode SceneMotionCreate(VI vi, Solvability solvability, const PetscReal q[], SceneMotion *motion);
PetscErrorCode SceneMotionDestroy(SceneMotion *motion);
/* Displacement of a point of the body. [in] x - [dim]; [out] u - [dim] */
void SceneMotionAt(const BodyMotion *motion, PetscInt dim, const PetscReal x[], PetscReal u[]);

#endif
