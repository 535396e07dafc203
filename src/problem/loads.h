/* loads.h -- body forces, tractions and pressures as nodal loads. */
#ifndef MORTISE_LOADS_H
#define MORTISE_LOADS_H

#include "mesh/mesh.h"

/* f_i = int phi_i b + int_side phi_i t - int_side phi_i p nu, times the thickness. Collective. [in,out] f - ghosted, shared */
PetscErrorCode LoadsAssemble(Scene scene, Level *level, Vec f);

#endif
