/* levelcut.c -- integrals of functions that jump or bend where known functions are zero.

   A cell is a unit cube, or the part of one that a plane cuts off. In each box a coordinate is chosen along
   which all of these functions are monotone or constant. Lines along it are cut at the zeros, with Gauss
   rules between them. The result is a function of the other coordinates, smooth between the zeros of further
   functions, and so on. A box without such a coordinate, or where rules with more points differ, is halved.
   Near a zero, on the line or shortly beyond it, the integrand may behave as a square root. There points are
   squares of a parameter, in which it is smooth.

   The plane is one more function, which meets all others. Tetrahedra with curved surfaces are better parted
   into four hexahedra, images of the unit cube, one at each vertex. */
#include "base/compat.h"
#include "kernel/levelsets.h"

enum {
  STACK          = 64,
  MAX_DEPTH      = 45, /* halves of a cell, of all coordinates together */
  MAX_BASE_DEPTH = 24, /* of the coordinates that lines do not have */
  MAX_POINTS     = 16, /* of a rule */
  RULES          = 4
};

/* Numbers of points of the Gauss rules that are compared: with cuts, and without. */
static const PetscInt CUT_POINTS[RULES] = {4, 8, 12, 16}, WHOLE_POINTS[RULES] = {4, 6, 8, 12};
/* Part of the tolerance that is permitted for one box. */
static const PetscReal BOX_SHARE = 1. / 8.;
/* Rules whose difference exceeds the tolerance by this factor are not followed by another one. */
static const PetscReal HOPELESS = 1e8;
/* Pieces of less length are omitted. */
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

/* The integrand of a box, at u: that of the cubature, or the integral along the line of the box around. */
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

/* The point at p in [0,1] of a piece; returns ds/dp. Towards zeros, at the ends or beyond them, points are
   squares, so that square roots become smooth.
   [in] zero - infinite where there is none [2] */
static PetscReal LevelCutPiecePoint_Private(const PetscReal ends[], const PetscReal zero[], PetscReal p, PetscReal *s)
{
  const PetscReal length = ends[1] - ends[0];
  const PetscReal before = PetscMax(ends[0] - zero[0], 0.), after = PetscMax(zero[1] - ends[1], 0.);
  const PetscBool is[2] = {(PetscBool)(zero[0] > PETSC_NINFINITY), (PetscBool)(zero[1] < PETSC_INFINITY)};
  PetscReal       first, last, q;

  if (is[0] && is[1]) {
    const PetscReal all = before + length + after;

    first = PetscAsinReal(PetscSqrtReal(before / all));
    last  = PetscAcosReal(PetscSqrtReal(after / all));
    q     = first + p * (last - first);
    *s    = zero[0] + all * PetscSqr(PetscSinReal(q));
    return (last - first) * all * PetscSinReal(2. * q);
  }
  if (is[0] || is[1]) { // zero +- q^2
    first = PetscSqrtReal(is[0] ? before : after + length);
    last  = PetscSqrtReal(is[0] ? before + length : after);
    q     = first + p * (last - first);
    *s    = is[0] ? zero[0] + q * q : zero[1] - q * q;
    return 2. * q * PetscAbsReal(last - first);
  }
  *s = ends[0] + p * length;
  return length;
}

/* The integral along a coordinate of a box, cut at the zeros of its functions. */
static PetscErrorCode LevelCutLine_Private(Cut *cut, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                           PetscReal value[])
{
  const PetscInt size = cut->cell.cubature->size;
  PetscReal      ends[LEVELSET_MAX_ZEROS], s[MAX_POINTS], w[MAX_POINTS], v[CUBATURE_MAX_SIZE];
  PetscReal      beyond[2] = {PETSC_NINFINITY, PETSC_INFINITY};
  PetscInt       num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, size));
  QuadratureLine(cut->points, s, w);
  PetscCall(LevelSetBoxZeros(&cut->cell, box, line, u, &num, ends));
  if (cut->roots) PetscCall(LevelSetBoxBeyond(&cut->cell, box, line, u, beyond));
  for (PetscInt j = 0; j < num; j++) {
    const PetscReal zero[2] = {j > 0 && cut->roots ? ends[j] : beyond[0],
                               j + 1 < num && cut->roots ? ends[j + 1] : beyond[1]};

    u[line] = 0.5 * (ends[j] + ends[j + 1]);
    if (ends[j + 1] - ends[j] <= SHORTEST || (!box->around && LevelCutIsOutside_Private(cut, u))) continue;
    for (PetscInt q = 0; q < cut->points; q++) {
      const PetscReal weight = w[q] * LevelCutPiecePoint_Private(&ends[j], zero, s[q], &u[line]);

      PetscCall(LevelCutEvaluate_Private(cut, box, u, v));
      for (PetscInt i = 0; i < size; i++) value[i] += weight * v[i];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the integral over a box without functions. */
static PetscErrorCode LevelCutProduct_Private(Cut *cut, const LevelSetBox *box, PetscReal value[])
{
  PetscReal s[MAX_POINTS], w[MAX_POINTS], u[LEVELSET_MAX_DIM], v[CUBATURE_MAX_SIZE];
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

/* Adds the integral over a box.
   [in] known - trends of its functions, all of which may be zero in it; NULL where neither is known */
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
  if (cut->forced || depth >= MAX_BASE_DEPTH) { // the error of this is in a small box
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

/* The integral over a box of the cell by rules with more and more points.
   [out] miss - difference of the last two */
static PetscErrorCode LevelCutCompare_Private(Cut *cut, const LevelSetBox *box, const LevelSetTrend *trend,
                                              PetscReal value[], PetscReal *miss)
{
  const Cubature *cubature = cut->cell.cubature;
  PetscReal       finer[CUBATURE_MAX_SIZE];

  PetscFunctionBeginUser;
  *miss = PETSC_MAX_REAL;
  for (PetscInt r = 0; r < RULES; r++) {
    cut->points = box->num ? CUT_POINTS[r] : WHOLE_POINTS[r];
    PetscCall(PetscArrayzero(finer, cubature->size));
    PetscCall(LevelCutBox_Private(cut, box, trend, 0, finer));
    if (r > 0) *miss = CubatureDifference(cubature, value, finer);
    PetscCall(PetscArraycpy(value, finer, cubature->size));
    if (r > 0 && (*miss <= BOX_SHARE || *miss > HOPELESS * BOX_SHARE || cubature->count > cubature->budget)) break;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same with the rules for roots at zeros, or those without roots; first those that sufficed last. */
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

/* The coordinate along which the integrand is least smooth: where two rules on a line through the middle of a
   box differ most. */
static PetscErrorCode LevelCutFindRough_Private(Cut *cut, const LevelSetBox *box, PetscInt *rough)
{
  const PetscInt size = cut->cell.cubature->size;
  PetscReal      most = -1.;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < box->dim; k++) {
    PetscReal sums[2][CUBATURE_MAX_SIZE] = {{0.}}, u[LEVELSET_MAX_DIM], difference;

    for (PetscInt l = 0; l < box->dim; l++) u[l] = 0.5 * (box->lower[l] + box->upper[l]);
    for (PetscInt r = 0; r < 2; r++) {
      PetscReal s[MAX_POINTS], w[MAX_POINTS], v[CUBATURE_MAX_SIZE];

      QuadratureLine(CUT_POINTS[r], s, w);
      for (PetscInt q = 0; q < CUT_POINTS[r]; q++) {
        u[k] = box->lower[k] + (box->upper[k] - box->lower[k]) * s[q];
        PetscCall(LevelCutEvaluate_Private(cut, box, u, v));
        for (PetscInt i = 0; i < size; i++) sums[r][i] += w[q] * v[i];
      }
    }
    difference = CubatureDifference(cut->cell.cubature, sums[0], sums[1]);
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

/* The integral over a cell as the unit cube or its part. */
static PetscErrorCode LevelCutCell_Private(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  Cut   cut = {.roots = PETSC_FALSE};
  Part *stack;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, cubature->size));
  *error = 0.;
  PetscCall(PetscCalloc1(STACK, &stack));
  LevelSetCellInit(cubature, PETSC_FALSE, &cut.cell, &stack[0].box);
  PetscCall(LevelCutParts_Private(&cut, stack, value, error));
  PetscCall(PetscFree(stack));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A hexahedron at a vertex of a tetrahedron. Its corners are the vertex, and the centroids of its edges, of
   its faces and of the cell. */
typedef struct {
  const Cubature *whole;
  PetscReal       corner[8 * LEVELSET_MAX_DIM];
} Quarter;

static void QuarterSet_Private(const Cubature *whole, PetscInt vertex, Quarter *quarter)
{
  quarter->whole = whole;
  for (PetscInt n = 0; n < 8; n++) {
    const PetscReal *at = ElementNode(ELEMENT_HEX8, n), *first = ElementNode(ELEMENT_TET4, vertex);

    for (PetscInt k = 0; k < LEVELSET_MAX_DIM; k++) {
      PetscReal sum = first[k], num = 1.;

      for (PetscInt l = 0; l < LEVELSET_MAX_DIM; l++) {
        sum += at[l] * ElementNode(ELEMENT_TET4, (vertex + 1 + l) % 4)[k];
        num += at[l];
      }
      quarter->corner[n * LEVELSET_MAX_DIM + k] = sum / num;
    }
  }
}

static PetscErrorCode QuarterIntegrandFn(void *ctx, const PetscReal u[], PetscReal value[])
{
  const Quarter *quarter = ctx;
  PetscReal      xi[LEVELSET_MAX_DIM], phi[ELEMENT_MAX_NODES], jacobian;

  PetscFunctionBeginUser;
  jacobian = PetscAbsReal(ElementMap(ELEMENT_HEX8, quarter->corner, u, xi, phi, NULL));
  PetscCall(quarter->whole->integrand(quarter->whole->ctx, xi, value));
  for (PetscInt i = 0; i < quarter->whole->size; i++) value[i] *= jacobian;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode QuarterSwitchFn(void *ctx, PetscInt i, const PetscReal u[], PetscReal *value)
{
  const Quarter *quarter              = ctx;
  PetscReal      xi[LEVELSET_MAX_DIM] = {0.}, phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  ElementShape(ELEMENT_HEX8, u, phi, NULL);
  for (PetscInt n = 0; n < 8; n++)
    for (PetscInt k = 0; k < LEVELSET_MAX_DIM; k++) xi[k] += phi[n] * quarter->corner[n * LEVELSET_MAX_DIM + k];
  PetscCall(quarter->whole->switches(quarter->whole->ctx, i, xi, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The integral over a tetrahedron by four hexahedra. */
static PetscErrorCode LevelCutQuarters_Private(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  const PetscInt before = cubature->count;
  PetscReal      part[CUBATURE_MAX_SIZE], miss;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, cubature->size));
  *error = 0.;
  for (PetscInt vertex = 0; vertex < 4; vertex++) {
    Cubature quarter_cubature = *cubature;
    Quarter  quarter;

    QuarterSet_Private(cubature, vertex, &quarter);
    quarter_cubature.type      = ELEMENT_HEX8;
    quarter_cubature.integrand = QuarterIntegrandFn;
    quarter_cubature.switches  = QuarterSwitchFn;
    quarter_cubature.ctx       = &quarter;
    quarter_cubature.count     = 0;
    quarter_cubature.budget    = (before + cubature->budget - cubature->count) / (4 - vertex);
    PetscCall(LevelCutCell_Private(&quarter_cubature, part, &miss));
    cubature->count += quarter_cubature.count;
    *error += miss;
    for (PetscInt i = 0; i < cubature->size; i++) value[i] += part[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureSwitches(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  LevelSetTrend trend = {.planes = PETSC_TRUE};
  PetscReal     other[CUBATURE_MAX_SIZE], miss;
  PetscInt      first;
  PetscBool     quarters;
  LevelSetCell  cell;
  LevelSetBox   box;

  PetscFunctionBeginUser;
  cubature->count = 0;
  LevelSetCellInit(cubature, PETSC_FALSE, &cell, &box);
  if (cell.simplex && cell.dim == 3) PetscCall(LevelSetBoxTrend(&cell, &box, &trend));
  quarters =
      (PetscBool)(!trend.planes && cubature->num_switches == 1); // where surfaces meet, planes are better kept plane
  if (quarters)
    PetscCall(LevelCutQuarters_Private(cubature, value, error));
  else
    PetscCall(LevelCutCell_Private(cubature, value, error));
  if (*error <= 1. || trend.planes) PetscFunctionReturn(PETSC_SUCCESS);
  first           = cubature->count; // the other method has the same budget
  cubature->count = 0;
  if (quarters)
    PetscCall(LevelCutCell_Private(cubature, other, &miss));
  else
    PetscCall(LevelCutQuarters_Private(cubature, other, &miss));
  cubature->count += first;
  if (miss < *error) {
    *error = miss;
    PetscCall(PetscArraycpy(value, other, cubature->size));
  }
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
