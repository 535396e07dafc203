/* obstacle.c -- rigid obstacles as a gap along the nonmortar normal.

   Each shape is one ray problem: the signed t for which x + t n lies on the surface. It is the same in a plane and in space:
   a circle is the ball of its plane. */
#include <mortise/compat.h>
#include <mortise/obstacle.h>

/* Rays that run along a surface to within this cosine never meet it. */
static const PetscReal GRAZING = 1e-10;

static PetscReal Dot_Private(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0;
  for (PetscInt k = 0; k < dim; k++) sum += a[k] * b[k];
  return sum;
}

/* The root of a t^2 + 2 b t + c = 0 that stays bounded as a -> 0, without cancellation. Where the ray passes the surface
   by, the surface is continued from its outermost points, so that the gap stays continuous and large. */
static PetscReal NearRoot_Private(PetscReal a, PetscReal b, PetscReal c)
{
  const PetscReal root = PetscSqrtReal(PetscMax(b * b - a * c, 0));

  return -c / (b > 0 ? b + root : b - root);
}

/* a t^2 + 2 b t + c = 0 for what is round: from outside (radius > 0) where the ray enters it, from inside (radius < 0)
   where it leaves. a > 0 */
static PetscReal RoundGap_Private(PetscReal radius, PetscReal a, PetscReal b, PetscReal c)
{
  const PetscReal root = PetscSqrtReal(PetscMax(b * b - a * c, 0));

  if (radius < 0 && b < 0) return (root - b) / a;
  if (radius < 0) return root + b > 0 ? -c / (root + b) : PETSC_INFINITY;
  if (b < 0) return NearRoot_Private(a, b, c);
  return c > 0 ? PETSC_INFINITY : -(b + root) / a;
}

/* |d + t n| = |radius| with what of d = x - point and of n is across the axis: all of them for a ball, whose axis is zero. */
static PetscReal AxisGap_Private(const SceneObstacle *round, PetscInt dim, const PetscReal x[], const PetscReal n[])
{
  PetscReal d[3] = {0.}, across[3] = {0.}, a, b, c, da, na;

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - round->point[k];
  da = Dot_Private(dim, d, round->axis);
  na = Dot_Private(dim, n, round->axis);
  for (PetscInt k = 0; k < dim; k++) {
    d[k] -= da * round->axis[k];
    across[k] = n[k] - na * round->axis[k];
  }
  a = Dot_Private(dim, across, across);
  b = Dot_Private(dim, d, across);
  c = Dot_Private(dim, d, d) - round->radius * round->radius;
  return a > GRAZING * GRAZING ? RoundGap_Private(round->radius, a, b, c) : PETSC_INFINITY;
}

/* The paraboloid s = -|r|^2 / (2 R), s along its normal and r across it, both from the vertex. */
static PetscReal ParabolaGap_Private(const SceneObstacle *parabola, PetscInt dim, const PetscReal x[],
                                     const PetscReal n[])
{
  const PetscReal R    = parabola->radius;
  PetscReal       d[3] = {0.}, s, ns, rr, rn;

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - parabola->point[k];
  s  = Dot_Private(dim, d, parabola->normal);
  ns = Dot_Private(dim, n, parabola->normal);
  rr = Dot_Private(dim, d, d) - s * s;
  rn = Dot_Private(dim, d, n) - s * ns;
  return -ns > GRAZING ? NearRoot_Private(1 - ns * ns, rn + R * ns, rr + 2 * R * s) : PETSC_INFINITY;
}

PetscErrorCode ObstacleGap(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const PetscReal n[],
                           PetscReal *gap)
{
  PetscReal d[3], cosine;

  PetscFunctionBeginUser;
  switch (obstacle->kind) {
  case OBSTACLE_PLANE:
    for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - obstacle->point[k];
    cosine = -Dot_Private(dim, n, obstacle->normal);
    *gap   = cosine > GRAZING ? Dot_Private(dim, d, obstacle->normal) / cosine : PETSC_INFINITY;
    break;
  case OBSTACLE_BALL:
  case OBSTACLE_CYLINDER: *gap = AxisGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_PARABOLA: *gap = ParabolaGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_EXPRESSION: PetscCall(ExpressionEvaluate(obstacle->gap, dim, x, gap)); break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_SUP, "Obstacle of kind %d", (int)obstacle->kind);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
