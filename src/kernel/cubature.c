/* cubature.c -- integrals over reference cells: product rules, and nested adaptive integrals, cut at jumps
   and kinks.

   Bisection of cells resolves a jump slowly: 2^k cells leave an error of 2^-k. On a line a jump is a point,
   which k bisections find to 2^-k. So integrals are nested. The reference cell is the unit cube; simplices
   have the collapsed coordinates of [1], in which inner lines stay straight. The inner integral is continuous
   except where a jump is along its line. Its jumps, and its kinks where a jump leaves the cell, are found by
   bisection, too. The error of a piece of a line is estimated by two rules without common points:
   Gauss-Legendre with 4 and Gauss-Lobatto with 5. Their errors have opposite signs and the ratio 4 : 5, so
   that the sum below is exact to degree 9.

   References: [1] M. G. Duffy, Quadrature over a pyramid or cube of integrands with a singularity at a
   vertex, SIAM J. Numer. Anal. 19 (1982). */
#include "base/compat.h"
#include "kernel/cubature.h"
#include "kernel/planecut.h"
#include "kernel/referencecell.h"

enum {
  CUBATURE_LOBATTO = 5,
  CUBATURE_POINTS  = 9 /* of a piece, ascending: Gauss-Lobatto with 5 and Gauss-Legendre with 4 alternate */
};

/* Points and weights of a piece on [0,1]; the weights of each rule sum to 1. */
static const PetscReal CUBATURE_POINT[CUBATURE_POINTS] = {
    0.,  0.069431844202973712388, 0.17267316464601142810, 0.33000947820757186760,
    0.5, 0.66999052179242813240,  0.82732683535398857190, 0.93056815579702628761,
    1.};
static const PetscReal CUBATURE_WEIGHT[CUBATURE_POINTS] = {
    0.05,       0.17392742256872692869, 49. / 180., 0.32607257743127307131, 16. / 45., 0.32607257743127307131,
    49. / 180., 0.17392742256872692869, 0.05};

/* The integrand at a point of the unit cube, with the Jacobian of the collapsed coordinates; counts it.
   [in] u - [dim] */
static PetscErrorCode CubatureEvaluate_Private(Cubature *cubature, const PetscReal u[], PetscReal value[])
{
  const Reference *cell = &REFERENCE[cubature->type];
  PetscReal        xi[3], jacobian = 1., left = 1.;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < cell->dim; k++) {
    xi[k] = u[k] * left;
    if (!cell->simplex) continue;
    jacobian *= left;
    left *= 1. - u[k];
  }
  PetscCall(cubature->integrand(cubature->ctx, xi, value));
  for (PetscInt i = 0; i < cubature->size; i++) value[i] *= jacobian;
  cubature->count++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A product of equal rules on [0,1]. [in] s, w - [num] */
static PetscErrorCode CubatureProduct_Private(Cubature *cubature, PetscInt num, const PetscReal s[],
                                              const PetscReal w[], PetscReal value[])
{
  const PetscInt dim = REFERENCE[cubature->type].dim, size = cubature->size;
  PetscReal      v[CUBATURE_MAX_SIZE];
  PetscInt       total = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, size));
  for (PetscInt k = 0; k < dim; k++) total *= num;
  for (PetscInt q = 0; q < total; q++) {
    PetscReal u[3], weight = 1.;

    for (PetscInt k = 0, digits = q; k < dim; k++, digits /= num) {
      u[k] = s[digits % num];
      weight *= w[digits % num];
    }
    PetscCall(CubatureEvaluate_Private(cubature, u, v));
    for (PetscInt i = 0; i < size; i++) value[i] += weight * v[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal CubatureDifference(const Cubature *cubature, const PetscReal a[], const PetscReal b[])
{
  PetscReal most = 0.;

  for (PetscInt i = 0; i < cubature->size; i++)
    most = PetscMax(most, PetscAbsReal(a[i] - b[i]) / cubature->tolerance[i]);
  return most;
}

PetscErrorCode CubatureGauss(Cubature *cubature, PetscInt num, PetscReal value[])
{
  PetscReal s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS];

  PetscFunctionBeginUser;
  QuadratureLine(num, s, w);
  PetscCall(CubatureProduct_Private(cubature, num, s, w, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureLobatto(Cubature *cubature, PetscReal value[])
{
  const PetscInt  pieces = cubature->pieces;
  const PetscReal inset = cubature->inset, length = (1. - 2. * inset) / pieces;
  PetscReal s[(CUBATURE_LOBATTO - 1) * CUBATURE_MAX_PIECES + 1], w[(CUBATURE_LOBATTO - 1) * CUBATURE_MAX_PIECES + 1];
  PetscInt  num = 1;

  PetscFunctionBeginUser;
  w[0] = 0.;
  for (PetscInt i = 0; i < pieces; i++) { /* neighbours share a point */
    s[num - 1] = inset + length * i;
    w[num - 1] += CUBATURE_WEIGHT[0] / pieces;
    for (PetscInt j = 1; j < CUBATURE_LOBATTO; j++, num++) {
      s[num] = inset + length * (i + CUBATURE_POINT[2 * j]);
      w[num] = CUBATURE_WEIGHT[2 * j] / pieces;
    }
  }
  PetscCall(CubatureProduct_Private(cubature, num, s, w, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

enum {
  POINTS        = CUBATURE_POINTS,
  MAX_TAKEN     = 200, /* pieces of one line: limit for an integrand of roundoff */
  MAX_INTERVALS = 2 * MAX_TAKEN + CUBATURE_MAX_PIECES + 3,
  MAX_HINTS     = 8,
  TRIALS        = 5, /* bisections after which a jump or kink is recognized */
  WINDOW        = 5  /* points of the second differences that find a kink */
};

/* Tolerance of an inner integral relative to the outer one, which must not detect its errors as kinks. */
static const PetscReal INNER_TOLERANCE = 1. / 32.;
/* In more than one dimension a first pass has a tolerance this much larger: it gives the hints. */
static const PetscReal SURVEY = 1e4;
/* Permitted errors as parts of the tolerance: of a piece, and of the rest beside a jump or kink that was
   found. */
static const PetscReal PIECE = 0.5, FOUND = 1. / 64.;
/* A kink as near to the end of a piece, compared with its length, is at its end. */
static const PetscReal NEAR = 1e-3;
/* Points as near to each other are the same. */
static const PetscReal SAME_KINK = 1e-9;

/* Jumps and kinks found on lines of one direction. */
typedef struct {
  PetscInt  num;
  PetscReal at[MAX_HINTS];
} Hints;

/* Data of all lines of one integral. */
typedef struct {
  Cubature *cubature;
  Hints     hints[3]; /* of each direction: points between the jumps and kinks of the last line that had some */
} Nest;

/* One line of the unit cube: along its last coordinate, or where level is less than that along the integrals
   of such. */
typedef struct {
  Nest      *nest;
  PetscInt   level; /* coordinate along the line */
  PetscReal *u;     /* the point, of which [level] and what follows are set here [dim] */
  PetscReal  unit;  /* part of the tolerance that is this line's */
} Line;

/* A part of a line. Where a curve of jumps touches the line, the integrand has a square root at an end. There
   points are squares of a parameter, in which the integrand is smooth. */
typedef struct {
  PetscReal a, b;
  PetscInt  root;   /* -1 at a, 1 at b, 0 none */
  PetscInt  beside; /* a jump has been cut off -1 at a, 1 at b, 0 at neither */
} Interval;

static PetscErrorCode CubatureIntegrateLine_Private(const Line *line, PetscReal value[], PetscReal *error);

/* The point at p in [0,1] of a piece; returns ds/dp over the length of the piece. */
static PetscReal CubaturePiecePoint_Private(const Interval *piece, PetscReal p, PetscReal *s)
{
  const PetscReal length = piece->b - piece->a, q = 1. - p;

  *s = piece->a + p * length;
  if (!piece->root) return 1.;
  *s = piece->root < 0 ? piece->a + p * p * length : piece->b - q * q * length;
  return piece->root < 0 ? 2. * p : 2. * q;
}

/* The function that a line integrates, at s: the integrand, or an integral along the next coordinate.
   [out] error - in units of this line's tolerance */
static PetscErrorCode CubatureEvaluateLine_Private(const Line *line, PetscReal s, PetscReal value[], PetscReal *error)
{
  const Line inner = {line->nest, line->level + 1, line->u, line->unit * INNER_TOLERANCE};

  PetscFunctionBeginUser;
  line->u[line->level] = s;
  *error               = 0.;
  if (inner.level < REFERENCE[line->nest->cubature->type].dim) {
    PetscCall(CubatureIntegrateLine_Private(&inner, value, error));
    *error *= INNER_TOLERANCE;
  } else
    PetscCall(CubatureEvaluate_Private(line->nest->cubature, line->u, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Largest component of sum_j c_j v_j, in units of the line's tolerance. */
static PetscReal CubatureNorm_Private(const Line *line, PetscInt num, const PetscReal c[], const PetscReal *const v[])
{
  PetscReal largest = 0.;

  for (PetscInt i = 0; i < line->nest->cubature->size; i++) {
    PetscReal sum = 0.;

    for (PetscInt j = 0; j < num; j++) sum += c[j] * v[j][i];
    largest = PetscMax(largest, PetscAbsReal(sum) / line->nest->cubature->tolerance[i]);
  }
  return largest / line->unit;
}

/* The difference of the two rules on a piece of length 1, in units of the line's tolerance.
   [in] w - [POINTS] */
static PetscReal CubatureRuleDifference_Private(const Line *line, const PetscReal w[], PetscReal v[][CUBATURE_MAX_SIZE])
{
  PetscReal        c[POINTS];
  const PetscReal *at[POINTS];

  for (PetscInt j = 0; j < POINTS; j++) {
    c[j]  = j % 2 ? w[j] : -w[j];
    at[j] = v[j];
  }
  return CubatureNorm_Private(line, POINTS, c, at);
}

/* Looks for a jump between the two points of a piece whose values differ most.
   [in] v - [POINTS][CUBATURE_MAX_SIZE];
   [out] cut - around the jump; returns whether there is one */
static PetscErrorCode CubatureFindJump_Private(const Line *line, const Interval *piece,
                                               PetscReal v[][CUBATURE_MAX_SIZE], Interval *cut, PetscBool *found)
{
  static const PetscReal difference[2] = {-1., 1.};
  PetscReal              room[3][CUBATURE_MAX_SIZE], first = -1., jump, error;
  PetscReal             *at[2], *m                         = room[2];
  PetscInt               where = 0, step;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  for (PetscInt j = 0; j < POINTS - 1; j++) {
    jump = CubatureNorm_Private(line, 2, difference, (const PetscReal *const[]){v[j], v[j + 1]});
    if (jump > first) {
      first = jump;
      where = j;
    }
  }
  cut->a = piece->a + CUBATURE_POINT[where] * (piece->b - piece->a);
  cut->b = piece->a + CUBATURE_POINT[where + 1] * (piece->b - piece->a);
  for (PetscInt k = 0; k < 2; k++) {
    at[k] = room[k];
    PetscCall(PetscArraycpy(at[k], v[where + k], line->nest->cubature->size));
  }
  jump = first;
  for (step = 1; jump * (cut->b - cut->a) > FOUND && cut->b - cut->a > line->nest->cubature->inset; step++) {
    const PetscReal s = 0.5 * (cut->a + cut->b);
    PetscReal       side[2], *spare;
    PetscInt        k;

    PetscCall(CubatureEvaluateLine_Private(line, s, m, &error));
    side[0] = CubatureNorm_Private(line, 2, difference, (const PetscReal *const[]){at[0], m});
    side[1] = CubatureNorm_Private(line, 2, difference, (const PetscReal *const[]){m, at[1]});
    k       = side[0] > side[1] ? 1 : 0; /* the end that is replaced */
    jump    = side[1 - k];
    spare   = at[k];
    at[k]   = m;
    m       = spare;
    if (k)
      cut->b = s;
    else
      cut->a = s;
    /* each step halves a smooth difference, and takes less than a third of a root's */
    if (step == TRIALS && jump < 0.3 * first) PetscFunctionReturn(PETSC_SUCCESS);
  }
  *found = (PetscBool)(step > TRIALS); // else it is too small for a jump
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Looks for a kink: there second differences decrease no faster than the distance of their points. It is well
   inside of one of three windows of half the width, one of them in the middle. Arguments as above.
   [out] cut - its root is set if differences decrease as at a square root. In TRIALS - 1 steps those decrease
   to a quarter, those of a kink to an eighth at most */
static PetscErrorCode CubatureFindKink_Private(const Line *line, const Interval *piece,
                                               PetscReal v[][CUBATURE_MAX_SIZE], Interval *cut, PetscBool *found)
{
  static const PetscReal second[3] = {1., -2., 1.};
  PetscReal              room[WINDOW][CUBATURE_MAX_SIZE], *at[WINDOW], last[TRIALS - 1], bend, first = 0., error;
  PetscInt               step;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  *cut   = *piece;
  for (PetscInt j = 0; j < WINDOW; j++) at[j] = room[j];
  for (PetscInt j = 0; j < WINDOW; j += 2) PetscCall(PetscArraycpy(at[j], v[2 * j], line->nest->cubature->size));
  for (step = 0;; step++) {
    PetscReal *spare[2];
    PetscInt   where = 1;

    for (PetscInt j = 1; j < WINDOW; j += 2)
      PetscCall(CubatureEvaluateLine_Private(line, cut->a + 0.25 * j * (cut->b - cut->a), at[j], &error));
    bend = -1.;
    for (PetscInt j = 1; j < WINDOW - 1; j++) {
      const PetscReal d =
          CubatureNorm_Private(line, 3, second, (const PetscReal *const[]){at[j - 1], at[j], at[j + 1]});
      if (d > bend) {
        bend  = d;
        where = j;
      }
    }
    /* each step leaves half of the difference of a kink, a quarter of a smooth one */
    if (step == TRIALS && bend < 0.3 * first / (1 << TRIALS)) PetscFunctionReturn(PETSC_SUCCESS);
    if (!step) first = bend;
    *cut = (Interval){cut->a + 0.25 * (where - 1) * (cut->b - cut->a), cut->a + 0.25 * (where + 1) * (cut->b - cut->a),
                      cut->root + (step >= TRIALS && bend > 0.18 * last[step % (TRIALS - 1)] ? 1 : 0), 0};
    last[step % (TRIALS - 1)] = bend;
    if (bend * (cut->b - cut->a) <= FOUND || cut->b - cut->a < line->nest->cubature->inset) break;
    for (PetscInt j = 0, k = 0; j < WINDOW; j++) {
      if (j < where - 1 || j > where + 1) spare[k++] = at[j];
    }
    PetscReal *const kept[3] = {at[where - 1], at[where], at[where + 1]};
    for (PetscInt j = 0; j < 3; j++) at[2 * j] = kept[j];
    at[1] = spare[0];
    at[3] = spare[1];
  }
  *found = (PetscBool)(step >= TRIALS);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cuts a piece on which two rules differ: beside a jump or kink, or in its middle. An apparent kink at its
   end may be a square root; a jump found again at an end is a steeper singularity.
   [in,out] intervals - its parts are appended;
   [in,out] num - of intervals; [in,out] found - jumps and kinks of the line */
static PetscErrorCode CubatureCutPiece_Private(const Line *line, const Interval *piece,
                                               PetscReal v[][CUBATURE_MAX_SIZE], Interval intervals[], PetscInt *num,
                                               Hints *found)
{
  const PetscReal near = NEAR * (piece->b - piece->a);
  Interval        cut  = *piece;
  PetscBool       jump = PETSC_FALSE, kink = PETSC_FALSE;
  PetscInt        end, beside              = 0;

  PetscFunctionBeginUser;
  if (!piece->root) PetscCall(CubatureFindJump_Private(line, piece, v, &cut, &jump));
  if (!piece->root && !jump) PetscCall(CubatureFindKink_Private(line, piece, v, &cut, &kink));
  end = !jump && !kink ? 0 : (cut.a - piece->a < near ? -1 : (piece->b - cut.b < near ? 1 : 0));
  if (end && kink && cut.root > TRIALS) {
    intervals[(*num)++] = (Interval){piece->a, piece->b, end, 0};
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if ((!jump && !kink) || (end && (kink || end == piece->beside))) {
    CubaturePiecePoint_Private(piece, 0.5, &cut.a);
    cut.b = cut.a;
  } else {
    beside = 1;
    if (found->num < MAX_HINTS) found->at[found->num++] = 0.5 * (cut.a + cut.b);
  }
  if (piece->b > cut.b) intervals[(*num)++] = (Interval){cut.b, piece->b, PetscMax(piece->root, 0), -beside};
  if (cut.b > cut.a) intervals[(*num)++] = (Interval){cut.a, cut.b, 0, 0};
  if (cut.a > piece->a) intervals[(*num)++] = (Interval){piece->a, cut.a, PetscMin(piece->root, 0), beside};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stores the middles between the jumps and kinks of a line as hints for the next lines. A narrow part may
   contain no point of a rule. */
static void CubatureKeepHints_Private(Hints *found, Hints *hints)
{
  PetscReal before = 0.;

  if (!found->num) return;
  PetscSortReal(found->num, found->at);
  hints->num = 0;
  for (PetscInt i = 0; i <= found->num; i++) {
    const PetscReal next = i < found->num ? found->at[i] : 1.;

    if (next - before > SAME_KINK && hints->num < MAX_HINTS) hints->at[hints->num++] = 0.5 * (before + next);
    before = next;
  }
}

/* Whether the values at a hint inside a piece are not those of the polynomial through all its points. Then it
   is cut there.
   [in] v - at the points of the piece */
static PetscErrorCode CubatureCheckHints_Private(const Line *line, const Interval *piece,
                                                 PetscReal v[][CUBATURE_MAX_SIZE], Interval *cut, PetscBool *differs)
{
  const Hints     *hints  = &line->nest->hints[line->level];
  const PetscReal  length = piece->b - piece->a;
  PetscReal        c[POINTS + 1], value[CUBATURE_MAX_SIZE], error;
  const PetscReal *at[POINTS + 1];

  PetscFunctionBeginUser;
  *differs = PETSC_FALSE;
  for (PetscInt h = 0; h < hints->num && !*differs; h++) {
    const PetscReal s = hints->at[h], x = (s - piece->a) / length;
    PetscReal       p = x;

    if (!(x > SAME_KINK && x < 1. - SAME_KINK)) continue;
    if (piece->root) p = piece->root < 0 ? PetscSqrtReal(x) : 1. - PetscSqrtReal(1. - x);
    for (PetscInt j = 0; j < POINTS; j++) {
      at[j] = v[j];
      c[j]  = -1.;
      for (PetscInt m = 0; m < POINTS; m++) {
        if (m != j) c[j] *= (p - CUBATURE_POINT[m]) / (CUBATURE_POINT[j] - CUBATURE_POINT[m]);
      }
    }
    at[POINTS] = value;
    c[POINTS]  = 1.;
    PetscCall(CubatureEvaluateLine_Private(line, s, value, &error));
    *differs = (PetscBool)(CubatureNorm_Private(line, POINTS + 1, c, at) * length / POINTS > PIECE);
    cut->a = cut->b = s;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The integral along a line from 0 to 1. */
static PetscErrorCode CubatureIntegrateLine_Private(const Line *line, PetscReal value[], PetscReal *error)
{
  const Cubature *cubature = line->nest->cubature;
  const PetscInt  size = cubature->size, pieces = cubature->pieces;
  const PetscReal inset = cubature->inset, length = 1. - 2. * inset, upper = inset + length;
  PetscReal       v[POINTS][CUBATURE_MAX_SIZE];
  Interval        intervals[MAX_INTERVALS];
  PetscInt        num = 0, taken = 0;
  Hints           found = {0, {0.}};

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, size));
  *error = 0.;
  for (PetscInt i = pieces; i > 0; i--)
    intervals[num++] =
        (Interval){inset + length * (i - 1) / pieces, i < pieces ? inset + length * i / pieces : upper, 0, 0};
  while (num > 0) {
    const Interval  piece = intervals[--num];
    const PetscReal ds    = piece.b - piece.a;
    PetscReal       inner = 0., w[POINTS], difference;
    Interval        cut   = piece;
    PetscBool       last, differs;

    for (PetscInt j = 0; j < POINTS; j++) {
      PetscReal s, part;

      w[j] = CUBATURE_WEIGHT[j] * CubaturePiecePoint_Private(&piece, CUBATURE_POINT[j], &s);
      PetscCall(CubatureEvaluateLine_Private(line, s, v[j], &part));
      inner += 0.5 * w[j] * part;
    }
    difference = ds * CubatureRuleDifference_Private(line, w, v);
    last       = (PetscBool)(cubature->count > cubature->budget || ds < inset || taken++ > MAX_TAKEN);
    if (difference > PIECE && !last) {
      PetscCall(CubatureCutPiece_Private(line, &piece, v, intervals, &num, &found));
      continue;
    }
    PetscCall(CubatureCheckHints_Private(line, &piece, v, &cut, &differs));
    if (differs && !last) {
      intervals[num++] = (Interval){cut.b, piece.b, PetscMax(piece.root, 0), 0};
      intervals[num++] = (Interval){piece.a, cut.a, PetscMin(piece.root, 0), 0};
      continue;
    }
    *error += ds * inner + (difference > PIECE ? difference : 0.);
    for (PetscInt j = 0; j < POINTS; j++) w[j] *= ds * (j % 2 ? 5. : 4.) / 9.;
    if (piece.a <= inset) w[0] += inset; // the inset is extrapolated by its neighbour
    if (piece.b >= upper) w[POINTS - 1] += inset;
    for (PetscInt j = 0; j < POINTS; j++) {
      for (PetscInt i = 0; i < size; i++) value[i] += w[j] * v[j][i];
    }
  }
  CubatureKeepHints_Private(&found, &line->nest->hints[line->level]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureFindCut(Cubature *cubature, PetscReal *at, PetscBool *found)
{
  const Interval whole = {0., 1., 0, 0};
  PetscReal      u[3], v[POINTS][CUBATURE_MAX_SIZE], error;
  Nest           nest = {.cubature = cubature};
  const Line     line = {&nest, 0, u, 1.};
  Interval       cut  = whole;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  for (PetscInt j = 0; j < POINTS; j++) PetscCall(CubatureEvaluateLine_Private(&line, CUBATURE_POINT[j], v[j], &error));
  if (CubatureRuleDifference_Private(&line, CUBATURE_WEIGHT, v) > PIECE) {
    PetscCall(CubatureFindJump_Private(&line, &whole, v, &cut, found));
    if (!*found) PetscCall(CubatureFindKink_Private(&line, &whole, v, &cut, found));
  }
  *at = 0.5 * (cut.a + cut.b);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureAdaptive(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  PetscReal  u[3];
  Nest       nest = {.cubature = cubature};
  const Line line = {&nest, 0, u, 1.}, coarse = {&nest, 0, u, SURVEY};

  PetscFunctionBeginUser;
  cubature->count = 0;
  if (REFERENCE[cubature->type].dim > 1) {
    PetscCall(CubaturePlanes(cubature, value, error));
    if (*error <= 1.) PetscFunctionReturn(PETSC_SUCCESS);
    cubature->count = 0;
    PetscCall(CubatureIntegrateLine_Private(&coarse, value, error));
  }
  PetscCall(CubatureIntegrateLine_Private(&line, value, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}
