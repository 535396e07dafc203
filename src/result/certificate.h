/* certificate.h -- residuals of the uncondensed KKT system, never of the condensed one (eq. 11.1). */
#ifndef MORTISE_CERTIFICATE_H
#define MORTISE_CERTIFICATE_H

#include "result/fields.h"
#include "result/frictionfields.h"

/* All dimensionless; the same on all ranks. NAN where the answer holds numbers that are not finite. */
typedef struct {
  PetscReal rounding;        /* roundoff of K u over the size of the forces (eq. 11.1a); limit 1e-6 */
  PetscReal equilibrium;     /* |f - K u - B'lambda| on free directions over the size of the forces */
  PetscReal gap;             /* max (B u - G)_+ / D over u.Ku / sum |forces|, at most u_ref; also ties, supports */
  PetscReal pressure;        /* max (-lambda)_+ over p_ref */
  PetscReal complementarity; /* sum D lambda |slack| over the work of the loads */
  PetscReal force,
      moment; /* balance of loads, reactions and obstacles of the whole scene, over the sum of their sizes */
  PetscReal        pair_moment; /* part of moment: of contact forces (not ties) on curved sides with a gap */
  PetscReal        pull; /* sum of contact forces (pressure times the row's weight) that pull, over the sum of all */
  FrictionResidual friction;    /* 0 without friction */
  PetscInt         weightless;  /* rows of contact that weigh nothing or less: there must be none */
  PetscReal        energy_norm; /* |u|_K = (u'Ku)^(1/2), in the user's units: reference of the error bound; no test */
  PetscReal        limit;       /* limit of all those above except rounding and pair_moment */
  PetscBool        holds;
  char             failure[256]; /* which test failed, by how much, what to try; "" where it holds */
} Certificate;

/* Collective. [out] reactions - ghosted Vec of dim per node: what the supports exert, owned by the caller */
PetscErrorCode CertificateCompute(Fields fields, Certificate *certificate, Vec *reactions);

/* An error in the norm of energy over |u|_K: NAN where one of them is not known, or there is no energy. Not
   collective. */
PetscReal CertificateRelative(const Certificate *certificate, PetscReal error);

#endif
