/* test_dimension.c -- scenes whose bodies come from Gmsh files have the files' dimension without being told. */
#include "base/compat.h"
#include "base/usererror.h"
#include "scene/scene.h"
#include <string.h>
#include <test.h>
#include <unistd.h>

/* What a file holds, in every format that there is. */
static const struct {
  const char *file;
  PetscInt    dim;
} files[] = {{"disc_22.msh", 2},          {"disc_22_bin.msh", 2},        {"disc_41.msh", 2},    {"disc_41_bin.msh", 2},
             {"disc_quad8.msh", 2},       {"two_regions_22_bin.msh", 2}, {"bulge.msh", 2},      {"drum_22.msh", 3},
             {"drum_tets_22_bin.msh", 3}, {"drum_tets_41.msh", 3},       {"drum_41_bin.msh", 3}};

/* Reads a scene of two bodies: a file, and a file or a box. */
static PetscErrorCode ReadScene(const char file[], const char model[], const char second[], Scene *scene,
                                PetscErrorCode *code)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsClear(NULL));
  PetscCall(PetscOptionsInsertString(NULL, "-bodies a,b -a_young 1 -a_poisson 0.3 -b_young 1 -b_poisson 0.3"));
  PetscCall(PetscOptionsSetValue(NULL, "-a_dm_plex_filename", file));
  if (model) PetscCall(PetscOptionsSetValue(NULL, "-model", model));
  if (!second) PetscCall(PetscOptionsSetValue(NULL, "-b_dm_plex_filename", file));
  if (second) PetscCall(PetscOptionsSetValue(NULL, "-b_dm_plex_box_faces", second));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, scene));
  *code = SceneSetFromOptions(*scene);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void CheckSentence(PetscErrorCode code, const char *const words[])
{
  CHECK(code == MORTISE_ERR_USER);
  for (; *words; ++words) {
    if (!strstr(UserErrorSentence(), *words)) fprintf(stderr, "'%s' does not say '%s'\n", UserErrorSentence(), *words);
    CHECK(strstr(UserErrorSentence(), *words));
  }
}

/* A file decides; a model and a box may agree with it or not. */
static PetscErrorCode TestFile(const char file[], PetscInt dim)
{
  const char *const same = dim == 3 ? "2,2,2" : "2,2", *const other = dim == 3 ? "2,2" : "2,2,2";
  const char *const model = dim == 3 ? "solid" : "plane_stress", *const wrong = dim == 3 ? "plane_stress" : "solid";
  char           has[32];
  PetscErrorCode code;
  Scene          scene;

  PetscFunctionBeginUser;
  for (int i = 0; i < 3; ++i) {
    PetscCall(ReadScene(file, i == 2 ? model : NULL, i == 1 ? same : NULL, &scene, &code));
    PetscCall(code);
    CHECK(scene->dim == dim && (scene->model == MODEL_SOLID) == (dim == 3));
    PetscCall(SceneDestroy(&scene));
  }
  PetscCall(PetscSNPrintf(has, sizeof(has), "this one has %d", dim == 3 ? 2 : 3));
  PetscCall(ReadScene(file, NULL, other, &scene, &code));
  CheckSentence(code, (const char *[]){"-b_dm_plex_box_faces", "same dimensions", has, file, NULL});
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscSNPrintf(has, sizeof(has), "-model %s has %d", wrong, dim == 3 ? 2 : 3));
  PetscCall(ReadScene(file, wrong, NULL, &scene, &code));
  CheckSentence(code,
                (const char *[]){"-a_dm_plex_filename", file, dim == 3 ? "dimension 3" : "dimension 2", has, NULL});
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  CHECK(!chdir(MESHES)); /* sentences show so much of a long path */
  for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++) PetscCall(TestFile(files[i].file, files[i].dim));
  PetscCall(PetscFinalize());
  return 0;
}
