/* bodycounts.c -- see the header. */
#include "base/compat.h"
#include "output/bodycounts.h"
#include "checks/setupcheck.h"

PetscErrorCode BodyCountsCompute(const Level *level, PetscInt num_bodies, BodyCount counts[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(counts, num_bodies));
  for (PetscInt c = 0; c < level->num_cells; c++) counts[level->cell_body[c]].cells++;
  for (PetscInt a = 0; a < level->num_owned; a++) counts[level->node_body[a]].nodes++;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, (PetscMPIInt)(2 * num_bodies), MPIU_INT, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells and volumes of all materials. Collective. [out] sums - [num_bodies + num_regions][2] */
static PetscErrorCode MaterialsMeasure_Private(Scene scene, const Level *level, PetscReal sums[])
{
  const PetscInt num = scene->num_bodies + scene->num_regions;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(sums, 2 * num));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscReal *sum = &sums[2 * level->cell_material[c]];

    sum[0] += 1;
    sum[1] += SetupCellVolume(scene, level, c);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * num), MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RegionCountsCompute(Scene scene, const Level *level, PetscInt *num, RegionCount **counts)
{
  PetscReal *sums;

  PetscFunctionBeginUser;
  *num    = 0;
  *counts = NULL;
  if (!scene->num_regions) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(2 * (scene->num_bodies + scene->num_regions), &sums));
  PetscCall(MaterialsMeasure_Private(scene, level, sums));
  PetscCall(PetscMalloc1(scene->num_bodies + scene->num_regions, counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const PetscInt first = SceneBodyFirstRegion(scene, b), end = first + scene->bodies[b].num_regions;

    for (PetscInt r = first; r <= end && first < end; r++) {
      const PetscInt m = r < end ? r : b;

      if (!(sums[2 * m] > 0)) continue;
      (*counts)[(*num)++] = (RegionCount){.name     = r < end ? scene->regions[r - scene->num_bodies].group : NULL,
                                          .body     = b,
                                          .cells    = (PetscInt)sums[2 * m],
                                          .volume   = sums[2 * m + 1],
                                          .material = SceneGetMaterial(scene, m)};
    }
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}
