/* shapefunction.h -- shape functions of the reference cells (private to the room; element.h has the order of their nodes). */
#ifndef MORTISE_SHAPEFUNCTION_H
#define MORTISE_SHAPEFUNCTION_H

#include <petscsys.h>

/* [in] xi - [dim]; [out] phi - [num_nodes]; [out] dphi - d phi_i / d xi_k, never NULL [num_nodes][dim] */
typedef void ShapeFn(const PetscReal xi[], PetscReal phi[], PetscReal dphi[]);

ShapeFn ShapeLine2, ShapeLine3, ShapeTri3, ShapeTri6, ShapeQuad4, ShapeQuad9, ShapeTet4, ShapeTet10, ShapeHex8,
    ShapeHex27;

#endif
