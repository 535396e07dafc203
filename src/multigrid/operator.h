/* operator.h -- the inequality of one level for multigrid: matrices, masks and node positions. */
#ifndef MORTISE_OPERATOR_H
#define MORTISE_OPERATOR_H

#include "multigrid/basisrows.h"

/* A coarse unknown is fixed if at most this part of the squares of its prolongation is free. */
#define OPERATOR_MIN_FREE 1e-2

/* min 1/2 y'A y - b'y, y <= upper, with A = M (T'K T / stiffness + W) M + 1 - M, M = 0 for fixed unknowns, 1
   for free ones. Objects are referenced; NULL where the comment says so. */
typedef struct {
  Mat       A;        /* SPD, a matrix or a shell */
  Vec       b, upper; /* NULL on a level made of nodes */
  Vec       W;        /* regularization: a diagonal, 0 where fixed; or NULL */
  Mat       K;        /* in blocks of dim: stiffness in displacements u = T y; rows, products, MatConvert() */
  Vec       diagonal; /* of K */
  PetscReal stiffness;
  Mat       S;       /* products with T'KT / stiffness, of a cycle: single precision will do */
  Mat       T;       /* NULL for the identity */
  BasisRows inverse; /* of T; 1 after HierarchyCreate() */
  Mat       Z;       /* (T'K T - K) / stiffness, few entries; NULL with T */
  Mat       waves;   /* y of waves: a second coarse space of a level with cells of order 1 (eq. 13.9); or NULL */
  PetscInt  num_fixed, *fixed;            /* fixed unknowns, counted from this rank's first; owned [num_fixed] */
  PetscInt num_constrained, *constrained; /* unknowns that are combinations of displacements; owned [num_constrained] */
  PetscBool       *tight;   /* nodes of cells that nearly keep their volume; NULL without; owned [nodes of this rank] */
  PetscReal        poisson; /* largest Poisson's ratio of such cells; 0 without */
  PetscBool        pointwise; /* whether the energy of some of them has their change of volume at every point */
  PetscBool        slips;     /* whether friction changes A, and not active unknowns alone */
  PetscInt         dim;       /* unknowns of a node, and coordinates */
  PetscInt         halvings;  /* of an edge from the next coarser level at most, where cells are bisected; else 0 */
  const PetscReal *coords; /* of this rank's nodes, then others'; borrowed [num][dim]; NULL on a level made of nodes */
} Operator;

/* Not collective.
   [in] A - AIJ, SPD: the matrix of a level made of nodes; referenced; [in] fixed - taken over [num_fixed];
   [out] op - to be released by OperatorDestroy() */
PetscErrorCode OperatorCreateOfMatrix(Mat A, PetscInt num_fixed, PetscInt fixed[], Operator *op);
PetscErrorCode OperatorDestroy(Operator *op);
/* What is solved from now on. Not collective. [in] A, b, upper, W - referenced; W or NULL */
PetscErrorCode OperatorSetInequality(Operator *op, Mat A, Vec b, Vec upper, Vec W);
/* M. Collective. [out] free - 1 for free unknowns, 0 for fixed ones; owned by the caller */
PetscErrorCode OperatorCreateFree(const Operator *op, Vec *free);
/* Marks fixed unknowns that are displacements: the row of T has no other entry. Not collective.
   [in,out] marked - true there, untouched elsewhere [unknowns of this rank] */
PetscErrorCode OperatorMarkFixedDisplacements(const Operator *op, PetscBool marked[]);

#endif
