/* treearcs.h -- smooth sides of bodies that are bisected (eq. 4.5). Nothing is collective. */
#ifndef MORTISE_TREEARCS_H
#define MORTISE_TREEARCS_H

#include "bodies/bodylist.h"
#include "mesh/tree.h"

/* Finds the smooth sides of a tree's list; a body of order 2 gets middle nodes on them. */
PetscErrorCode TreeArcsCreate(Scene scene, PetscInt body, const SideNames *names, Tree *tree);
PetscErrorCode TreeArcsDestroy(TreeArcs *arcs);
/* Moves new vertices and middle nodes of a new list to the curves.
   [in,out] list - of the tree's mesh, with the positions of all other nodes */
PetscErrorCode TreeArcsApply(Tree *tree, BodyList *list);

#endif
