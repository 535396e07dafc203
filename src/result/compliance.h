/* compliance.h -- C^-1 of materials, factored once where C is the same everywhere. */
#ifndef MORTISE_COMPLIANCE_H
#define MORTISE_COMPLIANCE_H

#include "result/cellstress.h"

enum { COMPLIANCE_MAX_STRAINS = 6 };

typedef struct {
  Scene      scene; /* borrowed */
  PetscInt   num;   /* strains of the model */
  PetscReal *L;     /* Cholesky factors, that of a point behind those of the materials [num_materials + 1][num][num] */
  PetscBool *known; /* whether a material's factor is there, for all points [num_materials] */
} Compliance;

/* Not collective. [out] compliance - to be freed by ComplianceDestroy() */
PetscErrorCode ComplianceCreate(Scene scene, Compliance *compliance);
PetscErrorCode ComplianceDestroy(Compliance *compliance);
/* The factor of C of a material at a point. Not collective. [out] L - borrowed until the next call */
PetscErrorCode ComplianceGet(Compliance *compliance, PetscInt material, const PetscReal x[], const PetscReal **L);
/* s : C^-1 : s. Not collective. [in] L - of ComplianceGet(); [in] stress - xx,yy,zz,yz,xz,xy */
PetscReal ComplianceEnergy(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES]);
/* s : C^-1 : r, of two stresses. Not collective. */
PetscReal ComplianceProduct(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES],
                            const PetscReal other[CELL_STRESSES]);
/* The largest component of C^-1 s. Not collective. [in] L - of ComplianceGet(); [in] stress -
   xx,yy,zz,yz,xz,xy */
PetscReal ComplianceStrain(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES]);
/* The dyad of a unit vector as a stress: xx,yy,zz,yz,xz,xy. Not collective. [in] n - [dim] */
void ComplianceDyad(PetscInt dim, const PetscReal n[], PetscReal dyad[CELL_STRESSES]);
/* E' = 1 / (nn : C^-1 : nn), the modulus along a unit vector. Not collective. [in] n - [dim] */
PetscErrorCode ComplianceModulus(Compliance *compliance, PetscInt material, const PetscReal x[], const PetscReal n[],
                                 PetscReal *modulus);

#endif
