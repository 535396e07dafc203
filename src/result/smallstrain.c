/* smallstrain.c -- test of the assumption of small displacements.

   Strains and rotations count as small as long as their squares do not show. Where |u_i - u_j| / |x_i - x_j| between two corners
   of a cell is more than that, one of them is not: loads that are meant to be so large need another program, and most of the
   time newtons, metres and megapascals were mixed. */
#include "base/compat.h"
#include "base/warning.h"
#include "result/smallstrain.h"

/* The largest gradient that is small: its square is a hundredth. */
static const PetscReal SMALL = 0.1;

/* The square of the largest gradient between corners of a cell. */
static PetscReal SmallStrainGetCell_Private(const Level *level, PetscInt c, const PetscScalar u[])
{
  const PetscInt dim = level->dim, *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscInt num     = ElementNumNodes(ElementLinear((ElementType)level->cell_type[c]));
  PetscReal      largest = 0;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j < i; j++) {
      PetscReal way = 0, moved = 0;

      for (PetscInt k = 0; k < dim; k++) {
        way += PetscSqr(level->coords[nodes[i] * dim + k] - level->coords[nodes[j] * dim + k]);
        moved += PetscSqr(PetscRealPart(u[nodes[i] * dim + k] - u[nodes[j] * dim + k]));
      }
      largest = PetscMax(largest, moved / way);
    }
  }
  return largest;
}

PetscErrorCode SmallStrainWarn(Fields fields)
{
  const Level       *level = fields->vi->level;
  const Scene        scene = fields->vi->scene;
  PetscReal         *squares;
  const PetscScalar *u;
  PetscInt           worst = 0;
  Vec                local;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_bodies, &squares));
  PetscCall(VecGhostGetLocalForm(fields->u, &local));
  PetscCall(VecGetArrayRead(local, &u));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscReal *square = &squares[level->cell_body[c]];

    *square = PetscMax(*square, SmallStrainGetCell_Private(level, c, u));
  }
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(VecGhostRestoreLocalForm(fields->u, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, squares, (PetscMPIInt)scene->num_bodies, MPIU_REAL, MPI_MAX, level->comm));
  for (PetscInt b = 1; b < scene->num_bodies; b++)
    if (squares[b] > squares[worst]) worst = b;
  if (squares[worst] > PetscSqr(SMALL)) {
    const Warning large = {.code   = "model_limit",
                           .body   = scene->bodies[worst].name,
                           .advice = "check the units of loads, lengths and moduli"};

    PetscCall(WarningAdd(&large, "small strains are exceeded: body %s is strained or rotated by up to %.3g", large.body,
                         (double)PetscSqrtReal(squares[worst])));
  }
  PetscCall(PetscFree(squares));
  PetscFunctionReturn(PETSC_SUCCESS);
}
