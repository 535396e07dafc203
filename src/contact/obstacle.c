/* obstacle.c -- rigid obstacles as a gap along the nonmortar normal.

   Each shape is one ray problem: the signed t for which x + t n lies on the surface. */
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

/* |x + t n - centre| = |radius|: the ray enters a ball (radius > 0) or leaves a hollow (radius < 0). */
static PetscReal BallGap_Private(const SceneObstacle *ball, PetscInt dim, const PetscReal x[], const PetscReal n[])
{
  PetscReal d[3], b, c, root;

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - ball->point[k];
  b    = Dot_Private(dim, d, n);
  c    = Dot_Private(dim, d, d) - ball->radius * ball->radius;
  root = PetscSqrtReal(PetscMax(b * b - c, 0));
  if (ball->radius < 0) return b < 0 ? root - b : -c / (root + b);
  if (b < 0) return NearRoot_Private(1, b, c);
  return c > 0 ? PETSC_INFINITY : -b - root;
}

/* The paraboloid s = -|r|^2 / (2 R), s along its normal and r across it, both from the vertex. */
static PetscReal ParabolaGap_Private(const SceneObstacle *parabola, PetscInt dim, const PetscReal x[],
                                     const PetscReal n[])
{
  const PetscReal R = parabola->radius;
  PetscReal       d[3], s, ns, rr, rn;

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
  case OBSTACLE_BALL: *gap = BallGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_PARABOLA: *gap = ParabolaGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_EXPRESSION: PetscCall(ExpressionEvaluate(obstacle->gap, dim, x, gap)); break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_SUP, "Obstacle of kind %d", (int)obstacle->kind);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
