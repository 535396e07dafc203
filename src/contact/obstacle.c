/* obstacle.c -- rigid obstacles as a gap along the contact normal, and their shape.

   For each shape, a ray gives the signed t for which x + t n lies on the surface. The formulas hold in a
   plane and in space: a circle is the ball of its plane. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/obstacle.h"
#include "kernel/vector.h"

/* Rays that are parallel to a surface to within this cosine do not meet it. */
static const PetscReal GRAZING = 1e-10;

/* Step of the differences of formulas, as a share of a facet. */
static const PetscReal DIFFERENCE = 1e-3;

/* The root of a t^2 + 2 b t + c = 0 that stays bounded as a -> 0, without cancellation. Where the ray misses
   the surface, the surface is continued from its outermost points, so that the gap stays continuous and
   large. */
static PetscReal ObstacleNearRoot_Private(PetscReal a, PetscReal b, PetscReal c)
{
  const PetscReal root = PetscSqrtReal(PetscMax(b * b - a * c, 0));

  return -c / (b > 0 ? b + root : b - root);
}

/* a t^2 + 2 b t + c = 0 for balls and cylinders. From outside (radius > 0) it is where the ray enters, from
   inside (radius < 0) where it leaves. a > 0 */
static PetscReal ObstacleRoundGap_Private(PetscReal radius, PetscReal a, PetscReal b, PetscReal c)
{
  const PetscReal root = PetscSqrtReal(PetscMax(b * b - a * c, 0));

  if (radius < 0 && b < 0) return (root - b) / a;
  if (radius < 0) return root + b > 0 ? -c / (root + b) : PETSC_INFINITY;
  if (b < 0) return ObstacleNearRoot_Private(a, b, c);
  return c > 0 ? PETSC_INFINITY : -(b + root) / a;
}

/* |d + t n| = |radius| with the parts of d = x - point and of n across the axis. For a ball, whose axis is
   zero, these are d and n themselves. */
static PetscReal ObstacleAxisGap_Private(const SceneObstacle *round, PetscInt dim, const PetscReal x[],
                                         const PetscReal n[])
{
  PetscReal d[3] = {0.}, across[3] = {0.}, a, b, c, da, na;

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - round->point[k];
  da = VectorDot(dim, d, round->axis);
  na = VectorDot(dim, n, round->axis);
  for (PetscInt k = 0; k < dim; k++) {
    d[k] -= da * round->axis[k];
    across[k] = n[k] - na * round->axis[k];
  }
  a = VectorDot(dim, across, across);
  b = VectorDot(dim, d, across);
  c = VectorDot(dim, d, d) - round->radius * round->radius;
  return a > GRAZING * GRAZING ? ObstacleRoundGap_Private(round->radius, a, b, c) : PETSC_INFINITY;
}

/* The paraboloid s = -|r|^2 / (2 R), s along its normal and r across it, both from the vertex. */
static PetscReal ObstacleParabolaGap_Private(const SceneObstacle *parabola, PetscInt dim, const PetscReal x[],
                                             const PetscReal n[])
{
  const PetscReal R    = parabola->radius;
  PetscReal       d[3] = {0.}, s, ns, rr, rn;

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - parabola->point[k];
  s  = VectorDot(dim, d, parabola->normal);
  ns = VectorDot(dim, n, parabola->normal);
  rr = VectorDot(dim, d, d) - s * s;
  rn = VectorDot(dim, d, n) - s * ns;
  return -ns > GRAZING ? ObstacleNearRoot_Private(1 - ns * ns, rn + R * ns, rr + 2 * R * s) : PETSC_INFINITY;
}

PetscErrorCode ObstacleGap(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const PetscReal n[],
                           PetscReal *gap)
{
  PetscReal d[3], cosine;

  PetscFunctionBeginUser;
  switch (obstacle->kind) {
  case OBSTACLE_PLANE:
    for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - obstacle->point[k];
    cosine = -VectorDot(dim, n, obstacle->normal);
    *gap   = cosine > GRAZING ? VectorDot(dim, d, obstacle->normal) / cosine : PETSC_INFINITY;
    break;
  case OBSTACLE_BALL:
  case OBSTACLE_CYLINDER: *gap = ObstacleAxisGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_PARABOLA: *gap = ObstacleParabolaGap_Private(obstacle, dim, x, n); break;
  case OBSTACLE_EXPRESSION: PetscCall(ExpressionEvaluate(obstacle->gap, dim, x, gap)); break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_SUP, "Obstacle of kind %d", (int)obstacle->kind);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A level set with a gradient and second derivatives: n = grad / |grad|, S = P hess P / |grad|, P across n.
   Returns whether the gradient is long enough. [in] least - what it must exceed */
static PetscBool ObstacleLevelSetShape_Private(PetscInt dim, const PetscReal gradient[], const PetscReal hessian[],
                                               PetscReal least, SurfacePoint *at)
{
  PetscReal length, P[9];

  for (PetscInt k = 0; k < dim; k++) at->normal[k] = gradient[k];
  length = FrameNormalize(dim, at->normal);
  if (!(length > least)) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim * dim; k++)
    P[k] = (k / dim == k % dim ? 1. : 0.) - at->normal[k / dim] * at->normal[k % dim];
  for (PetscInt k = 0; k < dim * dim; k++) {
    at->curvature[k] = 0;
    for (PetscInt a = 0; a < dim * dim; a++)
      at->curvature[k] += P[k / dim * dim + a / dim] * hessian[a] * P[a % dim * dim + k % dim] / length;
  }
  return PETSC_TRUE;
}

/* |x - point| across the axis; from inside with the opposite sign. */
static PetscBool ObstacleRoundShape_Private(const SceneObstacle *round, PetscInt dim, const PetscReal x[],
                                            SurfacePoint *at)
{
  const PetscReal sign = round->radius < 0 ? -1 : 1;
  PetscReal       d[3] = {0.}, along, hessian[9] = {0.};

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - round->point[k];
  along = VectorDot(dim, d, round->axis);
  for (PetscInt k = 0; k < dim; k++) d[k] = sign * (d[k] - along * round->axis[k]);
  for (PetscInt k = 0; k < dim * dim; k++)
    hessian[k] = sign * ((k / dim == k % dim ? 1. : 0.) - round->axis[k / dim] * round->axis[k % dim]);
  if (!ObstacleLevelSetShape_Private(dim, d, hessian, GRAZING * PetscAbsReal(round->radius), at)) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim * dim; k++) // on the surface itself, not through x
    at->curvature[k] *= VectorNorm(dim, d) / PetscAbsReal(round->radius);
  return PETSC_TRUE;
}

/* s + |r|^2 / (2 R), as in ObstacleParabolaGap_Private(). */
static PetscBool ObstacleParabolaShape_Private(const SceneObstacle *parabola, PetscInt dim, const PetscReal x[],
                                               SurfacePoint *at)
{
  PetscReal d[3] = {0.}, s, gradient[3] = {0.}, hessian[9] = {0.};

  for (PetscInt k = 0; k < dim; k++) d[k] = x[k] - parabola->point[k];
  s = VectorDot(dim, d, parabola->normal);
  for (PetscInt k = 0; k < dim; k++)
    gradient[k] = parabola->normal[k] + (d[k] - s * parabola->normal[k]) / parabola->radius;
  for (PetscInt k = 0; k < dim * dim; k++)
    hessian[k] =
        ((k / dim == k % dim ? 1. : 0.) - parabola->normal[k / dim] * parabola->normal[k % dim]) / parabola->radius;
  return ObstacleLevelSetShape_Private(dim, gradient, hessian, GRAZING, at);
}

/* By central differences. The gap falls by as much as a point moves along the normal of the side: a formula
   need not say so, since it is evaluated on the side alone. */
static PetscErrorCode ObstacleFormulaShape_Private(Expression gap, PetscInt dim, const PetscReal x[],
                                                   const SurfacePoint *own, PetscReal size, SurfacePoint *at,
                                                   PetscBool *known)
{
  const PetscReal h = DIFFERENCE * size;
  PetscReal       y[3], value, there[3][2], corner[4], gradient[3] = {0.}, hessian[9] = {0.}, lacks;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(y, x, dim));
  PetscCall(ExpressionTry(gap, dim, y, &value, known));
  for (PetscInt k = 0; k < dim && *known; k++) {
    for (PetscInt way = 0; way < 2 && *known; way++) {
      y[k] = x[k] + (way ? h : -h);
      PetscCall(ExpressionTry(gap, dim, y, &there[k][way], known));
    }
    y[k]                 = x[k];
    gradient[k]          = (there[k][1] - there[k][0]) / (2 * h);
    hessian[k * dim + k] = (there[k][1] - 2 * value + there[k][0]) / (h * h);
  }
  for (PetscInt k = 0; k < dim && *known; k++) {
    for (PetscInt j = 0; j < k && *known; j++) {
      for (PetscInt way = 0; way < 4 && *known; way++) {
        y[k] = x[k] + (way % 2 ? h : -h);
        y[j] = x[j] + (way / 2 ? h : -h);
        PetscCall(ExpressionTry(gap, dim, y, &corner[way], known));
      }
      y[k] = x[k];
      y[j] = x[j];

      hessian[k * dim + j] = hessian[j * dim + k] = (corner[3] - corner[1] - corner[2] + corner[0]) / (4 * h * h);
    }
  }
  lacks = 1 + VectorDot(dim, gradient, own->normal);
  for (PetscInt k = 0; k < dim; k++) gradient[k] -= lacks * own->normal[k];
  for (PetscInt k = 0; k < dim * dim; k++) hessian[k] -= lacks * own->curvature[k];
  if (*known) *known = ObstacleLevelSetShape_Private(dim, gradient, hessian, GRAZING, at);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ObstacleShape(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const SurfacePoint *own,
                             PetscReal size, SurfacePoint *at, PetscBool *known)
{
  PetscFunctionBeginUser;
  *known = PETSC_TRUE;
  switch (obstacle->kind) {
  case OBSTACLE_PLANE:
    *at = (SurfacePoint){.normal = {0}};
    for (PetscInt k = 0; k < dim; k++) at->normal[k] = obstacle->normal[k];
    break;
  case OBSTACLE_BALL:
  case OBSTACLE_CYLINDER: *known = ObstacleRoundShape_Private(obstacle, dim, x, at); break;
  case OBSTACLE_PARABOLA: *known = ObstacleParabolaShape_Private(obstacle, dim, x, at); break;
  case OBSTACLE_EXPRESSION: PetscCall(ObstacleFormulaShape_Private(obstacle->gap, dim, x, own, size, at, known)); break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_SUP, "Obstacle of kind %d", (int)obstacle->kind);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
