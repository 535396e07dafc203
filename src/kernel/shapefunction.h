/* shapefunction.h -- shape functions of the reference cells (element.h has the order of their nodes). */
#ifndef MORTISE_SHAPEFUNCTION_H
#define MORTISE_SHAPEFUNCTION_H

#include <petscsys.h>

/* [in] xi - [dim]; [out] phi - [num_nodes]; [out] dphi - d phi_i / d xi_k, never NULL [num_nodes][dim] */
typedef void ShapeFn(const PetscReal xi[], PetscReal phi[], PetscReal dphi[]);

ShapeFn ShapeFunctionLine2, ShapeFunctionLine3, ShapeFunctionTri3, ShapeFunctionTri6, ShapeFunctionQuad4,
    ShapeFunctionQuad9, ShapeFunctionTet4, ShapeFunctionTet10, ShapeFunctionHex8, ShapeFunctionHex27;

#endif
