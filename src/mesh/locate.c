/* locate.c -- which cell of a body holds a point. */
#include "bodylist.h"
#include <mortise/compat.h>

/* A point on a side belongs to the cell; round-off of a position is far below this share of the cell. */
static const PetscReal LocateTolerance = 1e-8;

/* Whether a point lies in the box around a cell, widened by the cell's own tolerance. [out] X - [num_nodes][dim] */
static PetscBool LocateMeetsBox_Private(const Level *level, PetscInt cell, const PetscReal x[], PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]],
                 num    = level->cell_start[cell + 1] - level->cell_start[cell];
  PetscBool meets       = PETSC_TRUE;

  for (PetscInt d = 0; d < level->dim; ++d) {
    PetscReal low = PETSC_MAX_REAL, high = -PETSC_MAX_REAL, slack;

    for (PetscInt i = 0; i < num; ++i) {
      X[i * level->dim + d] = level->coords[nodes[i] * level->dim + d];
      low                   = PetscMin(low, X[i * level->dim + d]);
      high                  = PetscMax(high, X[i * level->dim + d]);
    }
    slack = 2 * LocateTolerance * (high - low) + 4 * PETSC_MACHINE_EPSILON * PetscAbsReal(x[d]);
    if (x[d] < low - slack || x[d] > high + slack) meets = PETSC_FALSE;
  }
  return meets;
}

PetscErrorCode LevelLocate(Level *level, PetscInt body, const PetscReal x[], PetscInt *cell, PetscReal xi[],
                           PetscBool *found)
{
  PetscReal   X[ELEMENT_MAX_NODES * 3];
  PetscMPIInt rank, size, winner;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  *cell = -1;
  for (PetscInt c = 0; c < level->num_cells && *cell < 0; ++c) {
    if (level->cell_body[c] != body || !LocateMeetsBox_Private(level, c, x, X)) continue;
    if (ElementLocate((ElementType)level->cell_type[c], X, x, LocateTolerance, xi)) *cell = c;
  }
  winner = *cell >= 0 ? rank : size;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &winner, 1, MPI_INT, MPI_MIN, level->comm));
  if (rank != winner) *cell = -1;
  *found = winner < size ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
