/* eigenstrain.h -- strains that a body has without stress: of temperature, and others. */
#ifndef MORTISE_EIGENSTRAIN_H
#define MORTISE_EIGENSTRAIN_H

#include "problem/elasticity.h"

/* eps_0 at a point, so that sigma = C (eps - eps_0) with the C of the model (eq. 8.6). */
typedef struct {
  PetscReal
      strain[6]; /* the components of the model; in plane strain with what eps_0,zz does in the plane [num_strains] */
  PetscReal
      across; /* in plane strain: E eps_0,zz, by which sigma_zz is less than nu (sigma_xx + sigma_yy); 0 in other models */
  PetscReal across_energy; /* E eps_0,zz^2, energy per volume, twice, that no displacement changes */
} Eigenstrain;

/* Zero for materials that have none. Not collective; expressions are checked by EigenstrainCheck().
   [in] material - index, level->cell_material; [in] C, poisson - of ElasticityHooke() */
PetscErrorCode EigenstrainEvaluate(Scene scene, PetscInt material, const PetscReal x[], const PetscReal C[],
                                   PetscReal poisson, Eigenstrain *e);
/* theta_0 = Pi tr eps_0 of cell c (eq. 9.1): its part along each function of Pi. Not collective.
   [in] rule - of the stiffness;
   [out] parts - [pi->num] */
PetscErrorCode EigenstrainDilatation(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                     const Dilatation *pi, PetscReal parts[]);

/* f += int B' C eps_0 over the cells of this rank, with the rule of the stiffness. If eps_0 is the strain of
   a discrete displacement, f is K times that displacement. Not collective. [in,out] fa - [num_nodes][dim] */
PetscErrorCode EigenstrainAddLoads(Scene scene, Level *level, PetscScalar fa[]);
/* The same for eps_0 = -1/2 H'H with H = grad u: by these loads bodies yield to the neglected part of Green's
   strain (eq. 11.5a). In plane strain nothing is neglected along z. Not collective.
   [in] u - ghosted; [in,out] fa - [num_nodes][dim] */
PetscErrorCode EigenstrainAddNeglected(Scene scene, Level *level, Vec u, PetscScalar fa[]);
/* Raises a user error where a datum was not finite. Collective. */
PetscErrorCode EigenstrainCheck(Scene scene, Level *level);

/* Replaces the energies of bodies that have strains without stress by 1/2 int (eps - eps_0) : C (eps -
   eps_0). Collective.
   [in] u - ghosted;
   [in,out] energy - 1/2 u'K u on entry [num_bodies]; [out] constant - sum of 1/2 int eps_0 : C eps_0 */
PetscErrorCode EigenstrainEnergy(Scene scene, Level *level, Vec u, PetscReal energy[], PetscReal *constant);

/* The mean axial force of a body with pretension, (1/L) int sigma : a a' over it, L its extent along the axis
   a (eq. 8.7), and its decrease per strain along the axis at fixed displacements. Collective.
   [in] u - ghosted */
PetscErrorCode EigenstrainAxialForce(Scene scene, Level *level, PetscInt body, Vec u, PetscReal *force,
                                     PetscReal *stiffness);

#endif
