/* aggregate.h -- a coarser level made of a matrix alone, by smoothed aggregation; internal (floor 6; T38). */
#ifndef MORTISE_AGGREGATE_H
#define MORTISE_AGGREGATE_H

#include <mortise/compat.h>
#include <petscksp.h>

/* What is to be coarsened: a symmetric positive semidefinite matrix of nodes with bs unknowns each, and motions that it all but does not
   resist. */
typedef struct {
  Mat        A;        /* AIJ, borrowed */
  PetscInt   bs;       /* unknowns of a node */
  PetscInt   num;      /* motions */
  PetscReal *motion;   /* 0 where held [unknowns of this rank][num] */
  PetscBool *held;     /* unknowns that a coarser level must not move [unknowns of this rank] */
  PetscReal  stronger; /* a coupling counts from so much of the mean of both nodes' own stiffness on */
} Fabric;

PetscErrorCode FabricDestroy(Fabric *fabric);

/* P of the coarser level, whose nodes are aggregates of nodes of this rank, and whose unknowns are the motions of each; P times coarse->motion
   is fabric->motion, but for smoothing. Collective.
   [in] largest - eigenvalue of diag(A)^-1 A, at least; [out] P - owned by the caller; [out] coarse - all but A */
PetscErrorCode FabricCoarsen(const Fabric *fabric, PetscReal largest, Mat *P, Fabric *coarse);

#endif
