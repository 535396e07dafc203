/* elasticity.c -- stiffness K and load f of all bodies, before any boundary condition.

   K_ij = int B_i' C B_j, cell by cell over the level's tables, with the quadrature that is exact on parallelograms.
   Expressions are evaluated at quadrature points; plain numbers once per body. */
#include <mortise/compat.h>
#include <mortise/elasticity.h>
#include <mortise/fault.h>
#include "loads.h"

enum { MAX_STRAINS = 6, MAX_UPPER = 21, MAX_CELL_DOFS = 3 * ELEMENT_MAX_NODES };

/* A Hooke tensor whose smallest eigenvalue is below this share of the largest is not positive definite in double precision. */
static const PetscReal DEFINITE_TOLERANCE = 1e-14;

PetscErrorCode ElasticityHooke(Scene scene, PetscInt body, const PetscReal x[], PetscReal C[], PetscReal *poisson)
{
  const SceneBody *b = &scene->bodies[body];
  PetscReal        young, upper[MAX_UPPER];

  PetscFunctionBeginUser;
  if (b->stiffness) {
    PetscCall(ExpressionEvaluate(b->stiffness, scene->dim, x, upper));
    MaterialAnisotropic(scene->model, upper, b->angle, C);
    *poisson = NAN;
  } else {
    PetscCall(ExpressionEvaluate(b->young, scene->dim, x, &young));
    PetscCall(ExpressionEvaluate(b->poisson, scene->dim, x, poisson));
    MaterialIsotropic(scene->model, young, *poisson, C);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a body's Hooke tensor is the same everywhere. */
static PetscBool HookeIsConstant_Private(const SceneBody *body)
{
  if (body->stiffness) return ExpressionIsConstant(body->stiffness);
  return (PetscBool)(ExpressionIsConstant(body->young) && ExpressionIsConstant(body->poisson));
}

/* Writes a sentence if moduli that vary in space are not those of an elastic body at x. */
static PetscErrorCode HookeCheck_Private(Scene scene, PetscInt body, const PetscReal x[], const PetscReal C[],
                                         char sentence[], size_t len)
{
  const SceneBody *b = &scene->bodies[body];

  PetscFunctionBeginUser;
  if (sentence[0] || MaterialDefiniteness(MaterialNumStrains(scene->model), C) > DEFINITE_TOLERANCE)
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSNPrintf(sentence, len,
                          "%s gives moduli that are not positive definite at (%g, %g); an elastic body needs "
                          "E > 0 and -1 < nu < 0.5, or a positive definite Hooke tensor, at every point",
                          ExpressionOption(b->stiffness ? b->stiffness : b->young), (double)x[0], (double)x[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Ke += w B'CB. [in] B - [ns][n]; [in] C - [ns][ns]; [in,out] Ke - [n][n] */
static void AddStiffness_Private(PetscInt ns, PetscInt n, const PetscReal B[], const PetscReal C[], PetscReal w,
                                 PetscReal Ke[])
{
  PetscReal CB[MAX_STRAINS * MAX_CELL_DOFS];

  for (PetscInt s = 0; s < ns; s++) {
    for (PetscInt j = 0; j < n; j++) {
      PetscReal sum = 0;
      for (PetscInt r = 0; r < ns; r++) sum += C[s * ns + r] * B[r * n + j];
      CB[s * n + j] = w * sum;
    }
  }
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt s = 0; s < ns; s++) {
      const PetscReal Bsi = B[s * n + i];
      if (Bsi == 0.0) continue; // half of B is zero
      for (PetscInt j = 0; j < n; j++) Ke[i * n + j] += Bsi * CB[s * n + j];
    }
  }
}

/* Corner coordinates of a cell, [num_nodes][dim]. */
static void CellCoordinates_Private(const Level *level, PetscInt c, PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscInt  n     = level->cell_start[c + 1] - level->cell_start[c];

  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < level->dim; k++) X[i * level->dim + k] = level->coords[nodes[i] * level->dim + k];
  }
}

/* Ke of one cell; C is the body's constant tensor, or NULL to evaluate it at every point. */
static PetscErrorCode CellStiffness_Private(Scene scene, Level *level, PetscInt c, const PetscReal C[], PetscReal Ke[],
                                            char sentence[], size_t len)
{
  const ElementType type = (ElementType)level->cell_type[c];
  const PetscInt    dim = level->dim, nn = ElementNumNodes(type), n = nn * dim, ns = MaterialNumStrains(scene->model);
  PetscReal         X[MAX_CELL_DOFS], xi[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES];
  PetscReal         grad[MAX_CELL_DOFS], B[MAX_STRAINS * MAX_CELL_DOFS], Cx[MAX_STRAINS * MAX_STRAINS], x[3], nu;
  const PetscInt    nq = ElementQuadrature(type, ElementStiffnessDegree(type), xi, w);

  PetscFunctionBeginUser;
  CellCoordinates_Private(level, c, X);
  PetscCall(PetscArrayzero(Ke, n * n));
  for (PetscInt q = 0; q < nq; q++) {
    const PetscReal det = ElementMap(type, X, &xi[q * dim], x, phi, grad);
    if (!C) {
      PetscCall(ElasticityHooke(scene, level->cell_body[c], x, Cx, &nu));
      PetscCall(HookeCheck_Private(scene, level->cell_body[c], x, Cx, sentence, len));
    }
    ElementStrainMatrix(dim, nn, grad, B);
    AddStiffness_Private(ns, n, B, C ? C : Cx, w[q] * det * scene->thickness, Ke);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds every cell of this rank to K. */
static PetscErrorCode AssembleCells_Private(Scene scene, Level *level, Mat K)
{
  PetscReal       C[MAX_STRAINS * MAX_STRAINS], Ke[MAX_CELL_DOFS * MAX_CELL_DOFS], nu;
  const PetscReal origin[3]     = {0, 0, 0};
  PetscInt        body          = -1, rows[ELEMENT_MAX_NODES];
  PetscBool       constant      = PETSC_FALSE;
  char            sentence[512] = "";

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]],
                   n      = level->cell_start[c + 1] - level->cell_start[c];
    if (level->cell_body[c] != body) { // cells of a body follow one another
      body     = level->cell_body[c];
      constant = HookeIsConstant_Private(&scene->bodies[body]);
      if (constant) PetscCall(ElasticityHooke(scene, body, origin, C, &nu));
    }
    PetscCall(CellStiffness_Private(scene, level, c, constant ? C : NULL, Ke, sentence, sizeof(sentence)));
    for (PetscInt i = 0; i < n; i++) rows[i] = level->node_global[nodes[i]];
    PetscCall(MatSetValuesBlocked(K, n, rows, n, rows, Ke, ADD_VALUES));
  }
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCall(ExpressionCheck(level->comm, scene->bodies[b].young));
    PetscCall(ExpressionCheck(level->comm, scene->bodies[b].poisson));
    PetscCall(ExpressionCheck(level->comm, scene->bodies[b].stiffness));
  }
  PetscCall(FaultCheck(level->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityAssemble(Scene scene, Level *level, Mat *K, Vec *f)
{
  PetscFunctionBeginUser;
  PetscCall(LevelCreateMat(level, level->dim, K));
  PetscCall(AssembleCells_Private(scene, level, *K));
  PetscCall(MatAssemblyBegin(*K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(LevelCreateVec(level, level->dim, f));
  PetscCall(LoadsAssemble(scene, level, *f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityBodyEnergy(Scene scene, Level *level, Mat K, Vec u, PetscReal energy[])
{
  const PetscScalar *ua, *ra;
  Vec                Ku;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &Ku));
  PetscCall(MatMult(K, u, Ku));
  PetscCall(PetscArrayzero(energy, scene->num_bodies));
  PetscCall(VecGetArrayRead(u, &ua));
  PetscCall(VecGetArrayRead(Ku, &ra));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    for (PetscInt k = 0; k < level->dim; k++) {
      energy[level->node_body[i]] += 0.5 * PetscRealPart(ua[i * level->dim + k] * ra[i * level->dim + k]);
    }
  }
  PetscCall(VecRestoreArrayRead(Ku, &ra));
  PetscCall(VecRestoreArrayRead(u, &ua));
  PetscCall(VecDestroy(&Ku));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, energy, (PetscMPIInt)scene->num_bodies, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
