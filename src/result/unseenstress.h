/* unseenstress.h -- the part of stresses that their averages at nodes cannot show. */
#ifndef MORTISE_UNSEENSTRESS_H
#define MORTISE_UNSEENSTRESS_H

#include "result/compliance.h"
#include "result/fields.h"

/* int_T q : C^-1 : q of straight cells of order 2. In triangles and tetrahedra q is the recovered stress by
   its second derivatives, less the linear functions that are nearest. In others it is that of
   UnseenCubicEnergy(), over the standard calibration. Collective.
   [in] rules - of the types of cells [ELEMENT_COUNT]; [in] volume - of this rank's cells [num_cells];
   [in,out] cell - eta^2 of this rank's cells: where q is larger, that [num_cells] */
PetscErrorCode UnseenStressTake(Fields fields, const ElementRule rules[], Compliance *compliance,
                                const PetscReal volume[], PetscReal cell[]);

#endif
