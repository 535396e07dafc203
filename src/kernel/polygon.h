/* polygon.h -- convex polygons in a plane. */
#ifndef MORTISE_POLYGON_H
#define MORTISE_POLYGON_H

#include <petscsys.h>

enum { POLYGON_MAX_CORNERS = 4, POLYGON_MAX_VERTICES = 2 * POLYGON_MAX_CORNERS };

/* Parts of the nonmortar facet's size, and of its square: distances and areas of roundoff. */
#define POLYGON_SAME_POINT 1e-13
#define POLYGON_NO_AREA    1e-14

/* Twice the area would be the sum of the cross products; this is the area, positive for anticlockwise
   polygons.
   [in] P - [n][2] */
PetscReal PolygonArea(PetscInt n, const PetscReal P[]);

/* The common part of two convex polygons that run anticlockwise, by Sutherland and Hodgman; vertices closer
   than the tolerance, a length, are one. Returns the number of its vertices, 0 where less than a triangle is
   left.
   [in] A - [num_a][2], B - [num_b][2], up to POLYGON_MAX_CORNERS each; [out] P - [POLYGON_MAX_VERTICES][2] */
PetscInt PolygonIntersect(PetscInt num_a, const PetscReal A[], PetscInt num_b, const PetscReal B[], PetscReal tolerance,
                          PetscReal P[]);

#endif
