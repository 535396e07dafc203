/* levelcut.c -- integrals of functions that jump or bend where known functions are zero.

   A cell is a unit cube, simplices by rays from a vertex. In a box of it a coordinate is looked for along which all of these
   functions rise, fall or stay. Lines along it are cut at the zeros and have Gauss rules between them. What they give is a smooth function
   of the other coordinates between the zeros of functions of these, and so on. A box without such a coordinate, or on which rules
   with more points do not agree, is halved. Towards a zero the integrand may be a root: it goes away with points at squares of the
   distance. */
#include "base/compat.h"
#include "kernel/levelsets.h"

enum {
  STACK          = 64,
  MAX_DEPTH      = 45, /* halves of a cell, of all coordinates together */
  MAX_BASE_DEPTH = 24, /* of the coordinates that lines do not have */
  RULES          = 3
};

/* Points of Gauss rules that are compared: where something is cut, and where nothing is. */
static const PetscInt CUT_POINTS[RULES] = {4, 6, 8}, WHOLE_POINTS[RULES] = {4, 5, 8};
/* What all boxes together may be wrong by is shared by so many of them. */
static const PetscReal BOX_SHARE = 1. / 16.;
/* Rules that differ by more, compared with what they may, are not followed by another one. */
static const PetscReal HOPELESS = 1e6;
/* Pieces of less length are not looked at. */
static const PetscReal SHORTEST = 1e-15;

typedef struct {
  LevelSetCell cell;
  PetscInt     points; /* of a piece of a line */
  PetscBool    roots;  /* at zeros */
  PetscBool    forced; /* boxes are not halved any more */
} Cut;

/* A part of the cell. */
typedef struct {
  LevelSetBox box;
  PetscInt    depth;
} Part;

static PetscErrorCode LevelCutLine_Private(Cut *cut, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                           PetscReal value[]);

/* Whether a point is not in the cell. */
static PetscBool LevelCutIsOutside_Private(const Cut *cut, const PetscReal u[])
{
  PetscReal sum = 0.;

  for (PetscInt k = 0; k < cut->cell.dim; k++) sum += u[k];
  return (PetscBool)(cut->cell.simplex && sum >= 1.);
}

/* What is integrated over a box, at u: the integrand, or the integral along the line of the box around. */
static PetscErrorCode LevelCutEvaluate_Private(Cut *cut, const LevelSetBox *box, PetscReal u[], PetscReal value[])
{
  Cubature *cubature = cut->cell.cubature;

  PetscFunctionBeginUser;
  if (box->around) {
    PetscCall(LevelCutLine_Private(cut, box->around, box->line, u, value));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(cubature->integrand(cubature->ctx, u, value));
  cubature->count++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The point at p in [0,1] of a piece, nearer to ends that are zeros; returns ds/dp. [in] zero - whether ends are [2] */
static PetscReal PiecePoint_Private(const PetscReal ends[], const PetscBool zero[], PetscReal p, PetscReal *s)
{
  const PetscReal length = ends[1] - ends[0], q = 1. - p;

  *s = ends[0] + p * length;
  if (zero[0] && zero[1]) {
    *s = ends[0] + p * p * (3. - 2. * p) * length;
    return 6. * p * q * length;
  }
  if (zero[0]) {
    *s = ends[0] + p * p * length;
    return 2. * p * length;
  }
  if (zero[1]) {
    *s = ends[1] - q * q * length;
    return 2. * q * length;
  }
  return length;
}

/* The integral along a coordinate of a box, cut at the zeros of its functions. */
static PetscErrorCode LevelCutLine_Private(Cut *cut, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                           PetscReal value[])
{
  const PetscInt size = cut->cell.cubature->size;
  PetscReal      ends[LEVELSET_MAX_ZEROS], s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS], v[CUBATURE_MAX_SIZE];
  PetscInt       num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, size));
  QuadratureLine(cut->points, s, w);
  PetscCall(LevelSetBoxZeros(&cut->cell, box, line, u, &num, ends));
  for (PetscInt j = 0; j < num; j++) {
    const PetscBool zero[2] = {(PetscBool)(cut->roots && j > 0), (PetscBool)(cut->roots && j + 1 < num)};

    u[line] = 0.5 * (ends[j] + ends[j + 1]);
    if (ends[j + 1] - ends[j] <= SHORTEST || (!box->around && LevelCutIsOutside_Private(cut, u))) continue;
    for (PetscInt q = 0; q < cut->points; q++) {
      const PetscReal weight = w[q] * PiecePoint_Private(&ends[j], zero, s[q], &u[line]);

      PetscCall(LevelCutEvaluate_Private(cut, box, u, v));
      for (PetscInt i = 0; i < size; i++) value[i] += weight * v[i];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the integral over a box without functions. */
static PetscErrorCode LevelCutProduct_Private(Cut *cut, const LevelSetBox *box, PetscReal value[])
{
  PetscReal s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS], u[LEVELSET_MAX_DIM], v[CUBATURE_MAX_SIZE];
  PetscInt  total = 1;

  PetscFunctionBeginUser;
  QuadratureLine(cut->points, s, w);
  for (PetscInt k = 0; k < box->dim; k++) total *= cut->points;
  for (PetscInt q = 0; q < total; q++) {
    PetscReal weight = 1.;

    for (PetscInt k = 0, digits = q; k < box->dim; k++, digits /= cut->points) {
      const PetscInt axis = box->axis[k];

      u[axis] = box->lower[axis] + (box->upper[axis] - box->lower[axis]) * s[digits % cut->points];
      weight *= w[digits % cut->points] * (box->upper[axis] - box->lower[axis]);
    }
    PetscCall(LevelCutEvaluate_Private(cut, box, u, v));
    for (PetscInt i = 0; i < cut->cell.cubature->size; i++) value[i] += weight * v[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void BoxHalve_Private(LevelSetBox *box, PetscInt axis, LevelSetBox *other)
{
  *other             = *box;
  box->upper[axis]   = 0.5 * (box->lower[axis] + box->upper[axis]);
  other->lower[axis] = box->upper[axis];
}

/* Adds the integral over a box. [in] trend - of its functions, all of which may be zero in it; NULL where neither is known */
static PetscErrorCode LevelCutBox_Private(Cut *cut, const LevelSetBox *given, const LevelSetTrend *known,
                                          PetscInt depth, PetscReal value[])
{
  LevelSetBox   box   = *given, base;
  LevelSetTrend trend = {.line = -1};
  PetscBool     fits  = PETSC_FALSE;
  PetscReal     v[CUBATURE_MAX_SIZE], u[LEVELSET_MAX_DIM];

  PetscFunctionBeginUser;
  if (box.dim == 1) {
    PetscCall(LevelCutLine_Private(cut, &box, box.axis[0], u, v));
    for (PetscInt i = 0; i < cut->cell.cubature->size; i++) value[i] += v[i];
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (known)
    trend = *known;
  else
    PetscCall(LevelSetBoxTrend(&cut->cell, &box, &trend));
  if (!box.num) {
    PetscCall(LevelCutProduct_Private(cut, &box, value));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (cut->cell.cubature->count > cut->cell.cubature->budget) cut->forced = PETSC_TRUE;
  if (cut->forced || depth >= MAX_BASE_DEPTH) { // what this misses is in a small box
    trend.line = box.axis[0];
    LevelSetBoxProject(&box, &trend, &base, &fits);
    fits = PETSC_TRUE;
  } else if (trend.line >= 0)
    LevelSetBoxProject(&box, &trend, &base, &fits);
  if (fits) {
    PetscCall(LevelCutBox_Private(cut, &base, NULL, depth, value));
  } else {
    LevelSetBox other;

    BoxHalve_Private(&box, trend.bent, &other);
    PetscCall(LevelCutBox_Private(cut, &box, NULL, depth + 1, value));
    PetscCall(LevelCutBox_Private(cut, &other, NULL, depth + 1, value));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What two rules differ by in units of the tolerance. */
static PetscReal LevelCutDifference_Private(const Cubature *cubature, const PetscReal a[], const PetscReal b[])
{
  PetscReal most = 0.;

  for (PetscInt i = 0; i < cubature->size; i++)
    most = PetscMax(most, PetscAbsReal(a[i] - b[i]) / cubature->tolerance[i]);
  return most;
}

/* The integral over a box of the cell by rules with more and more points. [out] miss - what the last one may be wrong by: it differs
   from the one before, and falls as differences do */
static PetscErrorCode LevelCutCompare_Private(Cut *cut, const LevelSetBox *box, const LevelSetTrend *trend,
                                              PetscReal value[], PetscReal *miss)
{
  const Cubature *cubature = cut->cell.cubature;
  PetscReal       finer[CUBATURE_MAX_SIZE], last = -1.;

  PetscFunctionBeginUser;
  *miss = PETSC_MAX_REAL;
  for (PetscInt r = 0; r < RULES; r++) {
    cut->points = box->num ? CUT_POINTS[r] : WHOLE_POINTS[r];
    PetscCall(PetscArrayzero(finer, cubature->size));
    PetscCall(LevelCutBox_Private(cut, box, trend, 0, finer));
    if (r > 0) {
      const PetscReal difference = LevelCutDifference_Private(cubature, value, finer);

      *miss = last > 0. ? difference * PetscMin(1., difference / last) : difference;
      last  = difference;
    }
    PetscCall(PetscArraycpy(value, finer, cubature->size));
    if (r > 0 && (*miss <= BOX_SHARE || *miss > HOPELESS * BOX_SHARE || cubature->count > cubature->budget)) break;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same with the rules for roots at zeros or those for none, the ones that sufficed last before the others. */
static PetscErrorCode LevelCutTry_Private(Cut *cut, const LevelSetBox *box, const LevelSetTrend *trend,
                                          PetscReal value[], PetscReal *miss)
{
  const Cubature *cubature = cut->cell.cubature;
  PetscReal       other[CUBATURE_MAX_SIZE], error;

  PetscFunctionBeginUser;
  PetscCall(LevelCutCompare_Private(cut, box, trend, value, miss));
  if (*miss <= BOX_SHARE || !box->num || cubature->count > cubature->budget) PetscFunctionReturn(PETSC_SUCCESS);
  cut->roots = (PetscBool)!cut->roots;
  PetscCall(LevelCutCompare_Private(cut, box, trend, other, &error));
  if (error > BOX_SHARE) cut->roots = (PetscBool)!cut->roots;
  if (error >= *miss) PetscFunctionReturn(PETSC_SUCCESS);
  *miss = error;
  PetscCall(PetscArraycpy(value, other, cubature->size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The coordinate along which the integrand is least smooth: where two rules on a line through the middle of a box differ most. */
static PetscErrorCode LevelCutFindRough_Private(Cut *cut, const LevelSetBox *box, PetscInt *rough)
{
  const PetscInt size = cut->cell.cubature->size;
  PetscReal      most = -1.;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < box->dim; k++) {
    PetscReal sums[2][CUBATURE_MAX_SIZE] = {{0.}}, u[LEVELSET_MAX_DIM], difference;

    for (PetscInt l = 0; l < box->dim; l++) u[l] = 0.5 * (box->lower[l] + box->upper[l]);
    for (PetscInt r = 0; r < 2; r++) {
      PetscReal s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS], v[CUBATURE_MAX_SIZE];

      QuadratureLine(CUT_POINTS[r], s, w);
      for (PetscInt q = 0; q < CUT_POINTS[r]; q++) {
        u[k] = box->lower[k] + (box->upper[k] - box->lower[k]) * s[q];
        PetscCall(LevelCutEvaluate_Private(cut, box, u, v));
        for (PetscInt i = 0; i < size; i++) sums[r][i] += w[q] * v[i];
      }
    }
    difference = LevelCutDifference_Private(cut->cell.cubature, sums[0], sums[1]);
    if (difference <= most) continue;
    most   = difference;
    *rough = k;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Looks along the coordinates of a part. [out] bad - whether there is none to have lines along */
static PetscErrorCode LevelCutTrend_Private(const Cut *cut, LevelSetBox *box, LevelSetTrend *trend, PetscBool *bad)
{
  LevelSetBox base;
  PetscBool   fits = PETSC_TRUE;

  PetscFunctionBeginUser;
  *trend = (LevelSetTrend){.line = box->axis[0], .bent = box->axis[0]};
  if (box->dim > 1) {
    PetscCall(LevelSetBoxTrend(&cut->cell, box, trend));
    if (trend->line >= 0) LevelSetBoxProject(box, trend, &base, &fits);
  }
  *bad = (PetscBool)(trend->line < 0 || !fits);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the integral over the cell. [in,out] stack - holds the cell [STACK]; [in,out] error */
static PetscErrorCode LevelCutParts_Private(Cut *cut, Part stack[], PetscReal value[], PetscReal *error)
{
  Cubature *cubature = cut->cell.cubature;
  PetscInt  num      = 1;
  PetscReal v[CUBATURE_MAX_SIZE];

  PetscFunctionBeginUser;
  while (num > 0) {
    Part          part = stack[--num];
    LevelSetTrend trend;
    PetscReal     miss = PETSC_MAX_REAL;
    PetscInt      axis;
    PetscBool     bad = PETSC_FALSE;

    if (LevelCutIsOutside_Private(cut, part.box.lower)) continue;
    PetscCall(LevelCutTrend_Private(cut, &part.box, &trend, &bad));
    cut->forced = (PetscBool)(part.depth >= MAX_DEPTH || cubature->count > cubature->budget);
    axis        = trend.bent;
    if (!bad || cut->forced) {
      PetscCall(LevelCutTry_Private(cut, &part.box, &trend, v, &miss));
      if (miss > BOX_SHARE && !part.box.num) PetscCall(LevelCutFindRough_Private(cut, &part.box, &axis));
    }
    if (miss > BOX_SHARE && !cut->forced) {
      stack[num]       = part;
      stack[num].depth = stack[num + 1].depth = part.depth + 1;
      BoxHalve_Private(&stack[num].box, axis, &stack[num + 1].box);
      num += 2;
      continue;
    }
    for (PetscInt i = 0; i < cubature->size; i++) value[i] += v[i];
    *error += miss;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureSwitches(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  Cut   cut = {.roots = PETSC_FALSE};
  Part *stack;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, cubature->size));
  *error          = 0.;
  cubature->count = 0;
  PetscCall(PetscCalloc1(STACK, &stack));
  LevelSetCellInit(cubature, PETSC_FALSE, &cut.cell, &stack[0].box);
  PetscCall(LevelCutParts_Private(&cut, stack, value, error));
  PetscCall(PetscFree(stack));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureMayJump(Cubature *cubature, PetscBool *may)
{
  LevelSetCell  cell;
  LevelSetBox   box;
  LevelSetTrend trend;

  PetscFunctionBeginUser;
  LevelSetCellInit(cubature, PETSC_TRUE, &cell, &box);
  PetscCall(LevelSetBoxTrend(&cell, &box, &trend));
  *may = (PetscBool)(box.num > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}
