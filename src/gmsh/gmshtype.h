/* gmshtype.h -- Gmsh's types of elements, by their numbers in its files. */
#ifndef MORTISE_GMSHTYPE_H
#define MORTISE_GMSHTYPE_H

#include "kernel/element.h"

/* A type of element of first or second order. */
typedef struct {
  PetscInt        dim, num_nodes;
  ElementType     cell;  /* ELEMENT_COUNT for those that are no cells here */
  const char     *name;  /* of several, for sentences */
  const PetscInt *place; /* node of the cell for each of Gmsh's [num_nodes]; NULL where the orders are the same */
} GmshType;

/* NULL for numbers of other types. Not collective. */
const GmshType *GmshTypeGet(PetscInt64 number);
/* The number of a type. Not collective. */
PetscInt GmshTypeNumber(const GmshType *type);

#endif
