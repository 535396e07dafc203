/* bodylist.h -- a body as plain lists: cells, nodes, and facets of the sides that the scene uses.

   A body begins as plain lists on the first rank, from a box or from a file. All lists are merged into one
   DMPlex (bodymerge.h). Functions of this module are not collective unless they say so. */
#ifndef MORTISE_BODYLIST_H
#define MORTISE_BODYLIST_H

#include "level/level.h"

enum { MESH_SENTENCE = 1024 }; /* length of the sentence of a user error */

/* Connected sets of cells that touch and are not joined. */
typedef struct {
  PetscInt  num_pieces; /* components of the body: connected sets of cells; 0 for a box, which is not searched */
  PetscInt  num_nodes, num_facets; /* that coincide with a node, that lie on a facet of another component */
  PetscReal at[3];                 /* the first of them, before the map */
} UnjoinedPieces;

/* Cells, positions and the facets of the sides that the scene uses. Nodes are the vertices, then the middle
   nodes of cells of order 2. */
typedef struct {
  PetscInt       dim, num_cells, num_vertices, num_nodes, num_facets;
  PetscInt      *cell_type;       /* ElementType [num_cells] */
  PetscInt      *cell_nodes;      /* [num_cells][ELEMENT_MAX_NODES] */
  PetscInt      *cell_material;   /* index of SceneGetMaterial(); NULL for a body without regions [num_cells] */
  PetscReal     *coords;          /* before the map [num_nodes][dim] */
  PetscInt      *facet_cell;      /* [num_facets] */
  PetscInt      *facet;           /* number of the facet in its cell [num_facets] */
  PetscInt      *facet_side;      /* index into the SideNames [num_facets] */
  PetscBool      curved_file;     /* the file is of second order */
  PetscBool      straightened;    /* it is, and the body of order 1 */
  PetscInt       num_nonmanifold; /* vertices that alone connect some cells */
  PetscReal      nonmanifold[3];  /* the first of them, before the map */
  UnjoinedPieces unjoined;
} BodyList;

/* Allocates lists whose nodes are all vertices. */
PetscErrorCode BodyListAllocate(PetscInt dim, PetscInt num_cells, PetscInt num_nodes, PetscInt max_facets,
                                BodyList *list);
PetscErrorCode BodyListDestroy(BodyList *list);
/* Puts straight cells of order 2 in the place of those of order 1. Not collective. */
PetscErrorCode BodyListRaise(BodyList *list);
/* All sides of a body that the scene's boundaries and pairs name. */
PetscErrorCode SideNamesOfBody(Scene scene, PetscInt body, SideNames *names);
/* Positions of vertices after the map; before it where the map is not finite.
   [out] coords - [num_vertices][dim] */
PetscErrorCode BodyListMapVertices(const BodyList *list, const SceneBody *body, PetscReal coords[]);

#endif
