/* slip.c -- relative displacements of the two sides of a pair. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "checks/slip.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* One component. [in] u - of all nodes; [in,out] relative - entries k of each node */
static PetscErrorCode SlipAddComponent_Private(const Pair pair, Vec u, PetscInt k, PetscReal relative[])
{
  const PetscInt     dim = pair->level->dim;
  const PetscScalar *value;
  Vec                own, sums;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &own));
  PetscCall(VecDuplicate(u, &sums));
  PetscCall(VecCopy(u, own));
  if (pair->from_nodal) PetscCall(MatMultAdd(pair->from_nodal, u, own, own));
  PetscCall(VecZeroEntries(sums));
  if (pair->M) {
    PetscCall(MatMult(pair->M, u, sums));
    PetscCall(VecScale(sums, -1.0));
  }
  if (pair->D_other) PetscCall(MatMultAdd(pair->D_other, own, sums, sums));
  PetscCall(VecGetArrayRead(own, &value));
  for (PetscInt a = 0; a < pair->num; a++) relative[a * dim + k] = PetscRealPart(value[pair->nodes[a]]);
  PetscCall(VecRestoreArrayRead(own, &value));
  PetscCall(VecGetArrayRead(sums, &value));
  for (PetscInt a = 0; a < pair->num; a++) {
    relative[a * dim + k] += PetscRealPart(value[pair->nodes[a]]) / pair->D[a];
    relative[a * dim + k] /= pair->share[a];
  }
  PetscCall(VecRestoreArrayRead(sums, &value));
  PetscCall(VecDestroy(&own));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlipComputeRelative(Fields fields, PetscInt p, PetscReal relative[])
{
  const Pair         pair = fields->vi->pairs[p];
  const PetscInt     dim  = pair->level->dim;
  const PetscScalar *u;
  PetscScalar       *value;
  Vec                component;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, &component));
  for (PetscInt k = 0; k < dim; k++) {
    PetscCall(VecGetArrayRead(fields->u, &u));
    PetscCall(VecGetArray(component, &value));
    for (PetscInt i = 0; i < pair->level->num_owned; i++) value[i] = u[i * dim + k];
    PetscCall(VecRestoreArray(component, &value));
    PetscCall(VecRestoreArrayRead(fields->u, &u));
    PetscCall(SlipAddComponent_Private(pair, component, k, relative));
  }
  PetscCall(VecDestroy(&component));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SlipTakeTangential(const Pair pair, const PetscReal relative[], PetscReal tangential[])
{
  const PetscInt dim = pair->level->dim;

  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal *n     = &pair->normal[a * dim];
    const PetscReal  along = VectorDot(dim, n, &relative[a * dim]);

    for (PetscInt k = 0; k < dim; k++) tangential[a * dim + k] = relative[a * dim + k] - along * n[k];
  }
}

PetscErrorCode SlipFindFacetSizes(Fields fields, PetscInt p, PetscReal size[])
{
  const Pair       pair  = fields->vi->pairs[p];
  const ScenePair *spec  = pair->spec;
  Level           *level = pair->level;
  PetscScalar     *value;
  Facets           facets;
  Vec              sizes, local; /* with the opposite sign: ranks share maxima */

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, fields->vi->scene, spec->nonmortar.body, spec->nonmortar.side, &facets));
  PetscCall(LevelCreateVec(level, 1, &sizes));
  PetscCall(VecGhostGetLocalForm(sizes, &local));
  PetscCall(VecSet(local, -PETSC_MAX_REAL));
  PetscCall(VecGetArray(local, &value));
  for (PetscInt f = 0; f < facets.num; f++) {
    const PetscInt *nodes = &facets.nodes[f * F], num = ElementNumNodes(facets.type[f]);
    PetscReal       X[3 * F], edge;

    VectorGather(level->dim, num, nodes, level->coords, X);
    edge = ElementShortestEdge(facets.type[f], level->dim, X);
    for (PetscInt i = 0; i < num; i++) value[nodes[i]] = PetscMax(PetscRealPart(value[nodes[i]]), -edge);
  }
  PetscCall(VecRestoreArray(local, &value));
  PetscCall(VecGhostRestoreLocalForm(sizes, &local));
  PetscCall(LevelShareVec(sizes, MAX_VALUES));
  PetscCall(VecGetArray(sizes, &value));
  for (PetscInt a = 0; a < pair->num; a++) size[a] = -PetscRealPart(value[pair->nodes[a]]);
  PetscCall(VecRestoreArray(sizes, &value));
  PetscCall(VecDestroy(&sizes));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}
