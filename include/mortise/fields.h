/* fields.h -- displacement, stress, pressure, gap and status: the answer in the user's units (floor 7). */
#ifndef MORTISE_FIELDS_H
#define MORTISE_FIELDS_H

#include <mortise/solve.h>

/* Status of a node for contact. */
typedef enum { STATUS_NONE = -1, STATUS_OPEN = 0, STATUS_CONTACT = 1, STATUS_TIED = 2 } ContactStatus;

struct _n_Fields {
  VI        vi;        /* borrowed */
  Vec       u;         /* ghosted, dim per node */
  Vec       lambda;    /* per row of vi->B: pressure (contact) or traction (tied) */
  Vec       slack;     /* per row: nodal gap left, G/D - (B u)/D */
  Vec       stress;    /* ghosted, 6 per node: xx,yy,zz,yz,xz,xy; volume-weighted nodal average per body */
};
typedef struct _n_Fields *Fields;

/* Recovers everything from y. Collective. [out] fields - owned by the caller */
PetscErrorCode FieldsCreate(VI vi, Vec y, Fields *fields);
PetscErrorCode FieldsDestroy(Fields *fields);

#endif
