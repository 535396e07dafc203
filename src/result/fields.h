/* fields.h -- displacement, stress, pressure, gap and status in the user's units. */
#ifndef MORTISE_FIELDS_H
#define MORTISE_FIELDS_H

#include "result/stress.h"
#include "solve/solver.h"

/* Status of a node for contact. */
typedef enum {
  STATUS_NONE    = -1,
  STATUS_OPEN    = 0,
  STATUS_CONTACT = 1, /* without friction, or where a support holds the node along the side */
  STATUS_TIED    = 2,
  STATUS_SLIP    = 3,
  STATUS_STICK   = 4
} ContactStatus;

/* Whether sides press on each other there, with or without friction. */
static inline PetscBool StatusIsContact(PetscInt status)
{
  return (PetscBool)(status == STATUS_CONTACT || status == STATUS_SLIP || status == STATUS_STICK);
}

/* lambda and slack are NULL where no pair has a multiplier. Arrays per row follow vi->row_pair and its
   companions. */
struct _n_Fields {
  VI          vi;        /* borrowed */
  Vec         u;         /* ghosted, dim per node */
  Vec         lambda;    /* per row of vi->B: pressure (contact) or traction (tied) */
  Vec         slack;     /* per row: nodal gap left, G/D - (B u)/D */
  NodalStress stress;    /* nodal average per body, and per region (eq. 8.2) */
  PetscReal  *stiffness; /* mean of K's diagonal over the components of each owned node [level->num_owned] */
  PetscReal *row_weight; /* integral of the row's dual function: D_aa and what removed neighbours gave [vi->num_rows] */
  PetscReal *row_moment; /* integral of the row's dual function times the position [vi->num_rows][dim] */
  PetscReal *row_noise;  /* roundoff of lambda in one row [vi->num_rows] */
  PetscInt  *row_status; /* ContactStatus: in contact = closed and pressed together [vi->num_rows] */
  PetscReal *body_max; /* max |u| of each body and those it is paired with, the same on all ranks [scene->num_bodies] */
  PetscReal  u_ref;    /* size of the displacements and gaps, the same on all ranks */
  PetscReal  p_ref;    /* size of the pressures, the same on all ranks */
  Solver     solver;   /* borrowed: of y, for linear problems with its active set; NULL where none is known */
  const SolverReport   *report;      /* borrowed, with solver */
  Vec                   y;           /* borrowed, with solver */
  struct _n_Validity   *validity;    /* NULL until ValidityWarn() or ValidityAdd() */
  struct _n_Estimate   *estimate;    /* NULL until EstimateGet() */
  struct _n_SideErrors *side_errors; /* of each pair; NULL until SideErrorsGet() */
};
typedef struct _n_Fields *Fields;

/* A computed force is known to about this part of the products that were summed up to it. A row of K u sums
   some tens of products of size K_ii |u|, each with an error of one unit roundoff. */
#define FIELDS_ROUNDOFF (64 * PETSC_MACHINE_EPSILON)

/* Recovers everything from y. Collective.
   [in] solvability - of vi, or NULL; [out] fields - owned by the caller */
PetscErrorCode FieldsCreate(VI vi, Solvability solvability, Vec y, Fields *fields);
PetscErrorCode FieldsDestroy(Fields *fields);
/* Collective.
   [out] strain - strain energy of each body, 1/2 int (eps - eps_0) : C (eps - eps_0) [num_bodies];
   [out] potential - their sum less the work of the forces */
PetscErrorCode FieldsEnergy(Fields fields, PetscReal strain[], PetscReal *potential);

/* What one pair does at the nodes this rank owns; arrays of shape [level->num_owned]. */
typedef struct {
  PetscReal *pressure; /* 0 off the nonmortar side; at removed nodes the mean of the neighbours that took over */
  PetscReal *gap;      /* left after the motion; NAN where there is no constraint */
  PetscReal *force;    /* normal force of the row, its pressure times its weight */
  PetscInt  *status;   /* ContactStatus */
  PetscBool *covered;  /* whether there is a pressure: the node's own, or that of neighbours that took over */
} PairFields;

/* Nodal values of pair p. Collective. [out] nodal - owned by the caller, PairFieldsDestroy() */
PetscErrorCode PairFieldsCreate(Fields fields, PetscInt p, PairFields *nodal);
/* Values at nodes with multipliers of a pair, for all of its side. Removed nodes get the mean of the
   neighbours that took over, nodes that hang those of the nodes that they hang on. Collective.
   [in,out] nodal, covered - [num_owned] */
PetscErrorCode PairFieldsSpread(const Pair pair, PetscReal nodal[], PetscBool covered[]);
/* Takes the pressure from nodes beyond the partner's end, for files and pictures. It is that of the covered
   sliver of a facet, which ends before the node. Not collective. */
void           PairFieldsOmitBeyond(const Pair pair, PairFields *nodal);
PetscErrorCode PairFieldsDestroy(PairFields *nodal);
/* What the nonmortar side of pair p gives to its partner per area: lambda_a n_a of contact, the traction of a
   tie. Open rows have none: their lambda is the residual of the solver, and gaps are large there. Collective.
   [in] row_status - ContactStatus [vi->num_rows]; [out] traction - ghosted, dim per node, zero off that side;
   owned by the caller */
PetscErrorCode PairTractionCreate(Fields fields, PetscInt p, const PetscInt row_status[], Vec *traction);

#endif
