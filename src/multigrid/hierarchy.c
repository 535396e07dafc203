/* hierarchy.c -- the inequalities of coarser meshes, and prolongation between their unknowns.

   Displacements are prolonged by the shape functions of the coarser level; what solvers see are unknowns y of u = T y, so
   P^ = T_f^-1 P T_c. Where meshes are nested, P^' A_f P^ = T_c' (P' K_f P) T_c is the coarser level's own A, and no such product is
   formed; elsewhere P' K_f P takes the place of the coarser level's K: what truncation takes from a matrix has to be in it. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "multigrid/nodelevels.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/hierarchy.h"

/* Unknowns from which on the coarsest mesh, in the plane and in space, is not factored but has levels below it, and to which these go
   down. */
enum { LARGE_2D = 20000, LARGE_3D = 10000, COARSEST = 2500, MAX_BELOW = 16 };
/* A level of more than this part of the finer one's unknowns is the last one. */
static const PetscReal SLOW = 0.7;

/* P (x) 1: the same for every component. */
static PetscErrorCode Blocks_Private(Mat P, PetscInt dim, Mat *blocks)
{
  PetscInt     begin, end, rows, columns, first, last, *start, *column, count = 0;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(P, &begin, &end));
  PetscCall(MatGetLocalSize(P, &rows, &columns));
  PetscCall(MatGetOwnershipRangeColumn(P, &first, &last));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt num;

    PetscCall(MatGetRow(P, row, &num, NULL, NULL));
    count += dim * num;
    PetscCall(MatRestoreRow(P, row, &num, NULL, NULL));
  }
  PetscCall(PetscMalloc3(dim * rows + 1, &start, count, &column, count, &value));
  count    = 0;
  start[0] = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *c;
    const PetscScalar *v;

    PetscCall(MatGetRow(P, row, &num, &c, &v));
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt j = 0; j < num; j++) {
        column[count]  = dim * c[j] + k;
        value[count++] = v[j];
      }
      start[dim * (row - begin) + k + 1] = count;
    }
    PetscCall(MatRestoreRow(P, row, &num, &c, &v));
  }
  PetscCall(MatCreate(PetscObjectComm((PetscObject)P), blocks));
  PetscCall(MatSetSizes(*blocks, dim * rows, dim * columns, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*blocks, dim));
  PetscCall(MatSetType(*blocks, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocationCSR(*blocks, start, column, value)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocationCSR(*blocks, start, column, value));
  PetscCall(PetscFree3(start, column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What eliminated unknowns of the coarser level, which have their values, give to others of this one. [in] P - of all unknowns; [in] open -
   1 where an unknown is left, fine and coarse; [out] lift - NULL where the values are 0 */
static PetscErrorCode CreateLift_Private(VI coarse, VI fine, Mat P, const Vec open[2], Vec *lift)
{
  PetscReal size;
  Vec       given;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(coarse->b, &given));
  PetscCall(VecPointwiseMult(given, coarse->b, open[1]));
  PetscCall(VecAYPX(given, -1, coarse->b));
  PetscCall(VecNorm(given, NORM_INFINITY, &size));
  if (size > 0) {
    PetscCall(VecDuplicate(fine->b, lift));
    PetscCall(MatMult(P, given, *lift));
    PetscCall(VecPointwiseMult(*lift, *lift, open[0]));
  }
  PetscCall(VecDestroy(&given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T_f^-1 (P (x) 1) T_c, emptied where unknowns are eliminated. [out] lift - of CreateLift_Private() */
static PetscErrorCode CreateProlongation_Private(VI coarse, VI fine, Mat *P, Vec *lift)
{
  Mat blocks;
  Vec open[2];

  PetscFunctionBeginUser;
  PetscCall(Blocks_Private(fine->level->prolongation, fine->level->dim, &blocks));
  if (coarse->T) {
    PetscCall(MatMatMult(blocks, coarse->T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, P));
    PetscCall(MatProductClear(*P)); // it would keep its factors
    PetscCall(MatDestroy(&blocks));
  } else {
    *P = blocks;
  }
  PetscCall(VIMultiplyInverseBasis(fine, P));
  PetscCall(VICreateFreeMask(fine, &open[0]));
  PetscCall(VICreateFreeMask(coarse, &open[1]));
  PetscCall(CreateLift_Private(coarse, fine, *P, open, lift));
  PetscCall(MatDiagonalScale(*P, open[0], open[1]));
  PetscCall(VecDestroy(&open[0]));
  PetscCall(VecDestroy(&open[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyIsNested(VI vi, PetscBool *nested)
{
  const Scene      scene = vi->scene;
  DilatationCount *counts;

  PetscFunctionBeginUser;
  *nested = PETSC_TRUE;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(scene, vi->level, counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) *nested = (PetscBool)(*nested && counts[b].poisson == 0);
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the fine level's cells are parts of the coarse one's: not along curves. */
static PetscErrorCode AreParts_Private(Level *coarse, Level *fine, PetscBool *parts)
{
  static const PetscReal SAME   = 1e-9; /* relative to the scene */
  PetscReal              off[2] = {0, 0};
  PetscScalar           *x;
  Vec                    from, to;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(coarse, 1, &from));
  PetscCall(LevelCreateVec(fine, 1, &to));
  for (PetscInt d = 0; d < fine->dim; d++) {
    PetscCall(VecGetArray(from, &x));
    for (PetscInt i = 0; i < coarse->num_owned; i++) x[i] = coarse->coords[i * coarse->dim + d];
    PetscCall(VecRestoreArray(from, &x));
    PetscCall(MatMult(fine->prolongation, from, to));
    PetscCall(VecGetArray(to, &x));
    for (PetscInt i = 0; i < fine->num_owned; i++) {
      const PetscReal own = fine->coords[i * fine->dim + d];

      off[0] = PetscMax(off[0], PetscAbsScalar(x[i] - own));
      off[1] = PetscMax(off[1], PetscAbsReal(own));
    }
    PetscCall(VecRestoreArray(to, &x));
  }
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, off, 2, MPIU_REAL, MPI_MAX, fine->comm));
  *parts = (PetscBool)(off[0] <= SAME * off[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The inequality of level l, the next coarser one of fine's. Its K is P'K P of the fine one, by itself or made so. [in] same - whether
   energies are the same where cells are parts of cells */
static PetscErrorCode CreateCoarse_Private(VI fine, PetscInt l, PetscBool same, VI *coarse)
{
  Mat       P, K = NULL;
  PetscBool nested = same;

  PetscFunctionBeginUser;
  if (same) PetscCall(AreParts_Private(&fine->mesh->levels[l], fine->level, &nested));
  if (!nested) {
    PetscCall(Blocks_Private(fine->level->prolongation, fine->level->dim, &P));
    PetscCall(MatPtAP(fine->K, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &K));
    PetscCall(MatProductClear(K)); // it would keep its factors
    PetscCall(MatDestroy(&P));
  }
  PetscCall(VICreateCoarse(fine, l, K, coarse));
  PetscCall(MatDestroy(&K));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What one level is smoothed with. Tetrahedra as a mesh generator makes them have long cells here and there, but no lines of them worth solving
   for: that would cost several times what all else does. */
static PetscErrorCode CreateSmoother_Private(VI vi, Mat *S)
{
  const PetscInt  levels = vi->mesh->num_levels;
  const PetscBool finest = (PetscBool)(vi->level == &vi->mesh->levels[levels - 1]);
  PetscBool       lines  = (PetscBool)(levels > 1);

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < vi->level->num_cells && !lines; c++)
    lines = (PetscBool)(ElementLinear((ElementType)vi->level->cell_type[c]) != ELEMENT_TET4);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &lines, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  if (lines)
    PetscCall(SmootherCreate(vi, finest, S));
  else if (vi->T)
    PetscCall(ApartCreate(vi, S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A level and what belongs to it alone. [in] coarsest - whether it is to be factored */
static PetscErrorCode GridBegin_Private(Grid *grid, PetscBool coarsest)
{
  MatInfo info;

  PetscFunctionBeginUser;
  PetscCall(coarsest ? VIAssemble(grid->vi) : VIPrepareProducts(grid->vi));
  grid->A = grid->vi->A;
  PetscCall(MatCreateVecs(grid->A, &grid->diag, NULL));
  PetscCall(MatGetDiagonal(grid->A, grid->diag));
  PetscCall(MatGetInfo(grid->vi->K, MAT_GLOBAL_SUM, &info));
  grid->share = info.nz_used;
  if (coarsest) PetscFunctionReturn(PETSC_SUCCESS);
  if (grid->vi->level) PetscCall(CreateSmoother_Private(grid->vi, &grid->S));
  PetscCall(EigenvalueLargest(grid->A, grid->S, NULL, &grid->largest));
  if (!grid->S) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SmootherScale(grid->S, grid->largest)); // so that S >= A, also after the same change of both
  grid->largest = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Levels below the coarsest mesh: all there are if it is the only one. [in,out] coarsest - the coarsest mesh; before it there is room for
   MAX_BELOW; [out] num - below */
static PetscErrorCode GoBelow_Private(Grid *coarsest, PetscInt *num)
{
  const VI  vi = coarsest->vi;
  Points    points;
  PetscInt  size, coarser;
  PetscBool go;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(VecGetSize(vi->b, &size));
  go = (PetscBool)(size > (vi->level->dim == 3 ? LARGE_3D : LARGE_2D) || vi->mesh->num_levels == 1);
  PetscCall(GridBegin_Private(coarsest, (PetscBool)!go));
  if (!go) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(AlgebraicBegin(vi, &points));
  for (Grid *grid = coarsest; go; grid--) {
    PetscCall(AlgebraicCoarsen(grid->vi, &points, &grid->P, &grid[-1].vi));
    PetscCall(AlgebraicWeigh(grid->P, NULL, &grid->weight));
    PetscCall(MatGetSize(grid[-1].vi->K, &coarser, NULL));
    go = (PetscBool)(++*num < MAX_BELOW && coarser > COARSEST && coarser < SLOW * size);
    PetscCall(GridBegin_Private(&grid[-1], (PetscBool)!go));
    size = coarser;
  }
  PetscCall(PointsDestroy(&points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyCreate(VI vi, Vec springs, Hierarchy *hierarchy)
{
  const PetscInt meshes = vi->mesh->num_levels;
  Grid          *mesh; // those that have one
  Hierarchy      h;
  PetscBool      same;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&h));
  PetscCall(PetscCalloc1(MAX_BELOW + meshes, &h->grid));
  mesh                     = &h->grid[MAX_BELOW];
  mesh[meshes - 1].vi      = vi;
  mesh[meshes - 1].springs = springs;
  PetscCall(HierarchyIsNested(vi, &same));
  if (vi->scene->model == MODEL_AXISYMMETRIC)
    same = PETSC_FALSE; // 1 / radius is integrated on each level in its own way
  for (PetscInt l = meshes - 2; l >= 0; l--) PetscCall(CreateCoarse_Private(mesh[l + 1].vi, l, same, &mesh[l].vi));
  PetscCall(GoBelow_Private(mesh, &h->first));
  for (PetscInt l = 1; l < meshes; l++) {
    PetscCall(GridBegin_Private(&mesh[l], PETSC_FALSE));
    PetscCall(CreateProlongation_Private(mesh[l - 1].vi, mesh[l].vi, &mesh[l].P, &mesh[l].lift));
    PetscCall(AlgebraicWeigh(mesh[l].P, NULL, &mesh[l].weight));
  }
  h->num = h->first + meshes;
  PetscCall(PetscArraymove(h->grid, mesh - h->first, h->num));
  for (PetscInt l = 0; l < h->num; l++) h->grid[l].share /= h->grid[h->num - 1].share;
  *hierarchy = h;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyIsOver(Hierarchy hierarchy, PetscBool *over)
{
  const Grid *finest = &hierarchy->grid[hierarchy->num - 1];

  PetscFunctionBeginUser;
  PetscCall(PatienceCheck(&hierarchy->patience, finest->vi, (PetscBool)(finest->S != NULL),
                          (PetscBool)(finest->springs != NULL), hierarchy->work));
  *over = hierarchy->patience.over;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyDestroy(Hierarchy *hierarchy)
{
  PetscFunctionBeginUser;
  if (!*hierarchy) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt l = 0; l < (*hierarchy)->num; l++) {
    Grid *grid = &(*hierarchy)->grid[l];

    PetscCall(MatDestroy(&grid->P));
    PetscCall(VecDestroy(&grid->weight));
    PetscCall(VecDestroy(&grid->lift));
    PetscCall(VecDestroy(&grid->diag));
    PetscCall(MatDestroy(&grid->S));
    if (l + 1 < (*hierarchy)->num) PetscCall(VIDestroy(&grid->vi));
  }
  PetscCall(PetscFree((*hierarchy)->grid));
  PetscCall(PetscFree(*hierarchy));
  PetscFunctionReturn(PETSC_SUCCESS);
}
