/* test_spheres.c -- normals and gaps of pairs of solids on spheres. */
#include "test.h"
#include "two_solids.h"

static const PetscReal INTERPOLATED = 2e-5;

/* Parts of spherical shells, one in the other, cut differently. [in] polygonal - sides remain straight facets; [out] worst - gap, sine of the angle between the normal and the radius */
static PetscErrorCode MeasureSpheres(ElementType cell, PetscBool polygonal, PetscInt level, PetscReal worst[2])
{
  const char *map =
      "z*tan(x)/sqrt(1+tan(x)^2+tan(y)^2), z*tan(y)/sqrt(1+tan(x)^2+tan(y)^2), z/sqrt(1+tan(x)^2+tan(y)^2)";
  const PetscReal wide = 0.4, lower[2][DIM] = {{-wide, -wide, 1}, {-wide, -wide, 0.5}};
  const PetscReal upper[2][DIM] = {{wide, wide, 1.5}, {wide, wide, 1}};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  SetSolid(&bodies[0], "outer", cell, 2 << level, 2 << level, 1, lower[0], upper[0]);
  SetSolid(&bodies[1], "inner", cell, 3 << level, 3 << level, 1, lower[1], upper[1]);
  for (PetscInt b = 0; b < 2; b++) bodies[b].polygonal = polygonal;
  PetscCall(MakePair(&scene, map, &mesh, &support, &pair));
  worst[0] = worst[1] = 0;
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscReal *x = &pair->level->coords[DIM * pair->nodes[k]], *n = &pair->normal[DIM * k];
    PetscReal        sine = 0;
    for (PetscInt j = 0; j < DIM; j++)
      sine += PetscSqr(n[(j + 1) % 3] * x[(j + 2) % 3] - n[(j + 2) % 3] * x[(j + 1) % 3]);
    sine     = PetscSqrtReal(sine);
    worst[0] = PetscMax(worst[0], PetscAbsReal(pair->gap[k]));
    worst[1] = PetscMax(worst[1], sine);
    CHECK(n[0] * x[0] + n[1] * x[1] + n[2] * x[2] < 0);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst, 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A side's own normals are exact on spheres (test_sideshape.c); between its nodes the partner's are so but for the interpolation between exact
   ones. Normals of facets on one side of an end alone would be off by h / 2 there, .05 and .03.
   Gaps err by h^2 between straight facets, by h^4 between the curves over their edges, and by h^3 on quadratic facets. */
static PetscErrorCode TestSpheres(ElementType cell, PetscBool polygonal)
{
  const PetscInt order = ElementOrder(cell);
  PetscReal      worst[2][2];

  PetscFunctionBeginUser;
  for (PetscInt level = 0; level < 2; level++) PetscCall(MeasureSpheres(cell, polygonal, level + 1, worst[level]));
  CHECK_NEAR(PetscLog2Real(worst[0][0] / worst[1][0]), order > 1 ? 3. : polygonal ? 2. : 4., 0.25);
  for (PetscInt level = 0; level < 2; level++) CHECK_NEAR(worst[level][1], 0., INTERPOLATED);
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const ElementType cells[4] = {ELEMENT_TET4, ELEMENT_HEX8, ELEMENT_TET10, ELEMENT_HEX27};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  for (PetscInt i = 0; i < 4; i++) PetscCall(TestSpheres(cells[i], PETSC_FALSE));
  for (PetscInt i = 0; i < 2; i++) PetscCall(TestSpheres(cells[i], PETSC_TRUE));
  PetscCall(PetscFinalize());
  return 0;
}
