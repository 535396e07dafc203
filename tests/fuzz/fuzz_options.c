/* fuzz_options.c -- an options file, read into arguments and then into a scene. */
#include "base/optionsreader.h"
#include "scene/scene.h"
#include "fuzz.h"

/* The options in PETSc's database as a scene. */
static void ReadScene_Private(TextList *arguments)
{
  char **items = arguments->items;
  int    num   = arguments->num;
  Scene  scene = NULL;

  FuzzExpect(PetscOptionsClear(NULL));
  FuzzExpect(PetscOptionsInsertArgs(NULL, num, (void *)items));
  FuzzExpect(SceneCreate(PETSC_COMM_SELF, &scene));
  if (SceneSetFromOptions(scene) == PETSC_SUCCESS) {
    FuzzExpect(SceneCheckUnused(scene, PETSC_TRUE));
    FuzzExpect(SceneDestroy(&scene));
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char    *text           = FuzzText(data, size);
  char     sentence[2048] = "";
  TextList arguments = {0, NULL}, files = {0, NULL};
  Reader   reader = {
        .sentence = sentence, .len = sizeof(sentence), .target = &arguments, .arguments = &arguments, .files = &files};

  if (!text) return 0;
  OptionsReaderReadText(&reader, "input", text);
  if (!sentence[0] && arguments.num) ReadScene_Private(&arguments);
  TextListClear(&arguments);
  TextListClear(&files);
  free(text);
  return 0;
}
