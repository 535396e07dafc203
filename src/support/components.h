/* components.h -- connected components of bodies: cells that share nodes.

   A mesh file may give a body of several components. Each moves independently: rigid motions belong to
   components, not to bodies. */
#ifndef MORTISE_COMPONENTS_H
#define MORTISE_COMPONENTS_H

#include "level/level.h"

enum {
  COMPONENT_BOX = 6
}; /* numbers of a component's box: its largest coordinates, then its smallest ones with the opposite sign */

/* Components of all bodies, body by body; within a body ordered by the middles of their boxes: along x, then
   y, then z. */
typedef struct {
  PetscInt   num;
  PetscInt  *body;    /* of each, ascending; the same on all ranks [num] */
  PetscInt  *of_node; /* of each local node, ghosts included [level->num_nodes] */
  PetscReal *box;     /* the same on all ranks; 0 along z in a plane [num][COMPONENT_BOX] */
} Components;

/* Collective. [out] components - owned by the caller, ComponentsDestroy() */
PetscErrorCode ComponentsCreate(Level *level, Components *components);
PetscErrorCode ComponentsDestroy(Components *components);
/* The components of nodes of any rank. Collective. [in] nodes - global, < 0 for none [num]; [out] component -
   -1 for none [num] */
PetscErrorCode ComponentsOfGlobalNodes(Level *level, const Components *components, PetscInt num, const PetscInt nodes[],
                                       PetscInt component[]);
/* Number of components of a body. Not collective. */
PetscInt ComponentsOfBody(const Components *components, PetscInt body);

#endif
