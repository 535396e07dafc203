/* test_multigrid.c -- parts of truncated multigrid against products of assembled matrices. They are the
   inverse of T, smoothing apart, the matrix as a shell, and the coarser levels' own matrices. Held unknowns
   change these, at once or one change after the other. */
#include "base/compat.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/envelopefactor.h"
#include "multigrid/mglevel.h"
#include "problem/coarsestiffness.h"
#include "solve/meshlevels.h"
#include "mesh_scene.h"
#include "solid_scene.h"
#include "uniform.h"

static const PetscReal ROUNDING        = 1e-12; /* of products of matrices whose diagonals are about 1 */
static const PetscReal ROUNDING_SINGLE = 1e-6;  /* the same of numbers in single precision */
static const PetscReal ROUNDING_FACTOR = 1e-5; /* of factors in single precision, of blocks that are weakly supported */

/* Boxes whose meshes do not match. */
typedef enum {
  CASE_QUADS,     /* a block on a block */
  CASE_TRIANGLES, /* the same of order 2, multipliers at vertices, one of the two of triangles */
  CASE_CHAIN,     /* order 2: a mortar side that is shifted itself */
  CASE_OBLIQUE,   /* turned by a third of a right angle, sliding along a support */
  CASE_SOLID,     /* hexahedra on tetrahedra */
  CASE_TIED,      /* glued: coarse spaces are not part of fine ones */
  CASE_COUNT
} Case;

static SceneBody *AddBlock(TestScene *t, const char name[], PetscInt n, const PetscReal lower[3],
                           const PetscReal upper[3])
{
  const PetscInt faces[] = {n, n > 2 ? 2 : 1, 2};

  return SolidSceneAddBox(t, name, faces, lower, upper);
}

static void AddBodies(TestScene *t, Case which)
{
  static const PetscReal corners[][3] = {{0, 0, 0}, {1, 1, 1}, {0, -1, 0}, {2, 0, 1}, {1, 0, 0}, {2, 1, 1}},
                         solid[][3]   = {{0, 0, 0}, {1, 1, 1}, {0, 0, -1}, {1.5, 1, 0}};
  const PetscReal(*x)[3]              = which == CASE_SOLID ? solid : corners;
  const PetscInt order                = which == CASE_TRIANGLES || which == CASE_CHAIN ? 2 : 1;

  if (which == CASE_SOLID)
    SolidSceneInit(t);
  else
    TestSceneInit(t);
  AddBlock(t, "above", 2, x[0], x[1])->simplex = (PetscBool)(which == CASE_TRIANGLES || which == CASE_SOLID);
  AddBlock(t, "below", 3, x[2], x[3]);
  if (which == CASE_CHAIN) AddBlock(t, "beside", 2, corners[4], corners[5]);
  for (PetscInt b = 0; b < t->scene.num_bodies; ++b) {
    t->bodies[b].order = order;
    if (which == CASE_OBLIQUE) TestSceneSetMap(&t->bodies[b], "x*cos(pi/6) - y*sin(pi/6), x*sin(pi/6) + y*cos(pi/6)");
  }
}

static VI CreateVI(TestScene *t, Case which, PetscInt refine, Mesh *mesh)
{
  ScenePair *pair;
  VI         vi;

  AddBodies(t, which);
  t->scene.refine = refine;
  if (which == CASE_OBLIQUE) {
    TestSceneAddBoundary(&t->bodies[0], BOUNDARY_NORMAL, "left", NULL); // meets the contact in a corner
    TestSceneAddBoundary(&t->bodies[1], BOUNDARY_NORMAL, "left", NULL);
  } else {
    const char *value = which == CASE_SOLID ? "0, free, 0" : "0, free";

    TestSceneAddBoundary(&t->bodies[0], BOUNDARY_DISPLACEMENT, "left", value);
    TestSceneAddBoundary(&t->bodies[1], BOUNDARY_DISPLACEMENT, "bottom", which == CASE_SOLID ? "0, 0, 0" : "0, 0");
  }
  pair = TestSceneAddPair(t, "pair", 0, "bottom", 1, "top");
  if (which == CASE_TRIANGLES) pair->multipliers = MULTIPLIERS_VERTICES;
  if (which == CASE_TIED) pair->type = PAIR_TIED;
  if (which == CASE_CHAIN) TestSceneAddPair(t, "other", 1, "top", 2, "bottom")->multipliers = MULTIPLIERS_VERTICES;
  *mesh = TestSceneMesh(t);
  CHECK(!VICreate(&t->scene, *mesh, &vi));
  return vi;
}

static void DestroyVI(TestScene *t, Mesh *mesh, VI *vi)
{
  CHECK(!VIDestroy(vi));
  CHECK(!MeshDestroy(mesh));
  TestSceneFree(t);
}

static void Fill(Vec x)
{
  PetscScalar *a;
  PetscInt     n;

  CHECK(!VecGetLocalSize(x, &n));
  CHECK(!VecGetArray(x, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = Uniform(-1, 1);
  CHECK(!VecRestoreArray(x, &a));
}

/* The largest entry of x - y; x is spoilt. */
static PetscReal Difference(Vec x, Vec y)
{
  PetscReal norm;

  CHECK(!VecAXPY(x, -1, y));
  CHECK(!VecNorm(x, NORM_INFINITY, &norm));
  return norm;
}

/* T^-1 P T x for P = 1 and K, by the product's matrix and factor by factor. */
static void TestInverse(VI vi)
{
  BasisRows inverse;
  PetscInt  num, n;
  Vec       x, Tx, PTx, back, direct;
  Mat       P[2];

  CHECK(!VICreateInverseBasis(vi, &inverse));
  CHECK(inverse.few && vi->T);
  CHECK(!MatGetLocalSize(vi->T, &n, NULL));
  CHECK(!ISGetLocalSize(inverse.rows, &num));
  CHECK(num < n);
  CHECK(!MatCreateVecs(vi->K, &x, &Tx));
  CHECK(!VecDuplicate(x, &PTx));
  CHECK(!VecDuplicate(x, &back));
  CHECK(!VecDuplicate(x, &direct));
  Fill(x);
  CHECK(!MatMult(vi->T, x, Tx));
  CHECK(!MatDuplicate(vi->T, MAT_COPY_VALUES, &P[0]));
  CHECK(!BasisRowsMultiply(&inverse, NULL, &P[0])); // 1 T
  CHECK(!MatMult(P[0], x, back));
  CHECK_NEAR(Difference(back, x), 0, ROUNDING);
  CHECK(!MatConvert(vi->K, MATAIJ, MAT_INITIAL_MATRIX, &P[1]));
  CHECK(!MatScale(P[1], 1 / vi->stiffness));
  CHECK(!MatMult(P[1], Tx, PTx));
  CHECK(!VIApplyInverseBasis(vi, PTx, direct));
  CHECK(!BasisRowsMultiply(&inverse, vi->T, &P[1]));
  CHECK(!MatMult(P[1], x, back));
  CHECK_NEAR(Difference(back, direct), 0, 100 * ROUNDING);
  for (PetscInt i = 0; i < 2; ++i) CHECK(!MatDestroy(&P[i]));
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&Tx));
  CHECK(!VecDestroy(&PTx));
  CHECK(!VecDestroy(&back));
  CHECK(!VecDestroy(&direct));
  CHECK(!BasisRowsDestroy(&inverse));
}

/* Products with the shell, its diagonal, and both with springs, against the matrix, and that against T'KT. */
static void TestShell(VI vi)
{
  const PetscInt first = vi->level->dim * vi->level->node_begin;
  Vec            x, springs, image[2], diagonal[2];
  Mat            sprung, TKT, K;

  CHECK(!VIAssemble(vi));
  for (PetscInt i = 0; i < 2; ++i) {
    CHECK(!VecDuplicate(vi->upper, &image[i]));
    CHECK(!VecDuplicate(vi->upper, &diagonal[i]));
  }
  CHECK(!VecDuplicate(vi->upper, &x));
  CHECK(!VecDuplicate(vi->upper, &springs));
  Fill(springs);
  for (PetscInt i = 0; i < vi->num_fixed; ++i) CHECK(!VecSetValue(springs, vi->fixed[i], 0, INSERT_VALUES));
  CHECK(!VecAssemblyBegin(springs));
  CHECK(!VecAssemblyEnd(springs));
  Fill(x);
  for (PetscInt with = 0; with < 2; ++with) {
    vi->assembled = PETSC_FALSE; // A stays what it is; what is made of it is a shell
    CHECK(!VICreateRegularized(vi, springs, &sprung));
    vi->assembled = PETSC_TRUE;
    CHECK(!MatMult(sprung, x, image[0]));
    CHECK(!MatGetDiagonal(sprung, diagonal[0]));
    CHECK(!MatMult(vi->A, x, image[1]));
    CHECK(!MatGetDiagonal(vi->A, diagonal[1]));
    CHECK(!VecAXPY(diagonal[1], 1, springs));
    CHECK(!VecPointwiseMult(springs, springs, x));
    CHECK(!VecAXPY(image[1], 1, springs));
    CHECK_NEAR(Difference(image[0], image[1]), 0, ROUNDING);
    CHECK_NEAR(Difference(diagonal[0], diagonal[1]), 0, ROUNDING);
    CHECK(!MatDestroy(&sprung));
    CHECK(!VecZeroEntries(springs));
  }
  CHECK(!MatConvert(vi->K, MATAIJ, MAT_INITIAL_MATRIX, &K));
  CHECK(!MatPtAP(K, vi->T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &TKT));
  CHECK(!MatDestroy(&K));
  for (PetscInt i = 0; i < vi->num_fixed; ++i) CHECK(!VecSetValue(x, vi->fixed[i], 0, INSERT_VALUES));
  CHECK(!VecAssemblyBegin(x));
  CHECK(!VecAssemblyEnd(x));
  CHECK(!MatMult(vi->A, x, image[0]));
  CHECK(!MatMult(TKT, x, image[1]));
  CHECK(!VecScale(image[1], 1 / vi->stiffness));
  {
    PetscScalar *a;

    CHECK(!VecGetArray(image[1], &a));
    for (PetscInt i = 0; i < vi->num_fixed; ++i) a[vi->fixed[i] - first] = 0;
    CHECK(!VecRestoreArray(image[1], &a));
  }
  CHECK_NEAR(Difference(image[0], image[1]), 0, ROUNDING);
  for (PetscInt i = 0; i < 2; ++i) {
    CHECK(!VecDestroy(&image[i]));
    CHECK(!VecDestroy(&diagonal[i]));
  }
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&springs));
  CHECK(!MatDestroy(&TKT));
}

/* x := x, but 0 where eliminated. */
static void Empty(VI vi, Vec x)
{
  PetscScalar *a;

  CHECK(!VecGetArray(x, &a));
  for (PetscInt i = 0; i < vi->num_fixed; ++i) a[vi->fixed_local[i]] = 0;
  CHECK(!VecRestoreArray(x, &a));
}

/* P^' A_f P^ x = A_c x on levels of meshes that are nested. */
static void TestNested(MeshLevels levels)
{
  const Hierarchy h = levels->hierarchy;

  for (PetscInt l = 1; l < h->num; ++l) {
    Vec x, Px, APx, image, product;

    CHECK(!MatCreateVecs(h->level[l].P, &x, &Px));
    CHECK(!VecDuplicate(x, &image));
    CHECK(!VecDuplicate(x, &product));
    CHECK(!VecDuplicate(Px, &APx));
    Fill(x);
    Empty(levels->vi[l - 1], x);
    CHECK(!MatMult(h->level[l].P, x, Px));
    CHECK(!MatMult(h->level[l].op.A, Px, APx));
    CHECK(!MatMultTranspose(h->level[l].P, APx, product));
    CHECK(!MatMult(h->level[l - 1].op.A, x, image));
    CHECK_NEAR(Difference(image, product), 0, ROUNDING);
    CHECK(!VecDestroy(&x));
    CHECK(!VecDestroy(&Px));
    CHECK(!VecDestroy(&APx));
    CHECK(!VecDestroy(&image));
    CHECK(!VecDestroy(&product));
  }
}

/* 0 at some of the unknowns with a bound, 1 elsewhere. [in] share - of them that are held */
static void Choose(VI vi, PetscReal share, Vec free)
{
  const PetscScalar *upper;
  PetscScalar       *f;
  PetscInt           n;

  CHECK(!VecGetLocalSize(free, &n));
  CHECK(!VecGetArrayRead(vi->upper, &upper));
  CHECK(!VecGetArray(free, &f));
  for (PetscInt i = 0; i < n; ++i) f[i] = PetscRealPart(upper[i]) < PETSC_INFINITY && Uniform(0, 1) < share ? 0 : 1;
  CHECK(!VecRestoreArray(free, &f));
  CHECK(!VecRestoreArrayRead(vi->upper, &upper));
}

/* Every three successive nodes are a block; or every node is its diagonal. */
static Mat CreateBlocks(VI vi, PetscBool diagonal)
{
  const PetscInt dim = vi->level->dim;
  PetscInt       begin, end;
  PetscReal     *label;
  Mat            K, blocks;

  CHECK(!MatConvert(vi->K, MATAIJ, MAT_INITIAL_MATRIX, &K));
  CHECK(!MatScale(K, 1 / vi->stiffness));
  CHECK(!MatDuplicate(K, MAT_DO_NOT_COPY_VALUES, &blocks));
  CHECK(!MatGetOwnershipRange(K, &begin, &end));
  for (PetscInt row = begin; row < end; ++row) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    CHECK(!MatGetRow(K, row, &num, &columns, &values));
    for (PetscInt k = 0; k < num; ++k)
      if (diagonal ? columns[k] == row : columns[k] / dim / 3 == row / dim / 3)
        CHECK(!MatSetValue(blocks, row, columns[k], values[k], INSERT_VALUES));
    CHECK(!MatRestoreRow(K, row, &num, &columns, &values));
  }
  CHECK(!MatAssemblyBegin(blocks, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(blocks, MAT_FINAL_ASSEMBLY));
  CHECK(!MatDestroy(&K));
  CHECK(!PetscMalloc1((end - begin) / dim, &label));
  for (PetscInt i = 0; i < (end - begin) / dim; ++i) label[i] = (PetscReal)((begin / dim + i) / 3 * 3);
  CHECK(!EnvelopeFactorKeep(blocks, dim, label));
  CHECK(!PetscFree(label));
  return blocks;
}

/* S_ff^-1 S_ff x = x, where some unknowns are held. [in] D - S = T'D T */
static void CompareApart(VI vi, Mat D, Mat inverse, PetscReal rounding)
{
  static const PetscReal shares[] = {0, 0.5, 1};
  Vec                    x, u, f, r, back, free;

  CHECK(!MatCreateVecs(D, &x, &u));
  CHECK(!VecDuplicate(x, &f));
  CHECK(!VecDuplicate(x, &r));
  CHECK(!VecDuplicate(x, &back));
  CHECK(!VecDuplicate(x, &free));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(shares); ++i) {
    PetscInt           n, num = 0, *fixed;
    const PetscScalar *a;
    PetscBool          done;

    Choose(vi, shares[i], free);
    Empty(vi, free);
    CHECK(!VecGetLocalSize(free, &n));
    CHECK(!PetscMalloc1(n, &fixed));
    CHECK(!VecGetArrayRead(free, &a));
    for (PetscInt k = 0; k < n; ++k)
      if (a[k] == 0) fixed[num++] = k;
    CHECK(!VecRestoreArrayRead(free, &a));
    CHECK(!BodySmootherSetFixed(inverse, num, fixed, &done));
    CHECK(done);
    CHECK(!PetscFree(fixed));
    Fill(x);
    CHECK(!VecPointwiseMult(x, x, free));
    CHECK(!MatMult(vi->T, x, u));
    CHECK(!MatMult(D, u, f));
    CHECK(!MatMultTranspose(vi->T, f, r));
    CHECK(!VecPointwiseMult(r, r, free));
    CHECK(!MatMult(inverse, r, back));
    CHECK_NEAR(Difference(back, x), 0, rounding);
  }
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&u));
  CHECK(!VecDestroy(&f));
  CHECK(!VecDestroy(&r));
  CHECK(!VecDestroy(&back));
  CHECK(!VecDestroy(&free));
}

/* Diagonals, and blocks, which one rank has. */
static void TestApart(VI vi)
{
  PetscMPIInt size;
  Operator    op;
  Mat         D, inverse;

  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  CHECK(!MeshLevelsCreateOperator(&(Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper}, NULL, &op));
  D = CreateBlocks(vi, PETSC_TRUE);
  CHECK(!BodySmootherCreate(&op, &inverse));
  CompareApart(vi, D, inverse, ROUNDING);
  CHECK(!MatDestroy(&inverse));
  CHECK(!MatDestroy(&D));
  D = CreateBlocks(vi, PETSC_FALSE);
  CHECK(!BodySmootherCreateOfBlocks(&op, D, &inverse));
  CHECK(inverse != NULL);
  CompareApart(vi, D, inverse, ROUNDING_FACTOR);
  CHECK(!MatDestroy(&inverse));
  CHECK(!MatDestroy(&D));
  CHECK(!OperatorDestroy(&op));
}

/* P'K P block by block, and by products of matrices. */
static void TestCoarse(VI vi)
{
  const Mesh mesh  = vi->mesh;
  const Mat  nodal = MeshFinest(mesh)->prolongation;
  Level     *below = &mesh->levels[mesh->num_levels - 2];
  PetscReal  size, error;
  Mat        components, P, K[2], whole[2];

  CHECK(!MatCreateMAIJ(nodal, vi->level->dim, &components));
  CHECK(!MatConvert(components, MATAIJ, MAT_INITIAL_MATRIX, &P));
  CHECK(!MatSetBlockSize(P, vi->level->dim));
  for (int i = 0; i < 2; ++i) {
    CHECK(!CoarseStiffnessCreate(below, vi->K, P, i ? NULL : nodal, &K[i]));
    CHECK(!MatConvert(K[i], MATAIJ, MAT_INITIAL_MATRIX, &whole[i]));
  }
  CHECK(!MatNorm(whole[1], NORM_INFINITY, &size));
  CHECK(!MatAXPY(whole[0], -1, whole[1], DIFFERENT_NONZERO_PATTERN));
  CHECK(!MatNorm(whole[0], NORM_INFINITY, &error));
  CHECK_NEAR(error / size, 0, ROUNDING);
  for (int i = 0; i < 2; ++i) {
    CHECK(!MatDestroy(&K[i]));
    CHECK(!MatDestroy(&whole[i]));
  }
  CHECK(!MatDestroy(&components));
  CHECK(!MatDestroy(&P));
}

/* A^ of every level by products of matrices, A_(l-1) + P'(M A^_l M - A_l)P; products with them against those of the levels. */
static void CompareRungs(MeshLevels levels, MGLevel mg[])
{
  const Hierarchy h = levels->hierarchy;
  Mat             own, finer = NULL; // A of this level with what finer ones make of it

  for (PetscInt l = h->num - 1; l >= 0; --l) {
    Vec x, image, expected;

    CHECK(!VIAssemble(levels->vi[l]));
    CHECK(!MatDuplicate(levels->vi[l]->A, MAT_COPY_VALUES, &own));
    if (finer) {
      Mat restricted;

      CHECK(!MatPtAP(finer, h->level[l + 1].P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &restricted));
      CHECK(!MatAXPY(own, 1, restricted, DIFFERENT_NONZERO_PATTERN));
      CHECK(!MatDestroy(&restricted));
      CHECK(!MatDestroy(&finer));
    }
    CHECK(!VecDuplicate(mg[l].free, &x));
    CHECK(!VecDuplicate(x, &image));
    CHECK(!VecDuplicate(x, &expected));
    Fill(x);
    Empty(levels->vi[l], x);
    CHECK(!VecPointwiseMult(x, x, mg[l].free));
    CHECK(!MatMult(own, x, expected));
    CHECK(!VecPointwiseMult(expected, expected, mg[l].free));
    CHECK(!MatMult(mg[l].A, x, image));
    CHECK_NEAR(Difference(image, expected), 0, ROUNDING);
    CHECK(!MatDiagonalScale(own, mg[l].free, mg[l].free));
    CHECK(!MatAXPY(own, -1, levels->vi[l]->A, DIFFERENT_NONZERO_PATTERN));
    finer = own;
    CHECK(!VecDestroy(&x));
    CHECK(!VecDestroy(&image));
    CHECK(!VecDestroy(&expected));
  }
  CHECK(!MatDestroy(&finer));
}

/* Products of the cycle against those in double precision, which take their place: rounding would hide mistakes. */
static void ReplaceProducts(MeshLevels levels)
{
  for (PetscInt l = 0; l < levels->num; ++l) {
    const VI  vi = levels->vi[l];
    Operator *op = &levels->hierarchy->level[l].op;
    Vec       x, image, expected;

    CHECK(!VecDuplicate(vi->b, &x));
    CHECK(!VecDuplicate(x, &image));
    CHECK(!VecDuplicate(x, &expected));
    Fill(x);
    CHECK(!MatMult(op->S, x, image));
    CHECK(!MatMult(vi->S, x, expected));
    CHECK_NEAR(Difference(image, expected), 0, ROUNDING_SINGLE);
    CHECK(!MatDestroy(&op->S));
    CHECK(!PetscObjectReference((PetscObject)vi->S));
    op->S = vi->S;
    CHECK(!VecDestroy(&x));
    CHECK(!VecDestroy(&image));
    CHECK(!VecDestroy(&expected));
  }
}

/* Held sets one after the other: none, some, all, others, few, none again. */
static void TestRungs(MeshLevels levels)
{
  const Hierarchy        h        = levels->hierarchy;
  const VI               vi       = levels->vi[levels->num - 1];
  static const PetscReal shares[] = {0, 0.3, 1, 0.7, 0.1, 0};
  MGLevel               *mg;
  Vec                    free;

  ReplaceProducts(levels);
  CHECK(!PetscCalloc1(h->num, &mg));
  for (PetscInt l = 0; l < h->num; ++l) CHECK(!MGLevelCreate(h, l, &mg[l]));
  CHECK(!VecDuplicate(vi->upper, &free));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(shares); ++i) {
    Choose(vi, shares[i], free);
    CHECK(!MGLevelSetFree(h->num, mg, free, NULL));
    CHECK(!MGLevelAssemble(&mg[0]));
    CompareRungs(levels, mg);
  }
  for (PetscInt l = 0; l < h->num; ++l) CHECK(!MGLevelDestroy(&mg[l]));
  CHECK(!PetscFree(mg));
  CHECK(!VecDestroy(&free));
}

static MeshLevels CreateLevels(VI vi)
{
  MeshLevels levels;

  CHECK(!MeshLevelsCreate(&(Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper}, NULL, NULL, &levels));
  return levels;
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt which = 0; which < CASE_COUNT; ++which) {
    TestScene  t;
    Mesh       mesh;
    MeshLevels levels;
    VI         vi = CreateVI(&t, (Case)which, which == CASE_QUADS || which == CASE_OBLIQUE ? 2 : 1, &mesh);

    TestInverse(vi);
    TestApart(vi);
    TestCoarse(vi);
    levels = CreateLevels(vi);
    if (which != CASE_TIED) TestNested(levels);
    CHECK(!MeshLevelsDestroy(&levels));
    TestShell(vi);
    levels = CreateLevels(vi);
    TestRungs(levels);
    CHECK(!MeshLevelsDestroy(&levels));
    DestroyVI(&t, &mesh, &vi);
  }
  PetscCall(PetscFinalize());
  return 0;
}
