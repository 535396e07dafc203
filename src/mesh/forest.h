/* forest.h -- one body under bisection or splitting: from marked cells to the lists of the next mesh.
   Nothing is collective. */
#ifndef MORTISE_FOREST_H
#define MORTISE_FOREST_H

#include "bodies/bodylist.h"
#include "mesh/meshforest.h"
#include "mesh/tree.h"

/* A body's tree of simplices, or of quadrilaterals or hexahedra that are kept. [in] names - of the list's
   sides; [in,out] list - taken over, empty afterwards */
PetscErrorCode TreeCreate(Scene scene, PetscInt body, const SideNames *names, BodyList *list, Tree *tree);
PetscErrorCode TreeDestroy(Tree *tree);
/* Refines; the list becomes that of the new mesh. Cells that curves tangle are refined again, UNTANGLE_TIMES
   at most.
   [in] body - of the tree; [in] marked - how often edges are halved [num_cells] */
PetscErrorCode TreeRefine(Tree *tree, const SceneBody *body, const PetscInt marked[]);
/* Shape functions of a parent at the nodes of one of its children.
   [in] child - cell of the tree; [in] fine, coarse - the child and its parent; [out] weights - [nodes of
   fine][nodes of coarse] */
void TreeWeights(const Tree *tree, PetscInt child, const ForestCell *fine, const ForestCell *coarse,
                 PetscReal weights[]);

#endif
