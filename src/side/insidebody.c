/* insidebody.c -- points are compared with the cells of a body by a tree of boxes, on the ranks that have the
   cells. */
#include "kernel/boxtree.h"
#include "base/compat.h"
#include "side/insidebody.h"

/* A point on a side belongs to the cell: tolerance of reference coordinates. */
static const PetscReal ON_CELL = 1e-8;

PetscErrorCode GatheredPointsCreate(const Level *level, PetscInt num, const PetscReal mine[], GatheredPoints *points)
{
  PetscMPIInt size, count, *counts, *begin;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size + 1, &begin));
  count = (PetscMPIInt)(num * level->dim);
  PetscCallMPI(MPI_Allgather(&count, 1, MPI_INT, counts, 1, MPI_INT, level->comm));
  begin[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) begin[r + 1] = begin[r] + counts[r];
  points->num = begin[size] / level->dim;
  PetscCall(PetscMalloc2(begin[size], &points->x, points->num, &points->flag));
  PetscCallMPI(MPI_Allgatherv(mine, count, MPIU_REAL, points->x, counts, begin, MPIU_REAL, level->comm));
  PetscCall(PetscFree2(counts, begin));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GatheredPointsDestroy(GatheredPoints *points)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(points->x, points->flag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The vertices of a cell and the box around them.
   [out] X - [nodes][dim]; box - lower, upper corner [2][dim] */
static void InsideBodyGetCell_Private(const Level *level, PetscInt c, PetscReal X[], PetscReal box[])
{
  const PetscInt  dim   = level->dim;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

  for (PetscInt k = 0; k < dim; k++) {
    box[k]       = PETSC_MAX_REAL;
    box[dim + k] = PETSC_MIN_REAL;
  }
  for (PetscInt i = 0; i < ElementNumNodes((ElementType)level->cell_type[c]) * dim; i++) {
    X[i]               = level->coords[nodes[i / dim] * dim + i % dim];
    box[i % dim]       = PetscMin(box[i % dim], X[i]);
    box[dim + i % dim] = PetscMax(box[dim + i % dim], X[i]);
  }
}

PetscErrorCode InsideBodyFind(const Level *level, PetscInt body, PetscInt num, const PetscReal x[], PetscBool inside[])
{
  const PetscInt  dim = level->dim;
  PetscReal      *boxes, X[ELEMENT_MAX_NODES * 3], cell[6], xi[3];
  const PetscInt *hits;
  PetscInt        num_hits;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * dim * num, &boxes));
  for (PetscInt i = 0; i < 2 * dim * num; i++) boxes[i] = x[i / (2 * dim) * dim + i % dim];
  PetscCall(BoxTreeCreate(dim, num, boxes, &tree));
  PetscCall(PetscFree(boxes));
  PetscCall(PetscArrayzero(inside, num));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_body[c] != body) continue;
    InsideBodyGetCell_Private(level, c, X, cell);
    PetscCall(BoxTreeQuery(tree, cell, &num_hits, &hits));
    for (PetscInt h = 0; h < num_hits; h++) {
      if (!inside[hits[h]])
        inside[hits[h]] = ElementLocate((ElementType)level->cell_type[c], X, &x[hits[h] * dim], ON_CELL, xi);
    }
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, inside, (PetscMPIInt)num, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
