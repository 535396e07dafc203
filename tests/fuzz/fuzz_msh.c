/* fuzz_msh.c -- a Gmsh file, read and made a DMPlex. */
#define _GNU_SOURCE
#include "../../src/mesh/room.h"
#include "fuzz.h"
#include <sys/mman.h>
#include <unistd.h>

enum { MAX_SIZE = 1 << 16 }; /* of a file: large ones only take time */

/* What the program does with a file for a body of the plane or of space. */
static void ReadMesh_Private(const char path[], PetscInt dim)
{
  char      reason[MESH_SENTENCE] = "";
  GmshNames names;
  GmshMesh  mesh;
  DM        dm     = NULL;
  Curves    curves = {NULL, NULL};

  FuzzExpect(GmshRead(path, &names, &mesh, reason, sizeof(reason)));
  if (!reason[0]) FuzzExpect(GmshToPlex(&mesh, dim, &dm, &curves, reason));
  FuzzExpect(GmshMeshDestroy(&mesh));
  FuzzExpect(GmshNamesDestroy(&names));
  FuzzExpect(CurvesDestroy(&curves));
  FuzzExpect(DMDestroy(&dm));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  const int file = size <= MAX_SIZE ? memfd_create("mesh", 0) : -1;
  char      path[64];

  if (file < 0) return 0;
  snprintf(path, sizeof(path), "/proc/self/fd/%d", file);
  if (write(file, data, size) == (ssize_t)size) {
    for (PetscInt dim = 2; dim <= 3; ++dim) ReadMesh_Private(path, dim);
  }
  close(file);
  return 0;
}
