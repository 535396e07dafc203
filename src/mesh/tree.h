/* tree.h -- the cells of one body under bisection or splitting, with its smooth sides.

   Functions of a Tree are not collective. */
#ifndef MORTISE_TREE_H
#define MORTISE_TREE_H

#include "bodies/bodylist.h"
#include "kernel/bisect.h"
#include "kernel/dual.h"
#include "kernel/rise.h"

/* A vertex on a facet of the first list, where that belongs to a smooth side or to a side fixed along its
   normal. */
typedef struct {
  PetscInt  facet;        /* of the first list, by its first entry */
  PetscInt  edge;         /* of this facet, if the vertex is on one and the file is of second order; else -1 */
  PetscReal normal[3];    /* of the smooth side there */
  PetscReal curvature[9]; /* shape operator of the polynomial (4.1c); zero where there is none */
  PetscReal xi[2];        /* in the facet; in space */
} SideCorner;

/* The surface (4.5a) of a facet of the first list, of second order and not on arcs. New vertices are on
   it. */
typedef struct {
  PetscBool   any;
  ElementType type;
  PetscReal   X[3 * ELEMENT_MAX_FACET_NODES], rise[3 * RISE_TERMS];
} SidePatch;

/* The middle of an edge of the first list, on a facet of a smooth side, where a file of second order has a
   node. */
typedef struct {
  PetscInt  ends[2]; /* vertices */
  PetscBool arc;     /* whether refinement follows an arc */
  PetscReal normal[3];
} SideMiddle;

/* Smooth sides of a body from a file (eq. 4.5). The normals at two vertices determine the
   curve between them and the normal at its middle. So the position of a vertex does not depend on refinement
   elsewhere. */
typedef struct {
  PetscBool  any;
  PetscBool *round, *flat; /* what facets are, by their first entries [num_entries] */
  PetscReal (*plane)[3];   /* unit normals of flat ones [num_entries] */
  PetscInt    num_vertices, room;
  PetscInt   *start;   /* [num_vertices+1] */
  SideCorner *corner;  /* of each vertex [start[num_vertices]; room] */
  Quadric    *quadric; /* of each facet, by its first entry; NULL in the plane [num_entries] */
  SidePatch  *patch; /* of each facet, by its first entry; NULL but for a file of second order in space [num_entries] */
  SideMiddle *middle; /* of each facet's edges, by its first entry; NULL but for a file of second order
                         [num_entries][ELEMENT_MAX_FACET_NODES] */
} TreeArcs;

/* One body. */
typedef struct {
  Bisection mesh;
  BodyList  list; /* of the latest mesh: numbers of the bisection, vertices of cells in the sense of element.h */
  /* Sides of the facets of the first list. The number of a facet is its first entry; `another` is its next
     entry, or -1. */
  PetscInt  num_entries;
  PetscInt *side, *another; /* [num_entries] */
  TreeArcs  arcs;
  PetscBool reversed;                      /* whether the map turns most cells inside out */
  PetscInt (*before)[BISECT_MAX_VERTICES]; /* vertices of the mesh before, NULL for the first one */
  PetscInt num_before;                     /* its cells */
} Tree;

/* Whether its cells are split and keep their type. */
PetscBool TreeIsKept(const Tree *tree);

#endif
