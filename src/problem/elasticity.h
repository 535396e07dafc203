/* elasticity.h -- stiffness K and load f of all bodies, before any boundary condition. */
#ifndef MORTISE_ELASTICITY_H
#define MORTISE_ELASTICITY_H

#include "kernel/dilatation.h"
#include "level/level.h"

/* C at a point (Hooke tensor, thickness not included) and Poisson's ratio (NAN where there is none).
   Not collective; expressions are checked by ElasticityAssemble().
   [in] material - index, level->cell_material; [out] C - [num_strains][num_strains] */
PetscErrorCode ElasticityHooke(Scene scene, PetscInt material, const PetscReal x[], PetscReal C[], PetscReal *poisson);

/* Whether a material's C is the same everywhere. Not collective. */
PetscBool ElasticityHookeIsConstant(Scene scene, PetscInt material);

/* The rules that the stiffness is integrated with. Not collective.
   [out] rules - of every type of cell [ELEMENT_COUNT]; PetscFree() it */
PetscErrorCode ElasticityRulesCreate(Scene scene, ElementRule **rules);

/* How cell c computes its change of volume, from the largest Poisson's ratio at the points of its rule. With
   DILATATION_LOCKS, ElasticityAssemble() raises a user error. Not collective.
   [out] poisson - that ratio, NAN where it does not matter: anisotropic bodies, plane stress */
PetscErrorCode ElasticityDilatationKind(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                        DilatationKind *kind, PetscReal *poisson);
/* Pi of cell c (eq. 9.1); num = 0 where theta is div u. Not collective. */
PetscErrorCode ElasticityDilatation(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                    Dilatation *dilatation);

/* Cells of a body by what they need, and the largest Poisson's ratio in those that are not
   DILATATION_POINTWISE, else 0. */
typedef struct {
  PetscInt  cells[DILATATION_LOCKS];
  PetscReal poisson;
} DilatationCount;

/* Order in h of the energy norm of the error of smooth solutions. It is that of the cells, but 1 for
   triangles of order 2 with one theta each. Collective. [out] order - [num_bodies], the same on all ranks */
PetscErrorCode ElasticityGetOrders(Scene scene, const Level *level, PetscInt order[]);

/* Collective. [out] counts - [num_bodies], the same on all ranks */
PetscErrorCode ElasticityDilatationCount(Scene scene, const Level *level, DilatationCount counts[]);

/* K = int B'CB,  f = int phi b + int_side phi t, times the thickness. In cells with a Dilatation, K is the
   second derivative of the energy with theta in place of div u. User errors: moduli that are not positive
   definite at some point; moduli with which cells lock. Collective.
   [out] K - StiffnessCreate(), owned by the caller; NULL for f alone;
   [out] f - ghosted, owned by the caller */
PetscErrorCode ElasticityAssemble(Scene scene, Level *level, Mat *K, Vec *f);

/* energy_b = (1/2) u'K u over the nodes of body b (K does not couple bodies). Collective.
   [in] u - ghosted; [out] energy - [num_bodies], the same on all ranks */
PetscErrorCode ElasticityBodyEnergy(Scene scene, Level *level, Mat K, Vec u, PetscReal energy[]);

#endif
