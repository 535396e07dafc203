/* sidemeasure.c -- stiffness and size of a side. */
#include "mesh/meshimpl.h"
#include "mesh/sidemeasure.h"
#include "base/compat.h"

/* The contact modulus of a body's material in the middle of a cell. */
static PetscErrorCode CellGetModulus_Private(Scene scene, const Level *level, PetscInt cell, PetscReal *modulus)
{
  const SceneBody *body      = &scene->bodies[level->cell_body[cell]];
  const PetscInt  *nodes     = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt   num       = LevelNumVertices(level, cell);
  PetscReal        middle[3] = {0, 0, 0}, C[36], upper[21], young, poisson;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt d = 0; d < level->dim; d++) middle[d] += level->coords[nodes[i] * level->dim + d] / num;
  }
  if (body->stiffness) {
    PetscCall(ExpressionEvaluate(body->stiffness, level->dim, middle, upper));
    MaterialAnisotropic(scene->model, upper, body->angle, C);
  } else {
    PetscCall(ExpressionEvaluate(body->young, level->dim, middle, &young));
    PetscCall(ExpressionEvaluate(body->poisson, level->dim, middle, &poisson));
    MaterialIsotropic(scene->model, young, poisson, C);
  }
  *modulus = MaterialContactModulus(MaterialNumStrains(scene->model), C);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideMeasureCompute(Scene scene, Level *level, const SceneSide *side, SideMeasure *measure)
{
  const SceneBody *body   = &scene->bodies[side->body];
  PetscReal        sum[3] = {0, 0, 0}; /* of moduli, of sizes, of ones */
  Facets           facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, side->body, side->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    PetscReal modulus = 0;

    PetscCall(CellGetModulus_Private(scene, level, facets.cell[f], &modulus));
    sum[0] += modulus;
    sum[1] += FacetGetMeasure(level, &facets, f, NULL);
    sum[2] += 1;
  }
  PetscCall(FacetsDestroy(&facets));
  PetscCall(ExpressionCheck(level->comm, body->stiffness));
  PetscCall(ExpressionCheck(level->comm, body->young));
  PetscCall(ExpressionCheck(level->comm, body->poisson));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPIU_REAL, MPIU_SUM, level->comm));
  *measure = (SideMeasure){.modulus = sum[0] / sum[2], .facet_size = sum[1] / sum[2], .size = sum[1]};
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideMeasureNodeSizes(Scene scene, Level *level, const SceneSide *side, Vec *sizes)
{
  Facets       facets;
  PetscScalar *h;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, sizes));
  PetscCall(VecGhostGetLocalForm(*sizes, &local));
  PetscCall(VecSet(local, 0));
  PetscCall(LevelGetFacets(level, scene, side->body, side->side, &facets));
  PetscCall(VecGetArray(local, &h));
  for (PetscInt f = 0; f < facets.num; f++) {
    const PetscReal measure = FacetGetMeasure(level, &facets, f, NULL);
    const PetscReal size    = level->dim == 3 ? PetscSqrtReal(measure) : measure;

    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
      const PetscInt node = facets.nodes[f * ELEMENT_MAX_FACET_NODES + i];

      h[node] = PetscMax(PetscRealPart(h[node]), size);
    }
  }
  PetscCall(VecRestoreArray(local, &h));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(VecGhostRestoreLocalForm(*sizes, &local));
  PetscCall(LevelShareVec(*sizes, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
