/* planecut.c -- integrals of functions that jump or bend across planes.

   Most jumps and kinks are planes. Here they are searched on the edges of a simplex; dim of these points give
   a plane, which is confirmed in their middle. The simplex is cut along it, and its parts likewise, until two
   rules agree on all of them. A part without a plane, where two of them meet, is halved. */
#include "base/compat.h"
#include "kernel/planecut.h"
#include "kernel/referencecell.h"
#include "kernel/vector.h"

enum { MAX_DIM = 3, MAX_CORNERS = MAX_DIM + 1, MAX_EDGES = 6, MAX_SIMPLICES = 6, STACK = 256, MAX_DEPTH = 10 };

/* Evaluations for a reference cell. A plane takes 1500 to 3000 for each simplex. */
static const PetscInt LARGEST_COUNT = 60000;
/* Points on edges and vertices are moved towards the centroid by this part of their distance. At a jump, the
   faces of two parts have either value. */
static const PetscReal INWARD = 1e-6;
/* A corner nearer to a plane, relative to the simplex, is on it. */
static const PetscReal ON_PLANE = 1e-9;
/* A plane is confirmed within this part of the line across it. */
static const PetscReal CONFIRMED = 1e-3;
/* Parts of less volume, relative to the cell, are omitted. */
static const PetscReal SLIVER = 1e-13;
/* Part of the tolerance that is permitted for one simplex. */
static const PetscReal PART_SHARE = 1. / 16.;

typedef struct {
  PetscReal x[MAX_CORNERS][MAX_DIM];
  PetscInt  depth;
} Simplex;

/* A line from a to b in a reference cell. */
typedef struct {
  Cubature *cubature;
  PetscReal a[MAX_DIM], b[MAX_DIM];
} Segment;

static PetscErrorCode SegmentIntegrandFn(void *ctx, const PetscReal s[], PetscReal value[])
{
  const Segment *line = ctx;
  PetscReal      xi[MAX_DIM];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < REFERENCE[line->cubature->type].dim; k++)
    xi[k] = line->a[k] + s[0] * (line->b[k] - line->a[k]);
  PetscCall(line->cubature->integrand(line->cubature->ctx, xi, value));
  line->cubature->count++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest jump or kink on a line. */
static PetscErrorCode SegmentFindCut_Private(Segment *line, PetscReal *at, PetscBool *found)
{
  Cubature cubature = *line->cubature;

  PetscFunctionBeginUser;
  cubature.type      = ELEMENT_LINE2;
  cubature.integrand = SegmentIntegrandFn;
  cubature.ctx       = line;
  PetscCall(CubatureFindCut(&cubature, at, found));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* dim! times the volume of a simplex. */
static PetscReal SimplexVolume_Private(PetscInt dim, const Simplex *simplex)
{
  PetscReal e[MAX_DIM][MAX_DIM] = {{0.}};

  for (PetscInt i = 0; i < dim; i++)
    for (PetscInt k = 0; k < dim; k++) e[i][k] = simplex->x[i + 1][k] - simplex->x[0][k];
  return PetscAbsReal(dim == 2 ? VectorCrossPlane(e[0], e[1]) : VectorTriple(e[0], e[1], e[2]));
}

/* Adds the integrals over a simplex by a product of Gauss rules in collapsed coordinates. */
static PetscErrorCode SimplexIntegrate_Private(Cubature *cubature, const Simplex *simplex, PetscInt num,
                                               PetscReal value[])
{
  const PetscInt  dim    = REFERENCE[cubature->type].dim;
  const PetscReal volume = SimplexVolume_Private(dim, simplex);
  PetscReal       s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS], v[CUBATURE_MAX_SIZE];
  PetscInt        total = 1;

  PetscFunctionBeginUser;
  QuadratureLine(num, s, w);
  PetscCall(PetscArrayzero(value, cubature->size));
  for (PetscInt k = 0; k < dim; k++) total *= num;
  for (PetscInt q = 0; q < total; q++) {
    PetscReal xi[MAX_DIM] = {0.}, weight = volume, left = 1.;

    for (PetscInt k = 0, digits = q; k < dim; k++, digits /= num) {
      const PetscReal part = left * s[digits % num];

      for (PetscInt l = 0; l < dim; l++) xi[l] += part * simplex->x[k + 1][l];
      weight *= w[digits % num] * PetscPowRealInt(1. - s[digits % num], (int)(dim - 1 - k));
      left -= part;
    }
    for (PetscInt l = 0; l < dim; l++) xi[l] += left * simplex->x[0][l];
    PetscCall(cubature->integrand(cubature->ctx, xi, v));
    cubature->count++;
    for (PetscInt i = 0; i < cubature->size; i++) value[i] += weight * v[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Jumps and kinks on the edges. [out] cut - [num][dim] */
static PetscErrorCode SimplexFindCuts_Private(Cubature *cubature, const Simplex *simplex, PetscInt *num,
                                              PetscReal cut[][MAX_DIM])
{
  const PetscInt dim             = REFERENCE[cubature->type].dim;
  PetscReal      centre[MAX_DIM] = {0.}, at;
  PetscBool      found;
  Segment        edge = {.cubature = cubature};

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = 0; i <= dim; i++)
    for (PetscInt k = 0; k < dim; k++) centre[k] += simplex->x[i][k] / (PetscReal)(dim + 1);
  for (PetscInt i = 0; i <= dim; i++) {
    for (PetscInt j = 0; j < i; j++) {
      for (PetscInt k = 0; k < dim; k++) {
        edge.a[k] = simplex->x[j][k] + INWARD * (centre[k] - simplex->x[j][k]);
        edge.b[k] = simplex->x[i][k] + INWARD * (centre[k] - simplex->x[i][k]);
      }
      PetscCall(SegmentFindCut_Private(&edge, &at, &found));
      for (PetscInt k = 0; k < dim && found; k++) cut[*num][k] = edge.a[k] + at * (edge.b[k] - edge.a[k]);
      *num += found;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The unit normal of the plane through dim points; returns the size of the figure that they make, 0 where it
   is too thin. */
static PetscReal PlaneNormal_Private(PetscInt dim, const PetscReal *const p[], PetscReal normal[])
{
  PetscReal a[MAX_DIM], b[MAX_DIM] = {0.}, length = 0., scale = 0.;

  for (PetscInt k = 0; k < dim; k++) {
    a[k] = p[1][k] - p[0][k];
    if (dim == 3) b[k] = p[2][k] - p[0][k];
    scale += PetscSqr(a[k]) + PetscSqr(b[k]);
  }
  if (dim == 2) {
    normal[0] = -a[1];
    normal[1] = a[0];
  } else {
    VectorCross(a, b, normal);
  }
  for (PetscInt k = 0; k < dim; k++) length += PetscSqr(normal[k]);
  length = PetscSqrtReal(length);
  for (PetscInt k = 0; k < dim; k++) normal[k] /= length > 0. ? length : 1.;
  return length > CONFIRMED * (dim == 3 ? scale : PetscSqrtReal(scale)) ? length : 0.;
}

/* The largest figure of dim cuts that is smaller than the last one.
   [in,out] size; [out] middle, normal - [dim] */
static PetscBool CutsChoose_Private(PetscInt dim, PetscInt num, PetscReal cut[][MAX_DIM], PetscReal *size,
                                    PetscReal middle[], PetscReal normal[])
{
  const PetscReal last = *size;

  *size = 0.;
  for (PetscInt choice = 1; choice < 1 << num; choice++) {
    const PetscReal *p[MAX_EDGES];
    PetscReal        n[MAX_DIM], length;
    PetscInt         chosen = 0;

    for (PetscInt i = 0; i < num; i++)
      if (choice & 1 << i) p[chosen++] = cut[i];
    if (chosen != dim) continue;
    length = PlaneNormal_Private(dim, p, n);
    if (length <= *size || length >= last) continue;
    *size = length;
    for (PetscInt k = 0; k < dim; k++) {
      normal[k] = n[k];
      middle[k] = 0.;
      for (PetscInt i = 0; i < dim; i++) middle[k] += p[i][k] / (PetscReal)dim;
    }
  }
  return (PetscBool)(*size > 0.);
}

/* Distances of the corners from a plane through some of the cuts, across which the function jumps or bends in
   their middle, too.
   [out] distance - [dim+1] */
static PetscErrorCode SimplexFindPlane_Private(Cubature *cubature, const Simplex *simplex, PetscInt num,
                                               PetscReal cut[][MAX_DIM], PetscReal distance[], PetscBool *found)
{
  const PetscInt  dim    = REFERENCE[cubature->type].dim;
  const PetscReal reach  = 0.1 * PetscPowReal(SimplexVolume_Private(dim, simplex), 1. / (PetscReal)dim);
  PetscReal       size   = PETSC_MAX_REAL, middle[MAX_DIM], normal[MAX_DIM], at;
  Segment         across = {.cubature = cubature};

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  while (!*found && CutsChoose_Private(dim, num, cut, &size, middle, normal)) {
    for (PetscInt k = 0; k < dim; k++) {
      across.a[k] = middle[k] - reach * normal[k];
      across.b[k] = middle[k] + 1.1 * reach * normal[k]; // the plane is not at a point of the rules
    }
    PetscCall(SegmentFindCut_Private(&across, &at, found));
    *found = (PetscBool)(*found && PetscAbsReal(at - 1. / 2.1) < CONFIRMED);
  }
  for (PetscInt i = 0; i <= dim && *found; i++) {
    distance[i] = 0.;
    for (PetscInt k = 0; k < dim; k++) distance[i] += (simplex->x[i][k] - middle[k]) * normal[k];
    if (PetscAbsReal(distance[i]) < ON_PLANE * reach) distance[i] = 0.;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two parts, between which a point of the edge i, j is a corner of both. */
static void SimplexBisect_Private(PetscInt dim, Simplex *simplex, PetscInt i, PetscInt j, PetscReal s, Simplex *other)
{
  *other = *simplex;
  for (PetscInt k = 0; k < dim; k++)
    other->x[i][k] = simplex->x[j][k] = simplex->x[i][k] + s * (simplex->x[j][k] - simplex->x[i][k]);
}

/* Cuts along a plane, edge by edge, and appends the parts.
   [in] given - distances of the corners from the plane [dim+1] */
static void SimplexCut_Private(PetscInt dim, Simplex simplex, const PetscReal given[], Simplex stack[], PetscInt *num)
{
  PetscReal distance[MAX_CORNERS], rest[MAX_CORNERS];
  Simplex   other;

  for (PetscInt i = 0; i <= dim; i++) rest[i] = distance[i] = given[i];
  for (PetscInt i = 0; i <= dim; i++) {
    for (PetscInt j = 0; j < i; j++) {
      if (distance[i] * distance[j] >= 0.) continue;
      SimplexBisect_Private(dim, &simplex, i, j, distance[i] / (distance[i] - distance[j]), &other);
      rest[i] = distance[j] = 0.;
      SimplexCut_Private(dim, other, rest, stack, num);
      SimplexCut_Private(dim, simplex, distance, stack, num);
      return;
    }
  }
  if (*num < STACK) stack[(*num)++] = simplex;
}

/* Halves the longest edge. */
static void SimplexHalve_Private(PetscInt dim, Simplex simplex, Simplex stack[], PetscInt *num)
{
  PetscReal longest = -1.;
  PetscInt  end[2]  = {0, 1};

  for (PetscInt i = 0; i <= dim; i++) {
    for (PetscInt j = 0; j < i; j++) {
      PetscReal length = 0.;

      for (PetscInt k = 0; k < dim; k++) length += PetscSqr(simplex.x[i][k] - simplex.x[j][k]);
      if (length <= longest) continue;
      longest = length;
      end[0]  = i;
      end[1]  = j;
    }
  }
  SimplexBisect_Private(dim, &simplex, end[0], end[1], 0.5, &stack[*num]);
  stack[*num + 1] = simplex;
  *num += 2;
}

/* A reference cell as simplices: itself, or those around a diagonal of the unit cube. */
static PetscInt CellSimplices_Private(const Reference *cell, Simplex stack[])
{
  static const PetscInt order[MAX_SIMPLICES][MAX_DIM] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                                         {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const PetscInt        dim = cell->dim, num = cell->simplex ? 1 : (dim == 2 ? 2 : MAX_SIMPLICES);

  for (PetscInt s = 0; s < num; s++) {
    stack[s] = (Simplex){.depth = 0};
    for (PetscInt i = 0; i < dim; i++) {
      for (PetscInt k = 0; k < dim && !cell->simplex; k++) stack[s].x[i + 1][k] = stack[s].x[i][k];
      stack[s].x[i + 1][order[s][i]] = 1.;
    }
  }
  return num;
}

PetscErrorCode CubaturePlanes(Cubature *cubature, PetscReal value[], PetscReal *error)
{
  enum { COARSE = 5, FINE = 6 };
  const Reference *cell = &REFERENCE[cubature->type];
  const PetscInt   dim  = cell->dim;
  Simplex          stack[STACK];
  PetscInt         num = CellSimplices_Private(cell, stack);
  PetscReal        scaled[CUBATURE_MAX_SIZE];
  Cubature         part = *cubature; // an error on a line counts with the volume of its simplex

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, cubature->size));
  *error = 0.;
  while (num > 0) {
    Simplex   simplex = stack[--num];
    PetscReal coarse[CUBATURE_MAX_SIZE], fine[CUBATURE_MAX_SIZE], cut[MAX_EDGES][MAX_DIM], distance[MAX_CORNERS],
        miss                 = 0.;
    PetscInt        num_cuts = 0;
    PetscBool       found    = PETSC_FALSE;
    const PetscReal volume   = SimplexVolume_Private(dim, &simplex);
    const PetscBool sliver   = (PetscBool)(volume < SLIVER);

    for (PetscInt i = 0; i < cubature->size; i++) scaled[i] = cubature->tolerance[i] / PetscMax(volume, SLIVER);
    part.tolerance = scaled;
    if (!sliver) PetscCall(SimplexFindCuts_Private(&part, &simplex, &num_cuts, cut));
    if (!num_cuts) {
      PetscCall(SimplexIntegrate_Private(&part, &simplex, FINE, fine));
      if (!sliver) PetscCall(SimplexIntegrate_Private(&part, &simplex, COARSE, coarse));
      if (!sliver) miss = CubatureDifference(cubature, fine, coarse);
    }
    if (!num_cuts && miss <= PART_SHARE) {
      for (PetscInt i = 0; i < cubature->size; i++) value[i] += fine[i];
      *error += miss;
      continue;
    }
    if (part.count > LARGEST_COUNT || num + 8 > STACK || ++simplex.depth > MAX_DEPTH) {
      *error = PETSC_MAX_REAL;
      break;
    }
    if (num_cuts >= dim) PetscCall(SimplexFindPlane_Private(&part, &simplex, num_cuts, cut, distance, &found));
    if (found)
      SimplexCut_Private(dim, simplex, distance, stack, &num);
    else
      SimplexHalve_Private(dim, simplex, stack, &num);
  }
  cubature->count = part.count;
  PetscFunctionReturn(PETSC_SUCCESS);
}
