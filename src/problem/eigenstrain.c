/* eigenstrain.c -- strains that a body has without stress: of temperature, and others (eq. 8.6).

   All integrals have the rule of the stiffness. In cells with a Pi the change of volume without stress is
   projected like div u. Otherwise a varying temperature in a nearly incompressible cell would cause a
   pressure that no displacement can relieve. */
#include "base/compat.h"
#include "level/ghosted.h"
#include "problem/eigenstrain.h"
#include "problem/volumestrain.h"

enum { MAX_STRAINS = 6, MAX_CELL_DOFS = 3 * ELEMENT_MAX_NODES };

/* a a' as a strain xx,yy,zz,yz,xz,xy. [out] axial - [MAX_STRAINS] */
static void EigenstrainGetAxial_Private(const SceneBody *body, PetscReal axial[])
{
  const PetscReal *a = body->axis;

  for (PetscInt s = 0; s < 3; s++) {
    axial[s]     = a[s] * a[s];
    axial[3 + s] = 2 * a[(s + 1) % 3] * a[(s + 2) % 3];
  }
}

/* eps_0 as xx,yy,zz,yz,xz,xy. */
static PetscErrorCode EigenstrainEvaluateAll_Private(Scene scene, PetscInt material, const PetscReal x[],
                                                     PetscReal all[])
{
  const SceneMaterial *m = SceneGetMaterial(scene, material);
  const SceneBody     *b = &scene->bodies[SceneMaterialBody(scene, material)];
  PetscReal            temperature, expansion[3], given[MAX_STRAINS], axial[MAX_STRAINS];

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(all, MAX_STRAINS));
  if (m->temperature) {
    PetscCall(ExpressionEvaluate(m->temperature, scene->dim, x, &temperature));
    PetscCall(ExpressionEvaluate(m->expansion, scene->dim, x, expansion));
    if (ExpressionSize(m->expansion) == 1) expansion[1] = expansion[2] = expansion[0];
    for (PetscInt k = 0; k < 3; k++) expansion[k] *= temperature;
    MaterialAxialStrain(scene->model, expansion, m->angle, all);
  }
  if (m->initial_strain) {
    PetscCall(ExpressionEvaluate(m->initial_strain, scene->dim, x, given));
    for (PetscInt s = 0; s < 3; s++) all[s] += given[s];
    for (PetscInt s = 3; s < MAX_STRAINS && scene->dim == 3; s++) all[s] += given[s];
    if (scene->dim == 2) all[5] += given[3];
  }
  if (b->pretension) {
    EigenstrainGetAxial_Private(b, axial);
    for (PetscInt s = 0; s < MAX_STRAINS; s++) all[s] += b->tightening * axial[s];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenstrainEvaluate(Scene scene, PetscInt material, const PetscReal x[], const PetscReal C[],
                                   PetscReal poisson, Eigenstrain *e)
{
  PetscReal all[MAX_STRAINS];

  PetscFunctionBeginUser;
  *e = (Eigenstrain){.across = 0};
  if (!SceneBodyHasEigenstrain(scene, SceneMaterialBody(scene, material))) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EigenstrainEvaluateAll_Private(scene, material, x, all));
  MaterialPickStrains(scene->model, all, e->strain);
  /* sigma_zz = nu (sigma_xx + sigma_yy) - E eps_0,zz keeps eps_zz at 0; an anisotropic body has no
     eps_0,zz */
  if (scene->model == MODEL_PLANE_STRAIN && all[2] != 0.) {
    const PetscReal young = 2. * (1. + poisson) * C[8];

    for (PetscInt s = 0; s < 2; s++) e->strain[s] += poisson * all[2];
    e->across        = young * all[2];
    e->across_energy = young * PetscSqr(all[2]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A cell with its points and the strains without stress there. */
typedef struct {
  PetscInt           dim, nn, n, num_strains, num; /* nodes, displacements, strains, points */
  const PetscInt    *nodes;
  const ElementRule *rule;
  PetscReal   x[ELEMENT_MAX_POINTS * 3], w[ELEMENT_MAX_POINTS]; /* [num][dim]; with det J and the measure [num] */
  PetscReal   grad[ELEMENT_MAX_POINTS * MAX_CELL_DOFS];         /* [num][nn][dim] */
  PetscReal   C[ELEMENT_MAX_POINTS][MAX_STRAINS * MAX_STRAINS]; /* without the bulk modulus where there is a Pi */
  PetscReal   bulk[ELEMENT_MAX_POINTS];                         /* of cells with a Pi */
  Eigenstrain e[ELEMENT_MAX_POINTS];
  Dilatation  pi;
  PetscReal   parts[DILATATION_MAX_FUNCTIONS]; /* of theta_0 */
} Cell;

/* parts_a = int q_a tr eps_0 */
static void EigenstrainSetParts_Private(const Cell *cell, PetscReal parts[])
{
  PetscReal q_a[DILATATION_MAX_FUNCTIONS];

  for (PetscInt a = 0; a < cell->pi.num; a++) parts[a] = 0;
  for (PetscInt q = 0; q < cell->num && cell->pi.num; q++) {
    DilatationShape(&cell->pi, &cell->x[q * cell->dim], q_a);
    for (PetscInt a = 0; a < cell->pi.num; a++)
      parts[a] += cell->w[q] * q_a[a] * MaterialDilatation(cell->num_strains, cell->e[q].strain);
  }
}

static PetscErrorCode EigenstrainSetCell_Private(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                                 Cell *cell)
{
  const PetscInt material = level->cell_material[c];
  PetscReal      X[MAX_CELL_DOFS], poisson;

  PetscFunctionBeginUser;
  cell->dim         = level->dim;
  cell->nn          = ElementNumNodes(rule->type);
  cell->n           = cell->nn * cell->dim;
  cell->num_strains = MaterialNumStrains(scene->model);
  cell->num         = rule->num;
  cell->nodes       = &level->cell_nodes[level->cell_start[c]];
  cell->rule        = rule;
  VolumeStrainCoordinates(level, c, X);
  PetscCall(ElasticityDilatation(scene, level, c, rule, &cell->pi));
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal *x = &cell->x[q * cell->dim];

    cell->w[q] = rule->weight[q] * ElementRuleMap(rule, q, X, x, &cell->grad[q * cell->n]);
    cell->w[q] *= SceneMeasure(scene, x);
    PetscCall(ElasticityHooke(scene, material, x, cell->C[q], &poisson));
    PetscCall(EigenstrainEvaluate(scene, material, x, cell->C[q], poisson, &cell->e[q]));
    cell->bulk[q] = cell->pi.num ? MaterialTakeBulk(cell->num_strains, cell->C[q]) : 0;
  }
  EigenstrainSetParts_Private(cell, cell->parts);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenstrainDilatation(Scene scene, const Level *level, PetscInt c, const ElementRule *rule,
                                     const Dilatation *pi, PetscReal parts[])
{
  Cell *cell;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < pi->num; a++) parts[a] = 0;
  if (!pi->num || !SceneBodyHasEigenstrain(scene, level->cell_body[c])) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&cell));
  PetscCall(EigenstrainSetCell_Private(scene, level, c, rule, cell));
  PetscCall(PetscArraycpy(parts, cell->parts, pi->num));
  PetscCall(PetscFree(cell));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* B at point q. [out] B - [num_strains][n] */
static void EigenstrainGetStrainMatrix_Private(const Cell *cell, PetscBool ring, PetscInt q, PetscReal B[])
{
  PetscReal hoop[ELEMENT_MAX_NODES];

  for (PetscInt i = 0; ring && i < cell->nn; i++) hoop[i] = cell->rule->phi[q * cell->nn + i] / cell->x[q * cell->dim];
  ElementStrainMatrix(cell->dim, cell->nn, &cell->grad[q * cell->n], ring ? hoop : NULL, B);
}

/* theta_0 at point q. [out] q_a - functions of Pi there */
static PetscReal EigenstrainGetChange_Private(const Cell *cell, PetscInt q, PetscReal q_a[])
{
  PetscReal change = 0;

  DilatationShape(&cell->pi, &cell->x[q * cell->dim], q_a);
  for (PetscInt a = 0; a < cell->pi.num; a++) change += q_a[a] * cell->parts[a];
  return change;
}

/* fe += the loads of one cell. */
static void EigenstrainAddCell_Private(Scene scene, const Cell *cell, PetscScalar fa[])
{
  const PetscInt  n = cell->n, ns = cell->num_strains;
  const PetscBool ring = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  PetscReal       B[MAX_STRAINS * MAX_CELL_DOFS], fe[MAX_CELL_DOFS] = {0}, q_a[DILATATION_MAX_FUNCTIONS];

  for (PetscInt q = 0; q < cell->num; q++) {
    EigenstrainGetStrainMatrix_Private(cell, ring, q, B);
    for (PetscInt r = 0; r < ns; r++) {
      PetscReal stress = 0;

      for (PetscInt s = 0; s < ns; s++) stress += cell->C[q][r * ns + s] * cell->e[q].strain[s];
      for (PetscInt i = 0; i < n; i++) fe[i] += cell->w[q] * B[r * n + i] * stress;
    }
    if (cell->pi.num) {
      const PetscReal pressure = cell->w[q] * cell->bulk[q] * EigenstrainGetChange_Private(cell, q, q_a);

      for (PetscInt a = 0; a < cell->pi.num; a++)
        for (PetscInt i = 0; i < n; i++) fe[i] += pressure * q_a[a] * cell->pi.rows[a * n + i];
    }
  }
  for (PetscInt i = 0; i < n; i++) fa[cell->nodes[i / cell->dim] * cell->dim + i % cell->dim] += fe[i];
}

/* Whether any body has such strains. */
static PetscBool EigenstrainIsAny_Private(Scene scene)
{
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    if (SceneBodyHasEigenstrain(scene, b)) return PETSC_TRUE;
  return PETSC_FALSE;
}

PetscErrorCode EigenstrainAddLoads(Scene scene, Level *level, PetscScalar fa[])
{
  ElementRule *rules;
  Cell        *cell;

  PetscFunctionBeginUser;
  if (!EigenstrainIsAny_Private(scene)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscNew(&cell));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (!SceneBodyHasEigenstrain(scene, level->cell_body[c])) continue;
    PetscCall(EigenstrainSetCell_Private(scene, level, c, &rules[level->cell_type[c]], cell));
    EigenstrainAddCell_Private(scene, cell, fa);
  }
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -1/2 H'H at point q, by which Green's strain is more than that of a displacement. [in] u - local form */
static void EigenstrainSetNeglected_Private(Scene scene, Cell *cell, PetscInt q, const PetscScalar u[])
{
  const PetscInt   dim  = cell->dim;
  const PetscReal *grad = &cell->grad[q * cell->n];
  PetscReal        H[9] = {0}, all[MAX_STRAINS] = {0}, around = 0;

  for (PetscInt i = 0; i < cell->nn; i++) {
    const PetscScalar *v = &u[cell->nodes[i] * dim];

    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt j = 0; j < dim; j++) H[3 * k + j] += PetscRealPart(v[k]) * grad[i * dim + j];
    if (scene->model == MODEL_AXISYMMETRIC)
      around += PetscRealPart(v[0]) * cell->rule->phi[q * cell->nn + i] / cell->x[q * dim];
  }
  H[8] += around;
  for (PetscInt k = 0; k < 3; k++) {
    for (PetscInt s = 0; s < 3; s++) {
      all[s] -= 0.5 * PetscSqr(H[3 * k + s]);
      all[3 + s] -= H[3 * k + (s + 1) % 3] * H[3 * k + (s + 2) % 3];
    }
  }
  cell->e[q] = (Eigenstrain){.across = 0};
  MaterialPickStrains(scene->model, all, cell->e[q].strain);
}

PetscErrorCode EigenstrainAddNeglected(Scene scene, Level *level, Vec u, PetscScalar fa[])
{
  ElementRule       *rules;
  Cell              *cell;
  const PetscScalar *ua;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscNew(&cell));
  PetscCall(GhostedGetArrayRead(u, &ua));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscCall(EigenstrainSetCell_Private(scene, level, c, &rules[level->cell_type[c]], cell));
    for (PetscInt q = 0; q < cell->num; q++) EigenstrainSetNeglected_Private(scene, cell, q, ua);
    EigenstrainSetParts_Private(cell, cell->parts);
    EigenstrainAddCell_Private(scene, cell, fa);
  }
  PetscCall(GhostedRestoreArrayRead(u, &ua));
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenstrainCheck(Scene scene, Level *level)
{
  PetscFunctionBeginUser;
  for (PetscInt m = 0; m < scene->num_bodies + scene->num_regions; m++) {
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->temperature));
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->expansion));
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->initial_strain));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The energy of a cell with displacement u less eps_0, and that of eps_0 alone. [in] u - local form */
static void EigenstrainAddEnergy_Private(Scene scene, const Cell *cell, const PetscScalar u[], PetscReal *energy,
                                         PetscReal *constant)
{
  const PetscInt  n = cell->n, ns = cell->num_strains;
  const PetscBool ring = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  PetscReal       B[MAX_STRAINS * MAX_CELL_DOFS], ue[MAX_CELL_DOFS], q_a[DILATATION_MAX_FUNCTIONS];

  for (PetscInt i = 0; i < n; i++) ue[i] = PetscRealPart(u[cell->nodes[i / cell->dim] * cell->dim + i % cell->dim]);
  for (PetscInt q = 0; q < cell->num; q++) {
    PetscReal strain[MAX_STRAINS], change = 0, change_0 = 0;

    EigenstrainGetStrainMatrix_Private(cell, ring, q, B);
    for (PetscInt s = 0; s < ns; s++) {
      strain[s] = -cell->e[q].strain[s];
      for (PetscInt i = 0; i < n; i++) strain[s] += B[s * n + i] * ue[i];
    }
    if (cell->pi.num) {
      change_0 = EigenstrainGetChange_Private(cell, q, q_a);
      change   = DilatationEvaluate(&cell->pi, &cell->x[q * cell->dim], ue) - change_0;
    }
    *energy +=
        0.5 * cell->w[q] *
        (MaterialEnergyDensity(ns, cell->C[q], strain) + cell->bulk[q] * PetscSqr(change) + cell->e[q].across_energy);
    *constant += 0.5 * cell->w[q] *
                 (MaterialEnergyDensity(ns, cell->C[q], cell->e[q].strain) + cell->bulk[q] * PetscSqr(change_0) +
                  cell->e[q].across_energy);
  }
}

PetscErrorCode EigenstrainEnergy(Scene scene, Level *level, Vec u, PetscReal energy[], PetscReal *constant)
{
  PetscReal         *sums;
  const PetscScalar *ua;
  ElementRule       *rules;
  Cell              *cell;

  PetscFunctionBeginUser;
  *constant = 0;
  if (!EigenstrainIsAny_Private(scene)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(scene->num_bodies + 1, &sums));
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscNew(&cell));
  PetscCall(GhostedGetArrayRead(u, &ua));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt body = level->cell_body[c];

    if (!SceneBodyHasEigenstrain(scene, body)) continue;
    PetscCall(EigenstrainSetCell_Private(scene, level, c, &rules[level->cell_type[c]], cell));
    EigenstrainAddEnergy_Private(scene, cell, ua, &sums[body], &sums[scene->num_bodies]);
  }
  PetscCall(GhostedRestoreArrayRead(u, &ua));
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(rules));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(scene->num_bodies + 1), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    if (SceneBodyHasEigenstrain(scene, b)) energy[b] = sums[b];
  *constant = sums[scene->num_bodies];
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* int sigma : a a' and int a a' : C a a' over one cell. [in] u - local form; [in,out] sums - [2] */
static void EigenstrainAddAxial_Private(Scene scene, const Cell *cell, const PetscReal axial[], const PetscScalar u[],
                                        PetscReal sums[])
{
  const PetscInt  n = cell->n, ns = cell->num_strains;
  const PetscBool ring  = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  const PetscReal trace = MaterialDilatation(ns, axial); // Pi keeps what is constant
  PetscReal       B[MAX_STRAINS * MAX_CELL_DOFS], ue[MAX_CELL_DOFS], q_a[DILATATION_MAX_FUNCTIONS];

  for (PetscInt i = 0; i < n; i++) ue[i] = PetscRealPart(u[cell->nodes[i / cell->dim] * cell->dim + i % cell->dim]);
  for (PetscInt q = 0; q < cell->num; q++) {
    PetscReal strain[MAX_STRAINS], change = 0;

    EigenstrainGetStrainMatrix_Private(cell, ring, q, B);
    for (PetscInt s = 0; s < ns; s++) {
      strain[s] = -cell->e[q].strain[s];
      for (PetscInt i = 0; i < n; i++) strain[s] += B[s * n + i] * ue[i];
    }
    if (cell->pi.num)
      change = DilatationEvaluate(&cell->pi, &cell->x[q * cell->dim], ue) - EigenstrainGetChange_Private(cell, q, q_a);
    for (PetscInt r = 0; r < ns; r++) {
      for (PetscInt s = 0; s < ns; s++) {
        sums[0] += cell->w[q] * axial[r] * cell->C[q][r * ns + s] * strain[s];
        sums[1] += cell->w[q] * axial[r] * cell->C[q][r * ns + s] * axial[s];
      }
    }
    sums[0] += cell->w[q] * cell->bulk[q] * trace * change;
    sums[1] += cell->w[q] * cell->bulk[q] * PetscSqr(trace);
  }
}

/* The extent of a body along its axis. Collective. */
static PetscErrorCode EigenstrainGetLength_Private(const Level *level, PetscInt body, const PetscReal axis[],
                                                   PetscReal *length)
{
  PetscReal ends[2] = {-PETSC_MAX_REAL, -PETSC_MAX_REAL};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscReal along = 0;

    if (level->node_body[i] != body) continue;
    for (PetscInt k = 0; k < level->dim; k++) along += axis[k] * level->coords[i * level->dim + k];
    ends[0] = PetscMax(ends[0], along);
    ends[1] = PetscMax(ends[1], -along);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPIU_REAL, MPIU_MAX, level->comm));
  *length = ends[0] + ends[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EigenstrainAxialForce(Scene scene, Level *level, PetscInt body, Vec u, PetscReal *force,
                                     PetscReal *stiffness)
{
  const SceneBody   *b       = &scene->bodies[body];
  PetscReal          sums[2] = {0, 0}, all[MAX_STRAINS], axial[MAX_STRAINS], length = 1;
  const PetscScalar *ua;
  ElementRule       *rules;
  Cell              *cell;

  PetscFunctionBeginUser;
  EigenstrainGetAxial_Private(b, all);
  MaterialPickStrains(scene->model, all, axial);
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(PetscNew(&cell));
  PetscCall(GhostedGetArrayRead(u, &ua));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_body[c] != body) continue;
    PetscCall(EigenstrainSetCell_Private(scene, level, c, &rules[level->cell_type[c]], cell));
    EigenstrainAddAxial_Private(scene, cell, axial, ua, sums);
  }
  PetscCall(GhostedRestoreArrayRead(u, &ua));
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(rules));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(EigenstrainGetLength_Private(level, body, b->axis, &length));
  *force     = sums[0] / length;
  *stiffness = sums[1] / length;
  PetscFunctionReturn(PETSC_SUCCESS);
}
