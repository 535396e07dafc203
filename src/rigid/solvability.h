/* solvability.h -- bodies that only contact can hold: is there a solution, and which motions are left (eqs. 12.1-12.7).

   The columns z_k of Z are the rigid motions that supports leave. Contact takes from a motion q the direction C q <= 0, one row for
   each row of B, ties C q = 0. With phi = Z'f the loads' work on them, a solution exists exactly if phi.q <= 0 for all q that contact
   permits, and by Farkas' lemma exactly if phi = C'y with y >= 0: contact forces that balance the loads. */
#ifndef MORTISE_SOLVABILITY_H
#define MORTISE_SOLVABILITY_H

#include "problem/vi.h"

typedef enum {
  SOLVABLE,          /* and every rigid motion is resisted */
  SOLVABLE_FREE,     /* up to motions that nothing resists and no load asks for */
  SOLVABLE_MARGINAL, /* some motion that opens contacts costs nothing: the pressure gathers at an edge */
  SOLVABLE_NOT       /* the loads do work on a motion that nothing resists */
} SolvabilityStatus;

/* A point x of a body, or of a piece of it, moves by translation + rotation x (x - centre). */
typedef struct {
  PetscInt  body, piece;                 /* of vi->rigid_modes.components */
  PetscBool whole;                       /* the body is of one piece */
  char      name[512];                   /* "lid", or "lid, piece 1 of 2 near (1.2, 0)" */
  PetscReal translation[3], rotation[3]; /* the translation is along the axis of the rotation where there is one */
  PetscReal centre[3];                   /* the point of the axis next to the body's centre, or that itself */
  PetscReal work;                        /* of the loads on it */
} BodyMotion;

/* Where a row of B acts, and which pieces it keeps apart. */
typedef struct {
  PetscReal x[3];
  PetscInt  piece[2]; /* nonmortar, mortar; -1 for an obstacle */
} ContactPlace;

/* What contact takes from rigid motions q: row.q <= 0, or 0. */
typedef struct {
  PetscInt      num;   /* on this rank */
  PetscReal    *rows;  /* [num][m] */
  PetscBool    *both;  /* rows of ties [num] */
  ContactPlace *place; /* [num] */
} ContactRows;

/* Bodies that move together, scaled so that the largest rotation is 1, or the longest translation if there is none. */
typedef struct {
  PetscInt    num;
  BodyMotion *bodies; /* or their pieces [num] */
  PetscBool   turns;
  PetscReal   work;           /* of the loads on all of them */
  char        sentence[2048]; /* what moves and how, "body lid tips about (1.2, 0), turning clockwise" */
} SceneMotion;

struct _n_Solvability {
  SolvabilityStatus verdict;
  PetscInt          m;     /* rigid motions of all pieces of bodies: vi->rigid_modes.num */
  Vec              *modes; /* T^-1 z_k [m] */
  PetscReal        *C;     /* [vi->num_rows][m] */
  PetscBool        *both;  /* rows of ties [vi->num_rows] */
  ContactPlace     *place; /* [vi->num_rows] */
  ContactRows cover;   /* the same, but up to where partners end instead of nodes beyond it; no other where none does */
  PetscBool   cut;     /* there is such a place */
  PetscBool   coarse;  /* contact could balance the loads, but for nodes that end before their partner */
  PetscReal  *phi;     /* work of the loads, in the user's units [m] */
  PetscReal   forces;  /* sum of |f|: what phi is small against */
  PetscReal undecided; /* the part of them that meshes of round surfaces do not decide about; 0 where contact is flat */
  PetscReal   *y;      /* forces that balance the loads, nonzero in at most m rows [vi->num_rows] */
  SceneMotion  motion; /* why not, or what costs nothing; num = 0 with other verdicts */
  PetscInt     num_free;
  SceneMotion *free;    /* after MinimumNormApply(): a basis of the motions that are free [num_free] */
  PetscReal    slip;    /* and the most that moving along them has changed a gap that is closed */
  Vec          start;   /* 0/1 per unknown: contacts to begin with */
  Vec          springs; /* what makes A definite, added to its diagonal while solving (eq. 12.6) */
  Vec          rest;    /* a rigid motion of bodies until they touch, from which solvers count y */
};
typedef struct _n_Solvability *Solvability;

/* Whether contact can hold the rigid motions that supports leave. Collective. [out] solvability - owned by the caller; NULL where
   supports leave no rigid motion */
PetscErrorCode SolvabilityCreate(VI vi, Solvability *solvability);
PetscErrorCode SolvabilityDestroy(Solvability *solvability);

/* Of all solutions that differ from y by free motions, the one that moves least: the mean square displacement of the bodies
   that move freely is smallest (eq. 12.7). Fills in which motions are free. Nothing without rigid motions. Collective.
   [in,out] y - a solution */
PetscErrorCode MinimumNormApply(VI vi, Solvability solvability, Vec y);

/* A motion of all bodies in words and numbers. Collective. [in] q - [m]; [out] motion - to be freed by SceneMotionDestroy() */
PetscErrorCode SceneMotionCreate(VI vi, Solvability solvability, const PetscReal q[], SceneMotion *motion);
PetscErrorCode SceneMotionDestroy(SceneMotion *motion);
/* Where it takes a point of the body. [in] x - [dim]; [out] u - [dim] */
void BodyMotionAt(const BodyMotion *motion, PetscInt dim, const PetscReal x[], PetscReal u[]);

#endif
