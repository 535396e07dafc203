/* fuzz_msh.c -- a Gmsh file, read as it is, and as the body of a scene. The mesh of the scene is set up: regions, sides, tables,
   refinement, supports, roles.

   What the scene asks of the file are the bits of the file's last byte, which is no part of any section. */
#define _GNU_SOURCE
#include "bodies/bodylist.h"
#include "bodies/gmshplex.h"
#include "gmsh/gmsh.h"
#include "level/level.h"
#include "mesh/mesh.h"
#include "refinement/curves.h"
#include "support/support.h"
#include "fuzz.h"
#include <sys/stat.h>
#include <unistd.h>

enum {
  MAX_SIZE    = 1 << 16, /* of a file: large ones only take time */
  MAX_REFINED = 64,      /* elements of a file that is refined */
  MAX_SIDES   = 4,
  MAX_TEXT    = 1024
};

/* Bits of the last byte. */
enum {
  ORDER_TWO    = 1,
  REFINED      = 2,
  BODY_REFINED = 4,
  REGION       = 8,
  TWO_BODIES   = 16,
  AXISYMMETRIC = 32,
  MODEL        = 64,
  NAMES        = 128
};

/* What the scene may name: groups of cells and of facets, as the file has them. */
typedef struct {
  PetscInt dim, num_elements, num_cells, num_sides, cells, sides[MAX_SIDES];
} Groups;

static char Folder[64], Path[96];

static void RemoveFolder_Private(void)
{
  unlink(Path);
  rmdir(Folder);
}

/* The place that every file is written to, in memory where the machine has one. */
static void SetPath_Private(void)
{
  snprintf(Folder, sizeof(Folder), "%s/mortise-XXXXXX", access("/dev/shm", W_OK) ? "." : "/dev/shm");
  if (!mkdtemp(Folder)) abort();
  snprintf(Path, sizeof(Path), "%s/input.msh", Folder);
  atexit(RemoveFolder_Private);
}

static void AddSide_Private(Groups *groups, PetscInt side)
{
  for (PetscInt s = 0; s < groups->num_sides; ++s) {
    if (groups->sides[s] == side) return;
  }
  if (groups->num_sides < MAX_SIDES) groups->sides[groups->num_sides++] = side;
}

static void FindGroups_Private(const GmshMesh *mesh, Groups *groups)
{
  *groups = (Groups){.num_elements = mesh->num_elements};
  for (PetscInt e = 0; e < mesh->num_elements; ++e) groups->dim = PetscMax(groups->dim, mesh->type[e]->dim);
  for (PetscInt e = 0; e < mesh->num_elements; ++e) {
    groups->num_cells += mesh->type[e]->dim == groups->dim;
    if (mesh->first_group[e] == mesh->end_group[e]) continue;
    if (mesh->type[e]->dim == groups->dim) groups->cells = mesh->group[mesh->first_group[e]];
    if (mesh->type[e]->dim == groups->dim - 1) AddSide_Private(groups, mesh->group[mesh->first_group[e]]);
  }
}

/* The file made a DMPlex of the plane and of space. [out] groups - of no dimension where the file cannot be read */
static void ReadMesh_Private(Groups *groups)
{
  *groups = (Groups){.dim = 0};
  for (PetscInt dim = 2; dim <= 3; ++dim) {
    char      reason[MESH_SENTENCE] = "";
    GmshNames names;
    GmshMesh  mesh;
    DM        dm     = NULL;
    Curves    curves = {NULL, NULL};

    FuzzExpect(GmshRead(Path, &names, &mesh, reason, sizeof(reason)));
    if (!reason[0]) FindGroups_Private(&mesh, groups);
    if (!reason[0]) FuzzExpect(GmshPlexCreate(&mesh, dim, &dm, &curves, reason));
    FuzzExpect(GmshMeshDestroy(&mesh));
    FuzzExpect(GmshNamesDestroy(&names));
    FuzzExpect(CurvesDestroy(&curves));
    FuzzExpect(DMDestroy(&dm));
  }
}

/* The options of a scene in which the sides found are held, loaded and in contact. [out] text - [MAX_TEXT] */
static void WriteOptions_Private(const Groups *groups, int bits, char text[])
{
  const int   two = bits & TWO_BODIES ? 2 : 1, small = groups->num_elements <= MAX_REFINED;
  const char *model = groups->dim == 3 ? "-model solid" : bits & AXISYMMETRIC ? "-model axisymmetric" : "";
  int         used;

  used =
      snprintf(text, MAX_TEXT, "-bodies %s %s -order %d -dm_refine %d", two > 1 ? "a,b" : "a",
               bits & MODEL || groups->dim < 3 ? model : "", bits & ORDER_TWO ? 2 : 1, small && bits & REFINED ? 1 : 0);
  for (int b = 0; b < two; ++b) {
    const char name = "ab"[b];

    used += snprintf(text + used, MAX_TEXT - used, " -%c_dm_plex_filename %s -%c_young 1 -%c_poisson 0.3", name, Path,
                     name, name);
    if (bits & NAMES)
      used += snprintf(text + used, MAX_TEXT - used, " -%c_bc_normal side -%c_mesh_region %s", name, name,
                       bits & REGION ? "side" : "no_such");
    else if (bits & REGION)
      used += snprintf(text + used, MAX_TEXT - used, " -%c_mesh_region %d", name, (int)groups->cells);
    if (small && bits & BODY_REFINED) used += snprintf(text + used, MAX_TEXT - used, " -%c_dm_refine 1", name);
    if (groups->num_sides > 0 && !(bits & NAMES))
      used += snprintf(text + used, MAX_TEXT - used, " -%c_bc_normal %d", name, (int)groups->sides[0]);
  }
  if (groups->num_sides > 2)
    used += snprintf(text + used, MAX_TEXT - used, " -a_bc_displacement %d -a_bc_displacement_%d %s",
                     (int)groups->sides[1], (int)groups->sides[1], groups->dim == 3 ? "0,free,1" : "free,1");
  if (groups->num_sides > 2)
    snprintf(text + used, MAX_TEXT - used, " -pairs p -p_sides a:%d,%c:%d", (int)groups->sides[2], "ab"[two - 1],
             (int)groups -> sides[groups->num_sides - 1]);
}

/* The scene's mesh, its sides and its supports; a fault ends the scene, and leaves memory behind as it ends the program. */
static PetscErrorCode MeshScene_Private(Scene scene)
{
  const PetscReal x[3] = {0.25, 0.25, 0.25};
  PetscReal       xi[3];
  PetscInt        cell;
  PetscBool       found;
  Mesh            mesh;
  Support         support;
  Facets          facets;

  PetscFunctionBeginUser;
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(SupportCreate(MeshFinest(mesh), scene, &support));
  PetscCall(SupportDestroy(&support));
  for (PetscInt i = 0; i < scene->bodies[0].num_boundaries; ++i) {
    PetscCall(LevelGetFacets(MeshFinest(mesh), scene, 0, scene->bodies[0].boundaries[i].side, &facets));
    PetscCall(FacetsDestroy(&facets));
  }
  PetscCall(LevelLocate(MeshFinest(mesh), 0, x, &cell, xi, &found));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  Groups         groups;
  FILE          *file;
  char           options[MAX_TEXT];
  Scene          scene;
  PetscErrorCode code;

  if (!Path[0]) SetPath_Private();
  file = size && size <= MAX_SIZE ? fopen(Path, "wb") : NULL;
  if (!file) return 0;
  if (fwrite(data, 1, size, file) != size) abort();
  fclose(file);
  ReadMesh_Private(&groups);
  WriteOptions_Private(&groups, data[size - 1], options);
  FuzzExpect(PetscOptionsClear(NULL));
  FuzzExpect(PetscOptionsInsertString(NULL, options));
  FuzzExpect(SceneCreate(PETSC_COMM_SELF, &scene));
  code = MeshScene_Private(scene);
  FuzzExpect(code);
  if (!code) FuzzExpect(SceneDestroy(&scene));
  return 0;
}
