/* estimate.h -- estimate of the error of a discrete solution in energy. */
#ifndef MORTISE_ESTIMATE_H
#define MORTISE_ESTIMATE_H

#include "result/fields.h"
#include "result/largest.h"

/* eta^2 = sum_T int_T (s* - s) : C^-1 : (s* - s) + (2/pi) h/E' int_e |s* n + lambda|^2 + pi E* / h int_e d^2
   (eq. 15.3), and the oscillation of formulas in space (OscillationAdd()), and the energy between facets and
   their curves (GeometryAdd()). s* is the recovered stress, s that of the displacement. The second term is
   over both sides of each pair. d is the penetration, or the least of opening and lambda h / (pi E*).
   The squares of a pair belong to the cell behind the facet; those of the gap to the nonmortar one. Cells are
   marked with lambda in the second term, and eta^2 has the traction nearest to both sides' in its place: a
   pressure that alternates from node to node costs no energy, and is to be refined nevertheless. */
struct _n_Estimate {
  PetscReal *cell;     /* eta_T^2 of this rank's cells, with lambda [num_cells] */
  PetscReal *volume;   /* of this rank's cells, with the thickness or the ring [num_cells] */
  PetscReal *body;     /* sums over the cells of each body, the same on all ranks [num_bodies] */
  PetscReal  squared;  /* eta^2: their sum, less what lambda adds to it */
  PetscReal  geometry; /* the part of GeometryAdd(): it needs no calibration */
  PetscReal  standard; /* theta of this mesh alone */
  PetscReal *aged;     /* parts of the rest: cells of each Level.cell_age; the same on all ranks [MESH_MAX_ADAPTED] */
  PetscReal  signs;    /* L = -2 int lambda . d - 2 int W s + supports + lost:  2 (J_h - J) = |e|^2 + L */
  PetscReal  lost; /* -2 int p* (div u - theta) with the mean stress p*: what u changes its volume by beside theta */
  PetscReal  supports;  /* -2 int s* n . (u_D - u): the work of moved supports on what u misses of them */
  PetscReal  norm;      /* |u|_a^2: twice the strain energy */
  PetscReal  potential; /* J_h */
  Largest  *hidden; /* depth of the partner in facets without pressure, 0 for none; the same on all ranks [num_pairs] */
  PetscBool missed; /* whether a pair has such a place: where no body is deformed, all of the solution is missing */
};
typedef struct _n_Estimate *Estimate;

/* Measured once for each solution. Collective. [out] estimate - borrowed from the fields */
PetscErrorCode EstimateGet(Fields fields, Estimate *estimate);
/* A linear problem with the active set of a solution: active nodes are moved by given amounts. */
typedef struct {
  Fields solution;                                                 /* whose active nodes they are */
  PetscReal (*motion)(void *ctx, PetscInt p, const PetscReal x[]); /* along the normal of pair p at x [dim] */
  void *ctx;
} EstimateFrozen;

/* The same of the solution of such a problem: d is what sides in contact miss the given motion by; L, |u|_a
   and J are not set. Collective.
   [in] fields - vi, u, stress and lambda are used; [out] estimate - to be freed by EstimateDestroy() */
PetscErrorCode EstimateCreateFrozen(Fields fields, const EstimateFrozen *frozen, Estimate *estimate);
/* The error in the energy norm with a calibration theta (eq. 15.4), and that over the norm of the solution.
   It is 1 where contact was missed and there is none, 0 where there is none to be had. Not collective. */
PetscReal EstimateGetError(const Estimate estimate, PetscReal theta);
PetscReal EstimateGetRelative(const Estimate estimate, PetscReal theta);
/* At nodes: the root of eta^2 per volume of the cells around. Collective. [out] density - owned by the caller
   [num_owned] */
PetscErrorCode EstimateCreateDensity(Fields fields, PetscReal **density);
/* Whether there is one or not. Not collective. */
PetscErrorCode EstimateDestroy(Estimate *estimate);

#endif
