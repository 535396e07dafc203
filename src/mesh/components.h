/* components.h -- what hangs together in a body: cells that share nodes, directly or by way of others.

   A mesh file may give a body of several pieces. Each moves as it likes: it is pieces, not bodies, that have rigid motions. */
#ifndef MORTISE_COMPONENTS_H
#define MORTISE_COMPONENTS_H

#include "mesh/mesh.h"

enum {
  PIECE_BOX = 6
}; /* numbers of a piece's box: its largest coordinates, then its smallest ones with the opposite sign */

/* Pieces of all bodies, body by body, those of one body by the middles of their boxes: along x, then y, then z. */
typedef struct {
  PetscInt   num;
  PetscInt  *body;    /* of each, ascending; the same on all ranks [num] */
  PetscInt  *of_node; /* of each local node, ghosts included [level->num_nodes] */
  PetscReal *box;     /* the same on all ranks; 0 along z in a plane [num][PIECE_BOX] */
} Pieces;

/* Collective. [out] pieces - to be freed by PiecesDestroy() */
PetscErrorCode PiecesCreate(Level *level, Pieces *pieces);
PetscErrorCode PiecesDestroy(Pieces *pieces);
/* The pieces of nodes of any rank. Collective. [in] nodes - global, < 0 for none [num]; [out] piece - -1 for none [num] */
PetscErrorCode PiecesOfGlobalNodes(Level *level, const Pieces *pieces, PetscInt num, const PetscInt nodes[],
                                   PetscInt piece[]);
/* How many pieces a body has. Not collective. */
PetscInt PiecesOfBody(const Pieces *pieces, PetscInt body);

#endif
