/* calibration.h -- the error estimate in the scale of measured differences of energy. */
#ifndef MORTISE_CALIBRATION_H
#define MORTISE_CALIBRATION_H

#include "result/estimate.h"

/* Numbers by which consecutive meshes are compared. */
typedef struct {
  PetscReal squared;  /* eta^2 */
  PetscReal energy;   /* 2 J_h - L: its distance from the limit is |e|^2 */
  PetscReal signs;    /* L */
  PetscReal lost;     /* the part of L that changes of volume have */
  PetscReal supports; /* the part of moved supports */
} CalibrationMesh;

/* theta of the finest mesh (eq. 15.4): E = theta eta. theta^2 is a mean of those of all cells, weighted by
   eta_T^2. The theta_k of bisected cells has theta_k^2 = (energy_(k-1) - energy_k) / (eta_(k-1)^2 - eta_k^2).
   It is the median of the standard and of the latest two where eta^2 falls by 40 % of itself or more, in
   [0.5, 4]. L must not change by more than five times the fall of the energy. Its lost part, an estimate,
   must not by more than that fall; where there is one, that of supports must not be larger than this fall.
   A cell keeps that of the second mesh after the one that it was made on. What was removed tells nothing of
   cells that were never bisected: they have the standard. Not collective.
   [in] mesh - coarse first [num]; [in] estimate - of the finest */
PetscReal CalibrationFind(PetscInt num, const CalibrationMesh mesh[], const Estimate estimate);
/* theta of one mesh alone: how far recovery falls short in cells of its types, measured. theta^2 is the mean
   of theirs. Collective. [in] squared - weights: eta_T^2 [num_cells] */
PetscErrorCode CalibrationGetStandard(const Level *level, const PetscReal squared[], PetscReal *theta);
/* The same of straight cells of order 2. Not collective. */
PetscReal CalibrationOfStraight(PetscInt dim);

#endif
