/* calibration.c -- theta, from the decrease of the energy by refinement. */
#include "result/calibration.h"
#include "base/compat.h"
#include "problem/elasticity.h"

enum {
  NUM_RATIOS = 3, /* the standard, and those of the latest two pairs of meshes */
  SETTLED    = 2  /* age at which a cell's theta no longer changes: the next two refinements measured its neighbours */
};

static const PetscReal SMALLEST = 0.5, LARGEST = 4; /* of theta */
static const PetscReal LEAST_FALL =
    0.4; /* of eta^2, from one mesh to the next: below, the ratio of two differences is noise */

/* Measured on scenes whose solutions are known: what centres the range of true ones.
   [in] order - of convergence; [in] shape - of the cells */
static PetscReal CalibrationOfOrder_Private(PetscInt order, PetscInt shape, PetscInt dim)
{
  if (order == 1) return shape == 1 ? 1.05 : 1.09;
  return dim == 3 ? 1.25 : 1.35;
}

PetscErrorCode CalibrationGetStandard(const Level *level, PetscReal *theta)
{
  const Scene scene = level->scene;
  PetscInt   *order;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &order));
  PetscCall(ElasticityGetOrders(scene, level, order));
  *theta = 0;
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    *theta = PetscMax(*theta, CalibrationOfOrder_Private(order[b], scene->bodies[b].order, level->dim));
  PetscCall(PetscFree(order));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether parts of L that rest on recovered mean stresses leave a decrease of the energy to measure by. The
   supports' part does not fall from mesh to mesh where their facets stay, so its size counts. */
static PetscBool CalibrationIsSure_Private(const CalibrationMesh *before, const CalibrationMesh *mesh, PetscReal gained)
{
  if (PetscAbsReal(before->lost - mesh->lost) > gained) return PETSC_FALSE;
  if (mesh->lost == 0) return PETSC_TRUE; // mean stresses are those of the displacement
  return (PetscBool)(PetscMax(PetscAbsReal(before->supports), PetscAbsReal(mesh->supports)) <= gained);
}

/* theta of the latest decreases. */
static PetscReal CalibrationMeasure_Private(PetscInt num, const CalibrationMesh mesh[], PetscReal standard)
{
  PetscReal ratio[NUM_RATIOS] = {standard};
  PetscInt  found             = 1;

  for (PetscInt k = num - 1; k > 0 && found < NUM_RATIOS; k--) {
    const PetscReal fall   = mesh[k - 1].squared - mesh[k].squared;
    const PetscReal gained = mesh[k - 1].energy - mesh[k].energy;
    PetscInt        i      = found;
    PetscReal       theta;

    if (!(fall >= LEAST_FALL * mesh[k].squared)) continue;
    if (!CalibrationIsSure_Private(&mesh[k - 1], &mesh[k], PetscAbsReal(gained))) continue;
    theta = PetscSqrtReal(PetscMax(0, gained / fall));
    for (; i > 0 && ratio[i - 1] > theta; i--) ratio[i] = ratio[i - 1];
    ratio[i] = theta;
    found++;
  }
  return PetscMin(LARGEST, PetscMax(SMALLEST, found % 2 ? ratio[found / 2] : (ratio[0] + ratio[found - 1]) / 2));
}

PetscReal CalibrationFind(PetscInt num, const CalibrationMesh mesh[], PetscReal standard, const Estimate estimate)
{
  const PetscReal all    = estimate->squared - estimate->geometry;
  PetscReal       others = all, sum = 0;

  if (num == 1 || !(all > 0)) return standard;
  for (PetscInt age = 0; age < MESH_MAX_ADAPTED; age++) {
    const PetscInt meshes = PetscMax(num - PetscMax(0, age - SETTLED), PetscMin(num, SETTLED + 1));

    if (!(estimate->aged[age] > 0)) continue;
    sum += PetscSqr(CalibrationMeasure_Private(meshes, mesh, standard)) * estimate->aged[age];
    others -= estimate->aged[age];
  }
  return PetscSqrtReal((sum + PetscSqr(standard) * PetscMax(0, others)) / all);
}
