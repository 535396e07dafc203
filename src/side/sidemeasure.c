/* sidemeasure.c -- stiffness and size of a side. */
#include "level/level.h"
#include "side/sidemeasure.h"
#include "base/compat.h"
#include "level/facets.h"
#include "level/leveltables.h"

/* The contact modulus of the material of a cell, in its middle. */
static PetscErrorCode CellGetModulus_Private(Scene scene, const Level *level, PetscInt cell, PetscReal *modulus)
{
  const SceneMaterial *m         = SceneGetMaterial(scene, level->cell_material[cell]);
  const PetscInt      *nodes     = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt       num       = LevelNumVertices(level, cell);
  PetscReal            middle[3] = {0, 0, 0}, C[36], upper[21], young, poisson;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt d = 0; d < level->dim; d++) middle[d] += level->coords[nodes[i] * level->dim + d] / num;
  }
  if (m->stiffness) {
    PetscCall(ExpressionEvaluate(m->stiffness, level->dim, middle, upper));
    MaterialAnisotropic(scene->model, upper, m->angle, C);
  } else {
    PetscCall(ExpressionEvaluate(m->young, level->dim, middle, &young));
    PetscCall(ExpressionEvaluate(m->poisson, level->dim, middle, &poisson));
    MaterialIsotropic(scene->model, young, poisson, C);
  }
  *modulus = MaterialContactModulus(MaterialNumStrains(scene->model), C);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideMeasureCompute(Scene scene, Level *level, const SceneSide *side, SideMeasure *measure)
{
  PetscReal sum[3] = {0, 0, 0}; /* of moduli, of sizes, of ones */
  Facets    facets;

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
  for (PetscInt i = 0; i < scene->num_bodies + scene->num_regions; i++) {
    const SceneMaterial *m = SceneGetMaterial(scene, i);

    if (SceneMaterialBody(scene, i) != side->body) continue;
    PetscCall(ExpressionCheck(level->comm, m->stiffness));
    PetscCall(ExpressionCheck(level->comm, m->young));
    PetscCall(ExpressionCheck(level->comm, m->poisson));
  }
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
