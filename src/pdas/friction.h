/* friction.h -- friction at bounded unknowns, and the semismooth Newton method that solves with it
   (eq. 16.3).

   A node with friction has one bounded unknown y_n <= upper and one or two unknowns y_t along the sides. With
   the forces r = b - A y,
       0 <= r_n  _|_  upper - y_n >= 0,    |r_t| <= G,    r_t = G s / |s| where s != 0,
       s = y_t - origin,    G = bound + coefficient max(r_n, 0).
   bound alone is Tresca's friction, a convex problem; coefficient alone is Coulomb's. */
#ifndef MORTISE_FRICTION_H
#define MORTISE_FRICTION_H

#include <petscsnes.h>

enum { FRICTION_TANGENTS = 2 };

/* All nodes with friction of this rank, dimensionless like A. */
typedef struct {
  PetscInt   n;
  PetscInt  *normal;      /* global unknowns, ascending [n] */
  PetscInt  *tangent;     /* global unknowns, -1 where there is none [n][2] */
  PetscReal *coefficient; /* [n] */
  PetscReal *bound;       /* a force [n] */
  PetscReal *origin;      /* y_t without slip [n][2] */
  PetscReal *place;       /* a number of the node's place, whatever the order of unknowns [n] */
  PetscBool  held;        /* supports hold all bodies */
} FrictionLaw;

/* Results of the last solve. */
typedef struct {
  PetscInt  slipping, sticking; /* nodes */
  PetscReal rho;                /* spectral radius of G -> coefficient r_n(G) at slipping nodes (eq. 16.6) */
  PetscReal rho_error;          /* of its iteration, to first order */
  PetscBool others;    /* held bodies have other solutions: an odd number of its eigenvalues are real and above 1, or
                          one is found beside it */
  PetscBool beside;    /* the state without contact is a solution, too, or beside it there is one that jams */
  PetscInt  shortened; /* Newton steps that were shortened */
  PetscBool coarser;   /* rho is that of the coarser mesh */
  PetscReal coupling, turning; /* of friction with itself by pressures (eq. 16.8d); PETSC_MAX_REAL: no bound */
} FrictionReport;

/* Sets the friction law of the bounded unknowns of a SNES of type pdas. Its linear systems are dense: reduced
   to the unknowns with bounds or friction. Collective. [in] law - borrowed; NULL for none */
PetscErrorCode PDASSetFriction(SNES snes, const FrictionLaw *law);
/* Whether limits follow the pressure from one Tresca problem to the next, instead of within Newton's method.
   This second method converges where rho < 1. Collective. */
PetscErrorCode PDASSetFrictionFixedPoint(SNES snes, PetscBool fixed_point);
/* Residual of the law and of the systems, relative to the forces, that the next solves may leave, if others
   follow; not with the second method. 0 for that of a solution. Collective. */
PetscErrorCode PDASSetFrictionTolerance(SNES snes, PetscReal rtol);
/* What the next solve must do for rho. Not collective. [in] needed - whether it is wanted; default: yes;
   [in] coarser - results on the mesh whose states are the initial ones of that solve alone, NULL for none */
PetscErrorCode PDASSetFrictionRho(SNES snes, PetscBool needed, const FrictionReport *coarser);
/* Whether the next solves find the coupling, if their systems are dense; default: no. Collective. */
PetscErrorCode PDASSetFrictionCoupling(SNES snes, PetscBool needed);
/* Results of the last solve; zero without friction. Not collective, the same on all ranks. */
PetscErrorCode PDASGetFriction(SNES snes, FrictionReport *report);

#endif
