/* cellstress.c -- sigma = C (eps - eps_0) within a cell. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/eigenstrain.h"
#include "result/cellstress.h"

enum { MAX_STRAINS = 6 };

/* Engineering strains of a model.
   [in] H - gradient of the displacement [dim][dim]; [in] hoop - around the axis */
static void CellStressTakeStrain_Private(PetscInt dim, PetscInt num_strains, const PetscReal H[], PetscReal hoop,
                                         PetscReal strain[])
{
  if (dim == 3) {
    strain[0] = H[0];
    strain[1] = H[4];
    strain[2] = H[8];
    strain[3] = H[5] + H[7];
    strain[4] = H[2] + H[6];
    strain[5] = H[1] + H[3];
  } else {
    strain[0]               = H[0];
    strain[1]               = H[3];
    strain[2]               = hoop; // overwritten where the model has none
    strain[num_strains - 1] = H[1] + H[2];
  }
}

/* sigma = C (eps - eps_0) + bulk (theta - theta_0 - tr (eps - eps_0)) 1. [in] strain - eps - eps_0; [in,out]
   C - loses its bulk modulus; [out] lost - div u - theta */
static void CellStressAddPressure_Private(PetscInt num_strains, const CellStress *cell, const PetscReal x[],
                                          PetscReal C[], const PetscReal strain[], PetscReal stress[], PetscReal *lost)
{
  PetscReal change, q[DILATATION_MAX_FUNCTIONS];

  *lost = 0;
  if (!cell->pi.num) return;
  change = DilatationEvaluate(&cell->pi, x, cell->u) - MaterialDilatation(num_strains, strain);
  DilatationShape(&cell->pi, x, q);
  for (PetscInt a = 0; a < cell->pi.num; a++) change -= q[a] * cell->parts[a];
  *lost = -change;
  change *= MaterialTakeBulk(num_strains, C);
  for (PetscInt k = 0; k < 3; k++) stress[k] += change;
}

PetscErrorCode CellStressSet(Scene scene, const Level *level, PetscInt c, const ElementRule *stiffness,
                             const PetscScalar u[], CellStress *cell)
{
  const PetscInt  dim = level->dim, num = level->cell_start[c + 1] - level->cell_start[c];
  const PetscInt *nodes     = &level->cell_nodes[level->cell_start[c]];
  const PetscReal origin[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  cell->material = level->cell_material[c];
  cell->constant = ElasticityHookeIsConstant(scene, cell->material);
  if (cell->constant) PetscCall(ElasticityHooke(scene, cell->material, origin, cell->C, &cell->poisson));
  VectorGather(dim, num, nodes, level->coords, cell->X);
  VectorGather(dim, num, nodes, u, cell->u);
  PetscCall(ElasticityDilatation(scene, level, c, stiffness, &cell->pi));
  PetscCall(EigenstrainDilatation(scene, level, c, stiffness, &cell->pi, cell->parts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellStressAtPoint(Scene scene, const CellStress *cell, const ElementRule *rule, PetscInt q,
                                 PetscReal stress[CELL_STRESSES], PetscReal *det, PetscReal *lost)
{
  const PetscInt  dim = scene->dim, n = ElementNumNodes(rule->type), num_strains = MaterialNumStrains(scene->model);
  const PetscBool ring = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  PetscReal       H[CELL_MAX_DIM * CELL_MAX_DIM], x[CELL_MAX_DIM], C[MAX_STRAINS * MAX_STRAINS], strain[MAX_STRAINS];
  PetscReal       hoop = 0.0, poisson, change;
  Eigenstrain     e;

  PetscFunctionBeginUser;
  *det = ElementRuleGradient(rule, q, cell->X, cell->u, x, H);
  for (PetscInt i = 0; ring && i < n; i++) hoop += rule->phi[q * n + i] / x[0] * cell->u[i * dim];
  CellStressTakeStrain_Private(dim, num_strains, H, hoop, strain);
  poisson = cell->poisson;
  if (cell->constant)
    PetscCall(PetscArraycpy(C, cell->C, num_strains * num_strains));
  else
    PetscCall(ElasticityHooke(scene, cell->material, x, C, &poisson));
  PetscCall(EigenstrainEvaluate(scene, cell->material, x, C, poisson, &e));
  for (PetscInt s = 0; s < num_strains; s++) strain[s] -= e.strain[s];
  MaterialStress(scene->model, C, poisson, strain, stress);
  stress[2] -= e.across;
  CellStressAddPressure_Private(num_strains, cell, x, C, strain, stress, &change);
  if (lost) *lost = change;
  PetscFunctionReturn(PETSC_SUCCESS);
}

void CellStressTraction(PetscInt dim, const PetscScalar stress[], const PetscReal n[], PetscReal t[])
{
  static const PetscInt place[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

  for (PetscInt i = 0; i < dim; i++) {
    t[i] = 0;
    for (PetscInt j = 0; j < dim; j++) t[i] += PetscRealPart(stress[place[i][j]]) * n[j];
  }
}
