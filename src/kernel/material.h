/* material.h -- Hooke's law. Voigt order xx,yy,zz,yz,xz,xy with engineering shear; in a plane xx,yy,xy.
   Axisymmetric models have x along the radius and y along the axis; zz is around it: xx,yy,zz,xy. */
#ifndef MORTISE_MATERIAL_H
#define MORTISE_MATERIAL_H

#include <petscsys.h>

typedef enum { MODEL_PLANE_STRAIN, MODEL_PLANE_STRESS, MODEL_AXISYMMETRIC, MODEL_SOLID } ModelKind;

/* From this Poisson's ratio on, in all models but plane stress, displacements alone do not determine the
   pressure. */
#define MATERIAL_POISSON_END 0.4999995

/* Number of strains the model carries: 3 in a plane, 4 axisymmetric, 6 in 3D. */
PetscInt MaterialNumStrains(ModelKind model);

/* C of an isotropic body. [out] C - row-major [num_strains][num_strains] */
void MaterialIsotropic(ModelKind model, PetscReal young, PetscReal poisson, PetscReal C[]);

/* C from the upper triangle row by row: 6 numbers in a plane, 10 axisymmetric, 21 in 3D. Rotated by angle
   degrees: about z, in 3D by three intrinsic z-x-z angles. Not collective.
   [in] upper - [num_strains*(num_strains+1)/2]; [in] angle - [3] in 3D, else [1] */
void MaterialAnisotropic(ModelKind model, const PetscReal upper[], const PetscReal angle[], PetscReal C[]);

/* Smallest eigenvalue of C over the largest: <= 0 for an indefinite or singular Hooke tensor. */
PetscReal MaterialDefiniteness(PetscInt num_strains, const PetscReal C[]);

/* The strain along the material's axes with these three direct components (plane and axisymmetric: third
   across the plane), as six components xx,yy,zz,yz,xz,xy, turned like MaterialAnisotropic().
   [in] axial - [3] */
void MaterialAxialStrain(ModelKind model, const PetscReal axial[], const PetscReal angle[], PetscReal strain[6]);
/* The components of a model among all six. Not collective. [out] strain - [num_strains] */
void MaterialPickStrains(ModelKind model, const PetscReal all[6], PetscReal strain[]);

/* sigma = C eps as six components xx,yy,zz,yz,xz,xy. zz in plane strain is nu (xx + yy) of an isotropic body
   (poisson), 0 in plane stress. It is NAN where a plane Hooke tensor does not determine it (pass poisson =
   NAN). Not collective. [in] strain - [num_strains] */
void MaterialStress(ModelKind model, const PetscReal C[], PetscReal poisson, const PetscReal strain[],
                    PetscReal stress[6]);

/* Removes the bulk modulus from an isotropic C of any model but plane stress. C becomes that of 2 mu dev eps,
   with the deviator of three dimensions. Returns the bulk modulus. Not collective.
   [in,out] C - [num_strains][num_strains] */
PetscReal MaterialTakeBulk(PetscInt num_strains, PetscReal C[]);
/* Trace of a strain; eps_zz of a plane is 0. [in] strain - [num_strains] */
PetscReal MaterialDilatation(PetscInt num_strains, const PetscReal strain[]);

PetscReal MaterialVonMises(const PetscReal stress[6]);
/* eps : C eps, twice the energy per volume. Not collective.
   [in] C - [num_strains][num_strains]; [in] strain - [num_strains] */
PetscReal MaterialEnergyDensity(PetscInt num_strains, const PetscReal C[], const PetscReal strain[]);

/* Principal stresses, the largest first; NAN, all three, where a component is not known. */
void MaterialPrincipal(const PetscReal stress[6], PetscReal principal[3]);

/* Modulus against flat indentation, E/(1-nu^2), but E in plane stress. Of an anisotropic C it is that of the
   softest axis, in space with one direction across it held. Used to choose roles and scales. */
PetscReal MaterialContactModulus(PetscInt num_strains, const PetscReal C[]);

#endif
