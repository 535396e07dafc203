/* dilatation.h -- the change of volume in cells of nearly incompressible bodies.

   A cell whose displacements keep the volume at every point has almost no freedom left: it locks. Where a
   body resists changes of volume much more than changes of shape, the energy of volume changes is computed
   from

       theta = Pi div u                                                        (eq. 9.1)

   where Pi is the L2 projection onto a small space Q of each cell: constants, or linear functions. The other
   energy, of the deviator, stays as it is. Q has no unknowns: theta is a sum over the cell's own
   displacements. */
#ifndef MORTISE_DILATATION_H
#define MORTISE_DILATATION_H

#include "kernel/element.h"

typedef enum {
  DILATATION_POINTWISE, /* theta = div u */
  DILATATION_MEAN,      /* Q = {1} */
  DILATATION_LINEAR,    /* Q = {1, x, y (, z)} */
  DILATATION_LOCKS      /* no stable space: the cell is not fit for such a body */
} DilatationKind;

enum { DILATATION_MAX_FUNCTIONS = 4, DILATATION_MAX_DOFS = 3 * ELEMENT_MAX_NODES };

/* The space Q for cells of a type in an isotropic body. Not collective.
   [in] poisson - NAN for plane stress, where the thickness is free, and for anisotropic bodies */
DilatationKind DilatationChoose(ElementType type, PetscReal poisson);
/* The Poisson's ratio above which this is not DILATATION_POINTWISE. Not collective. */
PetscReal DilatationThreshold(ElementType type);

/* Pi of one cell: theta = sum_a q_a(x) rows_a . u, with q_a an orthonormal basis of Q and rows_a = int q_a
   div. */
typedef struct {
  PetscInt  num, dim, num_dofs; /* num = 0 for theta = div u: no space is needed, or none is stable */
  PetscReal origin[3], size;    /* of the cell: q are functions of (x - origin) / size */
  PetscReal
      L[DILATATION_MAX_FUNCTIONS * DILATATION_MAX_FUNCTIONS]; /* Cholesky's factor of int of (1, x, ..) (1, x, ..)' */
  PetscReal rows[DILATATION_MAX_FUNCTIONS * DILATATION_MAX_DOFS]; /* [num][num_dofs] */
} Dilatation;

/* Pi from the points of the cell's own stiffness, so that both have the same integrals. Not collective.
   [in] rule - of the stiffness;
   [in] x - [rule->num][dim];
   [in] w - weights with det J and the measure [rule->num]; [in] div - div of each unit displacement
   [rule->num][num_dofs] */
void DilatationSet(DilatationKind kind, const ElementRule *rule, const PetscReal x[], const PetscReal w[],
                   const PetscReal div[], Dilatation *dilatation);

/* q_a(x). [in] x - [dim]; [out] q - [num] */
void DilatationShape(const Dilatation *dilatation, const PetscReal x[], PetscReal q[]);

/* Ke_ij += int bulk theta_i theta_j for i <= j.
   [in] x - [num_points][dim]; [in] bulk - bulk modulus times weight [num_points]; [in,out] Ke -
   [num_dofs][num_dofs] */
void DilatationStiffness(const Dilatation *dilatation, PetscInt num_points, const PetscReal x[], const PetscReal bulk[],
                         PetscReal Ke[]);

/* theta(x); num must not be 0. [in] x - [dim]; [in] u - [num_dofs] */
PetscReal DilatationEvaluate(const Dilatation *dilatation, const PetscReal x[], const PetscReal u[]);

#endif
