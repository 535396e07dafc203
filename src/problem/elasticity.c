/* elasticity.c -- stiffness K and load f of all bodies, before any boundary condition.

   K_ij^kl = int d_m phi_i C_kmln d_n phi_j, cell by cell over the level's tables, with the quadrature that is
   exact on parallelograms. This is int B_i' C B_j without the zeros of B. Where C is the same in the whole
   cell, the products of derivatives are summed over the points first, and C is applied once. Axisymmetric
   cells add the terms of the hoop strain phi_j / r u_j (eq. 8.4). Cells of nearly incompressible bodies have
   C without its bulk modulus there, which multiplies the projected change of volume Pi div u instead
   (eq. 9.1). Expressions are evaluated at quadrature points; plain numbers once per material. */
#include "base/compat.h"
#include "problem/conforming.h"
#include "problem/elasticity.h"
#include "base/usererror.h"
#include "kernel/wide.h"
#include "problem/cellsums.h"
#include "problem/congruentcells.h"
#include "problem/loads.h"
#include "problem/volumestrain.h"

enum {
  MAX_STRAINS   = 6,
  MAX_UPPER     = 21,
  MAX_TENSOR    = 81, /* C_kmln in 3D */
  MAX_SQUARE    = 9,  /* strains as a tensor */
  MAX_PLANE     = 4,  /* of a plane */
  MAX_CELL_DOFS = 3 * ELEMENT_MAX_NODES
};

/* A Hooke tensor whose smallest eigenvalue is below this share of the largest is not positive definite in
   double precision. */
static const PetscReal DEFINITE_TOLERANCE = 1e-14;

PetscErrorCode ElasticityHooke(Scene scene, PetscInt material, const PetscReal x[], PetscReal C[], PetscReal *poisson)
{
  const SceneMaterial *m = SceneGetMaterial(scene, material);
  PetscReal            young, upper[MAX_UPPER];

  PetscFunctionBeginUser;
  if (m->stiffness) {
    PetscCall(ExpressionEvaluate(m->stiffness, scene->dim, x, upper));
    MaterialAnisotropic(scene->model, upper, m->angle, C);
    *poisson = NAN;
  } else {
    PetscCall(ExpressionEvaluate(m->young, scene->dim, x, &young));
    PetscCall(ExpressionEvaluate(m->poisson, scene->dim, x, poisson));
    MaterialIsotropic(scene->model, young, *poisson, C);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool ElasticityHookeIsConstant(Scene scene, PetscInt material)
{
  const SceneMaterial *m = SceneGetMaterial(scene, material);

  if (m->stiffness) return ExpressionIsConstant(m->stiffness);
  return (PetscBool)(ExpressionIsConstant(m->young) && ExpressionIsConstant(m->poisson));
}

/* The first fault of the moduli. */
typedef struct {
  char text[512];
} Sentence;

/* Writes a sentence if moduli that vary in space are not those of an elastic body at x. */
static PetscErrorCode ElasticityCheckHooke_Private(Scene scene, PetscInt material, const PetscReal x[],
                                                   const PetscReal C[], PetscReal poisson, Sentence *sentence)
{
  const SceneMaterial *m     = SceneGetMaterial(scene, material);
  const PetscReal      end   = scene->model == MODEL_PLANE_STRESS ? 0.5 : MATERIAL_POISSON_END;
  char                 z[32] = "";

  PetscFunctionBeginUser;
  if (sentence->text[0]) PetscFunctionReturn(PETSC_SUCCESS);
  if (!(poisson >= end) && MaterialDefiniteness(MaterialNumStrains(scene->model), C) > DEFINITE_TOLERANCE)
    PetscFunctionReturn(PETSC_SUCCESS);
  if (scene->dim == 3) PetscCall(PetscSNPrintf(z, sizeof(z), ", %g", (double)x[2]));
  PetscCall(PetscSNPrintf(sentence->text, sizeof(sentence->text),
                          "%s gives moduli that are not positive definite at (%g, %g%s); an elastic body needs "
                          "E > 0 and -1 < nu < %.7g, or a positive definite Hooke tensor, at every point",
                          ExpressionOption(m->stiffness ? m->stiffness : m->young), (double)x[0], (double)x[1], z,
                          (double)end));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* C_kmln of a Hooke tensor, and the moduli of the hoop strain of axisymmetric models. */
typedef struct {
  PetscBool isotropic;
  PetscReal lambda, mu;                 /* of an isotropic one */
  PetscReal tensor[MAX_TENSOR];         /* C_kmln as [m][n][k][l] */
  PetscReal hoop[MAX_PLANE], hoop_hoop; /* C_zz,ln [2][2] and C_zz,zz */
} Moduli;

/* From C in Voigt's order: eps_ln counts twice among engineering shears, once for eps_nl. */
static void ElasticitySetModuli_Private(ModelKind model, const PetscReal C[], PetscBool isotropic, Moduli *moduli)
{
  static const PetscInt plane[MAX_PLANE] = {0, 2, 2, 1}, ring[MAX_PLANE] = {0, 3, 3, 1};
  static const PetscInt solid[MAX_SQUARE] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  const PetscInt        ns = MaterialNumStrains(model), dim = model == MODEL_SOLID ? 3 : 2, square = dim * dim, zz = 2;
  const PetscInt       *voigt = model == MODEL_SOLID ? solid : (model == MODEL_AXISYMMETRIC ? ring : plane);

  for (PetscInt mn = 0; mn < square; mn++) {
    for (PetscInt kl = 0; kl < square; kl++) {
      const PetscInt km = kl / dim * dim + mn / dim, ln = kl % dim * dim + mn % dim;
      moduli->tensor[mn * square + kl] = C[voigt[km] * ns + voigt[ln]];
    }
  }
  moduli->isotropic = isotropic;
  moduli->lambda    = C[1];
  moduli->mu        = C[ns * ns - 1];
  if (model != MODEL_AXISYMMETRIC) return;
  for (PetscInt ln = 0; ln < MAX_PLANE; ln++) moduli->hoop[ln] = C[zz * ns + voigt[ln]];
  moduli->hoop_hoop = C[zz * ns + zz];
}

/* What is the same in all cells of a material whose moduli are. */
typedef struct {
  PetscBool constant;
  Moduli    whole, shear;  /* with and without the bulk modulus */
  PetscReal bulk, poisson; /* NAN where nothing restrains changes of volume */
} Law;

static PetscErrorCode ElasticitySetLaw_Private(Scene scene, PetscInt material, Law *law)
{
  const PetscReal origin[3] = {0, 0, 0};
  const PetscBool isotropic = (PetscBool)!SceneGetMaterial(scene, material)->stiffness;
  PetscReal       C[MAX_STRAINS * MAX_STRAINS];

  PetscFunctionBeginUser;
  law->constant = ElasticityHookeIsConstant(scene, material);
  if (!law->constant) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ElasticityHooke(scene, material, origin, C, &law->poisson));
  ElasticitySetModuli_Private(scene->model, C, isotropic, &law->whole);
  if (scene->model == MODEL_PLANE_STRESS) law->poisson = NAN;
  law->bulk = MaterialTakeBulk(MaterialNumStrains(scene->model), C);
  ElasticitySetModuli_Private(scene->model, C, isotropic, &law->shear);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* G_im,jn = sum_q w d_m phi_i d_n phi_j for i <= j. [in] grad - [num][n]; [in] w - [num]; [out] G - [n][n] */
static inline void ElasticityGetProducts_Private(PetscInt dim, PetscInt n, PetscInt num, const PetscReal *restrict grad,
                                                 const PetscReal w[], PetscReal *restrict G)
{
  for (PetscInt r = 0; r < n; r++) {
    PetscReal *restrict row = &G[r * n];
    const PetscInt begin    = r - r % dim;

    for (PetscInt c = begin; c < n; c++) row[c] = 0;
    for (PetscInt q = 0; q < num; q++) {
      const PetscReal a = w[q] * grad[q * n + r];
      for (PetscInt c = begin; c < n; c++) row[c] += a * grad[q * n + c];
    }
  }
}

/* Ke_ik,jl += C_kmln G_im,jn for i <= j. To be inlined where dim is known, so that its loops are unrolled.
   [in] G - [n][n]; [in,out] Ke - [n][n] */
static inline void ElasticityContract_Private(PetscInt dim, PetscInt n, const PetscReal *restrict tensor,
                                              const PetscReal *restrict G, PetscReal *restrict Ke)
{
  const PetscInt square = dim * dim;

  for (PetscInt i = 0; i < n; i += dim) {
    for (PetscInt j = i; j < n; j += dim) {
      PetscReal block[MAX_SQUARE] = {0};

      for (PetscInt mn = 0; mn < square; mn++) {
        const PetscReal g = G[(i + mn / dim) * n + j + mn % dim];
        for (PetscInt kl = 0; kl < square; kl++) block[kl] += tensor[mn * square + kl] * g;
      }
      for (PetscInt kl = 0; kl < square; kl++) Ke[(i + kl / dim) * n + j + kl % dim] += block[kl];
    }
  }
}

/* The same for C_kmln = lambda d_km d_ln + mu (d_kl d_mn + d_kn d_ml), in a quarter of the operations. */
static inline void ElasticityContractIsotropic_Private(PetscInt dim, PetscInt n, PetscReal lambda, PetscReal mu,
                                                       const PetscReal *restrict G, PetscReal *restrict Ke)
{
  for (PetscInt i = 0; i < n; i += dim) {
    for (PetscInt j = i; j < n; j += dim) {
      PetscReal trace = 0;

      for (PetscInt m = 0; m < dim; m++) trace += G[(i + m) * n + j + m];
      for (PetscInt k = 0; k < dim; k++) {
        for (PetscInt l = 0; l < dim; l++)
          Ke[(i + k) * n + j + l] += lambda * G[(i + k) * n + j + l] + mu * G[(i + l) * n + j + k];
        Ke[(i + k) * n + j + k] += mu * trace;
      }
    }
  }
}

/* Ke += the stiffness of some points of a cell with the same moduli. [in] grad - [num][n]; [in] w - [num] */
MORTISE_WIDE static void ElasticityAddStiffness_Private(PetscInt dim, PetscInt n, PetscInt num, const Moduli *moduli,
                                                        const PetscReal grad[], const PetscReal w[], PetscReal Ke[])
{
  PetscReal G[MAX_CELL_DOFS * MAX_CELL_DOFS];

  if (dim == 2) {
    ElasticityGetProducts_Private(2, n, num, grad, w, G);
    if (moduli->isotropic)
      ElasticityContractIsotropic_Private(2, n, moduli->lambda, moduli->mu, G, Ke);
    else
      ElasticityContract_Private(2, n, moduli->tensor, G, Ke);
  } else {
    ElasticityGetProducts_Private(3, n, num, grad, w, G);
    if (moduli->isotropic)
      ElasticityContractIsotropic_Private(3, n, moduli->lambda, moduli->mu, G, Ke);
    else
      ElasticityContract_Private(3, n, moduli->tensor, G, Ke);
  }
}

/* Ke_ij^kl += w (h_i^k t_j^l + t_i^k h_j^l) for i <= j. h_j^l is the hoop strain of a unit displacement.
   t_j^l is its hoop stress, with half of the term of the hoop strain itself, since the sum counts that twice.
   [in] phi - [nn]; [in] grad - [nn][2] */
static void ElasticityAddHoop_Private(PetscInt nn, const Moduli *moduli, PetscReal r, const PetscReal phi[],
                                      const PetscReal grad[], PetscReal w, PetscReal Ke[])
{
  const PetscInt row = nn * 2;
  PetscReal      h[2 * ELEMENT_MAX_NODES], t[2 * ELEMENT_MAX_NODES];

  for (PetscInt j = 0; j < nn; j++) {
    h[2 * j]     = phi[j] / r;
    h[2 * j + 1] = 0;
    for (PetscInt l = 0; l < 2; l++) {
      t[2 * j + l] = 0.5 * moduli->hoop_hoop * h[2 * j + l];
      for (PetscInt n = 0; n < 2; n++) t[2 * j + l] += moduli->hoop[2 * l + n] * grad[2 * j + n];
    }
  }
  for (PetscInt i = 0; i < nn; i++) {
    for (PetscInt k = 2 * i; k < 2 * (i + 1); k++) {
      for (PetscInt l = 2 * i; l < row; l++) Ke[k * row + l] += w * (h[k] * t[l] + t[k] * h[l]);
    }
  }
}

/* Workspace for the points of one cell, the first fault of their moduli, and the cells that are kept. */
typedef struct {
  Sentence       sentence;
  CongruentCells known;
  PetscReal      x[ELEMENT_MAX_POINTS * 3], w[ELEMENT_MAX_POINTS],
      bulk[ELEMENT_MAX_POINTS];                        /* [num][dim]; [num]; [num], weighted */
  PetscReal  grad[ELEMENT_MAX_POINTS * MAX_CELL_DOFS]; /* [num][num_nodes][dim] */
  Dilatation pi;
} Work;

/* Ke of one cell. */
static PetscErrorCode ElasticityGetCellStiffness_Private(Scene scene, Level *level, PetscInt c, const ElementRule *rule,
                                                         const Law *law, Work *work, PetscReal Ke[])
{
  const PetscInt  dim = level->dim, nn = ElementNumNodes(rule->type), n = nn * dim, material = level->cell_material[c];
  const PetscInt  num_strains = MaterialNumStrains(scene->model);
  const PetscBool ring        = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  PetscReal       X[MAX_CELL_DOFS], C[MAX_STRAINS * MAX_STRAINS], nu;
  const Moduli   *moduli;
  DilatationKind  kind;
  Moduli          local;

  PetscFunctionBeginUser;
  VolumeStrainCoordinates(level, c, X);
  PetscCall(PetscArrayzero(Ke, n * n));
  nu   = law->poisson;
  kind = DilatationChoose(rule->type, nu);
  if (!law->constant) PetscCall(ElasticityDilatationKind(scene, level, c, rule, &kind, &nu));
  if (kind == DILATATION_LOCKS && !work->sentence.text[0])
    VolumeStrainLockingText(scene, material, rule->type, nu, work->sentence.text, sizeof(work->sentence.text));
  moduli = !law->constant ? &local : (kind ? &law->shear : &law->whole);
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal *grad = &work->grad[q * n], *x = &work->x[q * dim];

    work->w[q] = rule->weight[q] * ElementRuleMap(rule, q, X, law->constant && !ring && !kind ? NULL : x, grad);
    work->w[q] *= SceneMeasure(scene, x);
    work->bulk[q] = work->w[q] * law->bulk;
    if (!law->constant) {
      PetscCall(ElasticityHooke(scene, material, x, C, &nu));
      PetscCall(ElasticityCheckHooke_Private(scene, material, x, C, nu, &work->sentence));
      if (kind) work->bulk[q] = work->w[q] * MaterialTakeBulk(num_strains, C);
      ElasticitySetModuli_Private(scene->model, C, (PetscBool)!SceneGetMaterial(scene, material)->stiffness, &local);
      ElasticityAddStiffness_Private(dim, n, 1, &local, grad, &work->w[q], Ke);
    }
    if (ring) ElasticityAddHoop_Private(nn, moduli, x[0], &rule->phi[q * nn], grad, work->w[q], Ke);
  }
  if (law->constant) ElasticityAddStiffness_Private(dim, n, rule->num, moduli, work->grad, work->w, Ke);
  if (kind) {
    VolumeStrainDilatation(scene, kind, rule, work->x, work->w, work->grad, &work->pi);
    DilatationStiffness(&work->pi, rule->num, work->x, work->bulk, Ke);
  }
  for (PetscInt i = 0; i < n; i++) { // the lower triangle; blocks on the diagonal are whole
    for (PetscInt j = 0; j < i; j++) Ke[i * n + j] = Ke[j * n + i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether translated cells have the same matrix: moduli are the same everywhere, and no radius counts. They
   differ by the rounding of positions. In nearly incompressible cells it counts bulk over shear modulus
   times. */
static PetscBool ElasticityIsInvariant_Private(Scene scene, const Law *law, ElementType type)
{
  return (PetscBool)(law->constant && scene->model != MODEL_AXISYMMETRIC && !DilatationChoose(type, law->poisson));
}

/* Takes the forces of translations, which are rounding, off the diagonal blocks. Of different cells they
   cancel; of a thousand equal ones they would add up to a support. */
static void ElasticityBalance_Private(PetscInt nn, PetscInt dim, PetscReal Ke[])
{
  const PetscInt n = nn * dim;

  for (PetscInt i = 0; i < nn; i++) {
    PetscReal force[3][3] = {{0}};

    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt l = 0; l < dim; l++) {
        for (PetscInt j = 0; j < nn; j++) force[k][l] += Ke[(i * dim + k) * n + j * dim + l];
      }
    }
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt l = 0; l < dim; l++) Ke[(i * dim + k) * n + i * dim + l] -= (force[k][l] + force[l][k]) / 2;
    }
  }
}

/* Adds the matrix of one cell, or of the first of its translations. */
static PetscErrorCode ElasticityAddCell_Private(Scene scene, Level *level, PetscInt c, const ElementRule *rule,
                                                const Law *law, Work *work, SymmetricBlocks *sums)
{
  const PetscInt   material = level->cell_material[c];
  const PetscBool  keep     = ElasticityIsInvariant_Private(scene, law, rule->type);
  const PetscReal *known    = NULL;
  PetscReal        X[MAX_CELL_DOFS], Ke[MAX_CELL_DOFS * MAX_CELL_DOFS];

  PetscFunctionBeginUser;
  if (keep) {
    VolumeStrainCoordinates(level, c, X);
    known = CongruentCellsFind(work->known, rule->type, material, X);
  }
  if (!known) PetscCall(ElasticityGetCellStiffness_Private(scene, level, c, rule, law, work, Ke));
  if (!known && keep) {
    ElasticityBalance_Private(ElementNumNodes(rule->type), level->dim, Ke);
    CongruentCellsAdd(work->known, rule->type, material, X, Ke);
  }
  CellSumsAdd(level, c, known ? known : Ke, sums);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* K as the sum over all cells. */
static PetscErrorCode ElasticityAssembleCells_Private(Scene scene, Level *level, Mat *K)
{
  PetscInt        num_materials = scene->num_bodies + scene->num_regions;
  ElementRule    *rules;
  Work           *work;
  Law            *laws; // kept for all materials: their cells are in any order
  SymmetricBlocks sums;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(scene, &rules));
  PetscCall(CellSumsCreate(level, &sums));
  PetscCall(PetscNew(&work));
  PetscCall(CongruentCellsCreate(level->dim, &work->known));
  PetscCall(PetscMalloc1(num_materials, &laws));
  for (PetscInt m = 0; m < num_materials; m++) {
    if (m < scene->num_bodies && scene->bodies[m].missing) continue; // all of its cells are in regions
    PetscCall(ElasticitySetLaw_Private(scene, m, &laws[m]));
  }
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscCall(ElasticityAddCell_Private(scene, level, c, &rules[level->cell_type[c]], &laws[level->cell_material[c]],
                                        work, &sums));
  }
  PetscCall(ConformingHold(level, level->node_global, &sums));
  PetscCall(CellSumsFinish(level, level->node_global, &sums, K));
  PetscCall(CongruentCellsDestroy(&work->known));
  PetscCall(PetscFree(rules));
  PetscCall(PetscFree(laws));
  for (PetscInt m = 0; m < num_materials; m++) {
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->young));
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->poisson));
    PetscCall(ExpressionCheck(level->comm, SceneGetMaterial(scene, m)->stiffness));
  }
  PetscCall(UserErrorCheck(level->comm, work->sentence.text));
  PetscCall(PetscFree(work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityAssemble(Scene scene, Level *level, Mat *K, Vec *f)
{
  PetscFunctionBeginUser;
  if (K) PetscCall(ElasticityAssembleCells_Private(scene, level, K));
  PetscCall(LevelCreateVec(level, level->dim, f));
  PetscCall(LoadsAssemble(scene, level, *f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* v = u less the mean displacement of each body (of an axisymmetric one along the axis alone). The energy is
   the same, and large translations cause no cancellation in small strains. */
static PetscErrorCode ElasticityRemoveTranslation_Private(Scene scene, const Level *level, Vec u, Vec v)
{
  const PetscInt dim = level->dim, first = scene->model == MODEL_AXISYMMETRIC ? 1 : 0;
  PetscReal     *sums; /* per body: displacement, number of nodes */
  PetscScalar   *va;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_bodies * (dim + 1), &sums));
  PetscCall(VecCopy(u, v));
  PetscCall(VecGetArray(v, &va));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscReal *sum = &sums[level->node_body[i] * (dim + 1)];

    for (PetscInt k = first; k < dim; k++) sum[k] += PetscRealPart(va[i * dim + k]);
    sum[dim] += 1;
  }
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(scene->num_bodies * (dim + 1)), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscReal *sum = &sums[level->node_body[i] * (dim + 1)];

    for (PetscInt k = first; k < dim; k++) va[i * dim + k] -= sum[k] / sum[dim];
  }
  PetscCall(VecRestoreArray(v, &va));
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ElasticityBodyEnergy(Scene scene, Level *level, Mat K, Vec u, PetscReal energy[])
{
  const PetscScalar *va, *ra;
  Vec                v, Kv;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &v));
  PetscCall(VecDuplicate(u, &Kv));
  PetscCall(ElasticityRemoveTranslation_Private(scene, level, u, v));
  PetscCall(MatMult(K, v, Kv));
  PetscCall(PetscArrayzero(energy, scene->num_bodies));
  PetscCall(VecGetArrayRead(v, &va));
  PetscCall(VecGetArrayRead(Kv, &ra));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    for (PetscInt k = 0; k < level->dim; k++) {
      energy[level->node_body[i]] += 0.5 * PetscRealPart(va[i * level->dim + k] * ra[i * level->dim + k]);
    }
  }
  PetscCall(VecRestoreArrayRead(Kv, &ra));
  PetscCall(VecRestoreArrayRead(v, &va));
  PetscCall(VecDestroy(&Kv));
  PetscCall(VecDestroy(&v));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, energy, (PetscMPIInt)scene->num_bodies, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
