/* gmshtype.c -- Gmsh's types of elements as a table (Gmsh reference manual, chapter "Node ordering").

   Lines, triangles and quadrangles have their nodes in the order of element.h. Gmsh numbers the edges of a
   hexahedron by their first vertex, and exchanges the edges of a tetrahedron from 1 and 2 to its top. */
#include "gmsh/gmshtype.h"

static const PetscInt TET10_ORDER[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const PetscInt HEX27_ORDER[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                                       18, 19, 12, 15, 13, 14, 20, 22, 25, 23, 24, 21, 26};

static const GmshType Types[] = {[1]  = {1, 2, ELEMENT_LINE2, "lines", NULL},
                                 [2]  = {2, 3, ELEMENT_TRI3, "triangles", NULL},
                                 [3]  = {2, 4, ELEMENT_QUAD4, "quadrangles", NULL},
                                 [4]  = {3, 4, ELEMENT_TET4, "tetrahedra", NULL},
                                 [5]  = {3, 8, ELEMENT_HEX8, "hexahedra", NULL},
                                 [6]  = {3, 6, ELEMENT_COUNT, "wedges", NULL},
                                 [7]  = {3, 5, ELEMENT_COUNT, "pyramids", NULL},
                                 [8]  = {1, 3, ELEMENT_LINE3, "lines", NULL},
                                 [9]  = {2, 6, ELEMENT_TRI6, "triangles", NULL},
                                 [10] = {2, 9, ELEMENT_QUAD9, "quadrangles", NULL},
                                 [11] = {3, 10, ELEMENT_TET10, "tetrahedra", TET10_ORDER},
                                 [12] = {3, 27, ELEMENT_HEX27, "hexahedra", HEX27_ORDER},
                                 [13] = {3, 18, ELEMENT_COUNT, "wedges", NULL},
                                 [14] = {3, 14, ELEMENT_COUNT, "pyramids", NULL},
                                 [15] = {0, 1, ELEMENT_COUNT, "points", NULL},
                                 [16] = {2, 8, ELEMENT_QUAD9, "quadrangles", NULL},
                                 [17] = {3, 20, ELEMENT_HEX27, "hexahedra", HEX27_ORDER},
                                 [18] = {3, 15, ELEMENT_COUNT, "wedges", NULL},
                                 [19] = {3, 13, ELEMENT_COUNT, "pyramids", NULL}};

const GmshType *GmshTypeGet(PetscInt64 number)
{
  return number >= 1 && number < (PetscInt64)(sizeof(Types) / sizeof(Types[0])) ? &Types[number] : NULL;
}

PetscInt GmshTypeNumber(const GmshType *type)
{
  return (PetscInt)(type - Types);
}
