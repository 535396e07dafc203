/* file.c -- a body from a mesh file. */
#include "bodylist.h"
#include <mortise/compat.h>

PetscErrorCode BodyListCreateFile(const SceneBody *body, PetscInt dim, const SideNames *names, MeshFile *files,
                                  BodyList *list, char sentence[])
{
  (void)dim;
  (void)names;
  (void)files;
  (void)list;
  PetscFunctionBeginUser;
  snprintf(sentence, MESH_SENTENCE, "body '%s': mesh files cannot be read yet", body->name);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshFileDestroy(MeshFile *files)
{
  (void)files;
  PetscFunctionBeginUser;
  PetscFunctionReturn(PETSC_SUCCESS);
}
