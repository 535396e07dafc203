/* nonmanifold.c -- vertices that alone connect parts of a body, that is, cells that are not joined facet by
   facet.

   Parts rotate about a single vertex, or in space about an edge, without resistance, while components.h
   counts them as one. Such meshes are mostly accidents. Since supports may hold all parts, this is only a
   warning. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/fileextract.h"
#include "bodies/nonmanifold.h"
#include "level/leveltables.h"

/* States of a vertex that is not in one block alone. */
enum { NOWHERE = -1, HINGE = -2 };

/* Cells that are joined facet by facet have the same block; -1 for cells that are not of the body. [out]
   block - [num_cells] */
static PetscErrorCode NonManifoldCountBlocks_Private(const Extract *x, PetscInt block[])
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < x->level.num_cells; c++) block[c] = x->cell_at[c] < 0 ? -1 : c;
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; f++) {
    const PetscInt *support;
    PetscInt        num, root[2];

    PetscCall(DMPlexGetSupportSize(x->level.dm, f, &num));
    PetscCall(DMPlexGetSupport(x->level.dm, f, &support));
    if (num != 2) continue;
    for (PetscInt i = 0; i < 2; i++) root[i] = support[i] - x->cell_begin;
    if (block[root[0]] < 0 || block[root[1]] < 0) continue;
    for (PetscInt i = 0; i < 2; i++) {
      while (block[root[i]] != root[i]) root[i] = block[root[i]] = block[block[root[i]]];
    }
    block[PetscMax(root[0], root[1])] = PetscMin(root[0], root[1]);
  }
  for (PetscInt c = 0; c < x->level.num_cells; c++) // the root of a set is before its cells
    if (block[c] >= 0) block[c] = block[block[c]];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NonManifoldFind(const Extract *x, BodyList *list)
{
  const Level *level = &x->level;
  PetscInt    *block, *of_node; // the first block of each vertex

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(level->num_cells, &block, level->num_nodes, &of_node));
  PetscCall(NonManifoldCountBlocks_Private(x, block));
  for (PetscInt a = 0; a < level->num_nodes; a++) of_node[a] = NOWHERE;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < LevelNumVertices(level, c) && block[c] >= 0; i++) {
      PetscInt *met = &of_node[nodes[i]];

      if (*met == NOWHERE) *met = block[c];
      if (*met == block[c] || *met == HINGE) continue;
      *met = HINGE;
      if (!list->num_nonmanifold++)
        PetscCall(PetscArraycpy(list->nonmanifold, &level->coords[nodes[i] * list->dim], list->dim));
    }
  }
  PetscCall(PetscFree2(block, of_node));
  PetscFunctionReturn(PETSC_SUCCESS);
}
