/* calibration.c -- theta, from the decrease of the energy by refinement. */
#include "result/calibration.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"
#include "result/stressquadratic.h"

enum {
  NUM_RATIOS = 3, /* the standard, and those of the latest two pairs of meshes */
  SETTLED    = 2  /* age at which a cell's theta no longer changes: the next two refinements measured its neighbours */
};

static const PetscReal SMALLEST = 0.5, LARGEST = 4; /* of theta */
static const PetscReal LEAST_FALL =
    0.4; /* of eta^2, from one mesh to the next: below, the ratio of two differences is noise */
static const PetscReal MOST_SIGNS = 5; /* of the fall of 2J - L, by which L may change: it is known to parts of it */

/* theta of a cell alone. Measured on scenes whose solutions are known: what centres the range of true ones.
   The recovered stress of curved cells has the quadratic part.
   [in] order - of convergence; [in] shape - of the cell */
static PetscReal CalibrationOfCell_Private(PetscInt order, PetscInt shape, PetscInt dim, PetscBool curved)
{
  if (order == 1) return shape == 1 ? 1.05 : 1.09;
  return curved ? 1.15 : CalibrationOfStraight(dim);
}

PetscReal CalibrationOfStraight(PetscInt dim)
{
  return dim == 3 ? 1.25 : 1.35;
}

PetscErrorCode CalibrationGetStandard(const Level *level, const PetscReal squared[], PetscReal *theta)
{
  const Scene scene = level->scene;
  PetscInt   *order;
  PetscReal   X[CELL_MAX_DIM * ELEMENT_MAX_NODES], sums[2] = {0, 0}; // of 1 and theta^2

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &order));
  PetscCall(ElasticityGetOrders(scene, level, order));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];
    const PetscInt    body = level->cell_body[c];
    PetscBool         curved;

    VectorGather(level->dim, ElementNumNodes(type), &level->cell_nodes[level->cell_start[c]], level->coords, X);
    curved = (PetscBool)(ElementOrder(type) == 2 && !StressCellIsStraight(type, level->dim, X));
    sums[0] += squared[c];
    sums[1] += squared[c] * PetscSqr(CalibrationOfCell_Private(order[body], ElementOrder(type), level->dim, curved));
  }
  PetscCall(PetscFree(order));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPI_SUM, level->comm));
  *theta = sums[0] > 0 ? PetscSqrtReal(sums[1] / sums[0]) : 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether L, which rests on gaps and recovered stresses, leaves a decrease of the energy to measure by. The
   supports' part does not fall from mesh to mesh where their facets stay, so its size counts. */
static PetscBool CalibrationIsSure_Private(const CalibrationMesh *before, const CalibrationMesh *mesh, PetscReal gained)
{
  if (PetscAbsReal(before->signs - mesh->signs) > MOST_SIGNS * gained) return PETSC_FALSE;
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

PetscReal CalibrationFind(PetscInt num, const CalibrationMesh mesh[], const Estimate estimate)
{
  const PetscReal standard = estimate->standard;
  const PetscReal all      = estimate->squared - estimate->geometry;
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
