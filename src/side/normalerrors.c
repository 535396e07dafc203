/* normalerrors.c -- errors of a file's normals, as a field at the nodes of all levels. */
#include "side/normalerrors.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES, FIELDS = LEVEL_NORMAL_ERRORS };

/* The longest edge of a facet, on the level. */
static PetscReal FacetSize_Private(const Level *level, const Facets *facets, PetscInt f)
{
  const ElementType linear = ElementLinear(facets->type[f]);
  const PetscInt    dim    = level->dim;
  PetscReal         most   = 0;

  for (PetscInt e = 0; e < ElementNumEdges(linear); e++) {
    const PetscInt *ends = ElementEdgeNodes(linear, e);
    PetscReal       d[3];

    for (PetscInt k = 0; k < dim; k++)
      d[k] = level->coords[facets->nodes[f * F + ends[1]] * dim + k] -
             level->coords[facets->nodes[f * F + ends[0]] * dim + k];
    most = PetscMax(most, VectorNorm(dim, d));
  }
  return most;
}

/* Nodes between the vertices of cells of order 2 have the means of these. [in,out] errors - at local nodes */
static void LevelFillMiddles_Private(const Level *level, PetscScalar errors[])
{
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type   = (ElementType)level->cell_type[c];
    const PetscInt   *nodes  = &level->cell_nodes[level->cell_start[c]];
    const PetscInt    linear = ElementNumNodes(ElementLinear(type));
    PetscReal         phi[ELEMENT_MAX_NODES];

    for (PetscInt k = linear; k < ElementNumNodes(type); k++) {
      ElementShape(ElementLinear(type), ElementNode(type, k), phi, NULL);
      for (PetscInt i = 0; i < FIELDS; i++) errors[nodes[k] * FIELDS + i] = 0;
      for (PetscInt v = 0; v < linear; v++) {
        for (PetscInt i = 0; i < FIELDS; i++) errors[nodes[k] * FIELDS + i] += phi[v] * errors[nodes[v] * FIELDS + i];
      }
    }
  }
}

PetscErrorCode LevelAddNormalErrors(Level *level, const Facets *facets, const SideShape *shape)
{
  PetscBool    any = PETSC_FALSE;
  PetscScalar *errors;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < facets->num * F; c++) any = (PetscBool)(any || shape->error[c] > 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  if (!level->normal_errors) PetscCall(LevelCreateVec(level, FIELDS, &level->normal_errors));
  PetscCall(GhostedGetArray(level->normal_errors, &errors));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscReal size = FacetSize_Private(level, facets, f);

    for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(facets->type[f])); i++) {
      PetscScalar *at = &errors[facets->nodes[f * F + i] * FIELDS];

      at[0] = PetscMax(PetscRealPart(at[0]), shape->error[f * F + i]);
      at[1] = PetscMax(PetscRealPart(at[1]), shape->error[f * F + i] * size);
    }
  }
  PetscCall(GhostedRestoreArray(level->normal_errors, &errors));
  PetscCall(LevelShareVec(level->normal_errors, MAX_VALUES));
  PetscCall(GhostedGetArray(level->normal_errors, &errors));
  LevelFillMiddles_Private(level, errors);
  PetscCall(GhostedRestoreArray(level->normal_errors, &errors));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelFollowNormalErrors(const Level *coarse, Level *fine)
{
  Vec from, to;

  PetscFunctionBeginUser;
  if (!coarse->normal_errors) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(fine, FIELDS, &fine->normal_errors));
  PetscCall(MatCreateVecs(fine->prolongation, &from, &to));
  for (PetscInt i = 0; i < FIELDS; i++) {
    PetscCall(VecStrideGather(coarse->normal_errors, i, from, INSERT_VALUES));
    PetscCall(MatMult(fine->prolongation, from, to));
    PetscCall(VecStrideScatter(to, i, fine->normal_errors, INSERT_VALUES));
  }
  PetscCall(LevelShareVec(fine->normal_errors, INSERT_VALUES));
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(PETSC_SUCCESS);
}
