/* test_round.c -- what is round where forces carry a body, and what is an edge, or flat. */
#include "base/compat.h"
#include "rigid/solvability.h"
#include "test.h"
#include "checks/roundness.h"

/* A square becomes a disc. */
static const char *const disc[] = {"-a_map", "x*sqrt(1-y^2/2), y*sqrt(1-x^2/2)", NULL};

static PetscErrorCode Check(const char *const more[], PetscBool expected)
{
  static const char *const common[] = {"-bodies",
                                       "a",
                                       "-a_dm_plex_simplex",
                                       "0",
                                       "-a_dm_plex_box_faces",
                                       "8,8",
                                       "-a_dm_plex_box_lower",
                                       "-1,-1",
                                       "-a_dm_plex_box_upper",
                                       "1,1",
                                       "-a_young",
                                       "1",
                                       "-a_poisson",
                                       "0.3",
                                       "-a_body_force",
                                       "0,-1",
                                       "-pairs",
                                       "floor",
                                       "-floor_nonmortar",
                                       "a:bottom",
                                       "-floor_obstacle",
                                       "plane",
                                       "-floor_obstacle_point",
                                       "0,-1",
                                       "-floor_obstacle_normal",
                                       "0,1",
                                       NULL};
  Scene                    scene;
  Mesh                     mesh;
  VI                       vi;
  Solvability              solvability;
  PetscBool                round;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsClear(NULL));
  for (int i = 0; common[i]; i += 2) PetscCall(PetscOptionsSetValue(NULL, common[i], common[i + 1]));
  for (int i = 0; more[i]; i += 2) PetscCall(PetscOptionsSetValue(NULL, more[i], more[i + 1]));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(VICreate(scene, mesh, &vi));
  PetscCall(SolvabilityCreate(vi, &solvability));
  CHECK(solvability);
  PetscCall(RoundnessCarriesLoads(vi, solvability, &round));
  CHECK(round == expected);
  PetscCall(SolvabilityDestroy(&solvability));
  PetscCall(VIDestroy(&vi));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  static const char *const flat[] = {NULL};

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Check(disc, PETSC_TRUE));
  PetscCall(Check(flat, PETSC_FALSE));
  PetscCall(PetscFinalize());
  return 0;
}
