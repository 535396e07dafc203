/* pairarms.h -- terms of ties' arms in rows (eqs. 5.4, 5.5), in any blocks. Nothing where an arm is NULL. */
#ifndef MORTISE_PAIRARMS_H
#define MORTISE_PAIRARMS_H

#include "problem/basischange.h"

/* Marks the nodes in the rows of a node. Not collective.
   [in] node - a global one; [in,out] marks - one of each node */
PetscErrorCode PairArmsMark(Mat arm, PetscInt dim, PetscInt node, Vec marks);
/* The number of nodes in the rows of a node, which may differ. Not collective. [in] node - a global one */
PetscErrorCode PairArmsCount(Mat arm, PetscInt dim, PetscInt node, PetscInt *num);
/* Adds -F_i arm to row r of B, in the user's units. Not collective. [in] row - the same, global */
PetscErrorCode PairArmsAddToB(VI vi, const NodeBases *bases, PetscInt r, PetscInt row);
/* Adds (1/D) F^-1_(.,i) (x) F_i arm for row r to E. Not collective.
   [in] arm - of the changed basis; [in] row - the first row of the node in E */
PetscErrorCode PairArmsAddToE(VI vi, const NodeBases *bases, Mat arm, PetscInt r, PetscInt row, Mat E);

#endif
