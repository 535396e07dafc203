/* test_regions.c -- the material of each cell of a body with regions, on every level and any number of ranks.
   Levels are made by refinement of the body, of all bodies, and by bisection. */
#include "mesh_scene.h"

enum { STEPS = SANITIZED ? 1 : 3 }; // of bisection

/* A unit square in layers up to 0.3, 0.7 and 1, or a unit cube in layers up to 0.4 and 1. The last coordinate
   tells the layer. */
typedef struct {
  const char *file;
  PetscInt    dim, num_layers;
  PetscReal   top[3];
  const char *group[3]; /* NULL: in no region */
} Layers;

static const Layers Plane = {MESHES "/layers.msh", 2, 3, {0.3, 0.7, 1}, {"soft", "stiff layer", NULL}};
static const Layers Solid = {MESHES "/blocks.msh", 3, 2, {0.4, 1}, {NULL, "2"}};

/* A body alone, or the second of two bodies, the first of which has one material. */
typedef struct {
  TestScene   t;
  SceneRegion regions[MAX_ITEMS];
  PetscInt    body, material[3]; /* of the layers */
} RegionScene;

static void RegionSceneInit(RegionScene *r, const Layers *layers, PetscBool second, PetscInt order)
{
  SceneBody *body;

  memset(r->regions, 0, sizeof(r->regions));
  TestSceneInit(&r->t);
  r->t.scene.dim   = layers->dim;
  r->t.scene.model = layers->dim == 3 ? MODEL_SOLID : MODEL_PLANE_STRAIN;
  if (second) {
    body           = TestSceneAddBox(&r->t, "box", 2, 2, 5, 5, 6, 6);
    body->faces[2] = 2;
    body->upper[2] = 1;
    body->order    = order;
  }
  r->body            = r->t.scene.num_bodies;
  body               = TestSceneAddFile(&r->t, "strip", layers->file, NULL);
  body->order        = order;
  r->t.scene.regions = r->regions;
  for (PetscInt i = 0; i < layers->num_layers; i++) {
    r->material[i] = r->body;
    if (!layers->group[i]) continue;
    r->material[i] = r->t.scene.num_bodies + body->num_regions;
    r->regions[body->num_regions++] =
        (SceneRegion){.body = r->body, .group = (char *)layers->group[i], .prefix = (char *)"strip_x"};
  }
  r->t.scene.num_regions = body->num_regions;
}

/* Every cell by its middle; each material has cells on some rank, and those of the layers fill them. */
static void CheckLevel(const RegionScene *r, const Layers *layers, const Level *level)
{
  PetscReal size[MAX_ITEMS] = {0}, bottom = 0;

  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes  = &level->cell_nodes[level->cell_start[c]];
    const PetscInt  num    = ElementNumNodes(ElementLinear((ElementType)level->cell_type[c]));
    PetscReal       height = 0, X[ELEMENT_MAX_NODES * 3], points[ELEMENT_MAX_POINTS * 3], w[ELEMENT_MAX_POINTS];
    PetscReal       phi[ELEMENT_MAX_NODES];
    PetscInt        layer = 0, points_num;

    CHECK(level->cell_body[c] == SceneMaterialBody(&r->t.scene, level->cell_material[c]));
    if (level->cell_body[c] != r->body) {
      CHECK(level->cell_material[c] == level->cell_body[c]);
      continue;
    }
    for (PetscInt i = 0; i < num; i++) height += level->coords[nodes[i] * level->dim + level->dim - 1] / num;
    while (height > layers->top[layer]) layer++;
    CHECK(level->cell_material[c] == r->material[layer]);
    for (PetscInt i = 0; i < ElementNumNodes((ElementType)level->cell_type[c]); i++)
      for (PetscInt d = 0; d < level->dim; d++) X[i * level->dim + d] = level->coords[nodes[i] * level->dim + d];
    points_num = QuadratureRule((ElementType)level->cell_type[c], 3, points, w);
    for (PetscInt q = 0; q < points_num; q++)
      size[layer] += w[q] * ElementMap((ElementType)level->cell_type[c], X, &points[q * level->dim], NULL, phi, NULL);
  }
  for (PetscInt i = 0; i < layers->num_layers; i++) {
    CHECK_NEAR(Total(size[i]), layers->top[i] - bottom, 1e-12);
    bottom = layers->top[i];
  }
}

static void TestRefined(const Layers *layers, PetscBool second, PetscInt order)
{
  RegionScene r;
  Mesh        mesh;

  RegionSceneInit(&r, layers, second, order);
  r.t.bodies[r.body].refine = 1;
  r.t.scene.refine          = 1;
  mesh                      = TestSceneMesh(&r.t);
  CHECK(mesh->num_levels == 3); // what all bodies are refined makes a level, too
  for (PetscInt l = 0; l < mesh->num_levels; l++) CheckLevel(&r, layers, &mesh->levels[l]);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&r.t);
}

/* Cells near a corner are bisected; quadrilaterals are cut before. */
static void TestBisected(const Layers *layers, PetscBool second, PetscInt order)
{
  RegionScene r;
  Mesh        mesh;

  RegionSceneInit(&r, layers, second, order);
  r.t.scene.adapt.on = PETSC_TRUE;
  mesh               = TestSceneMesh(&r.t);
  for (PetscInt step = 0; step < STEPS; step++) {
    const Level *level = MeshFinest(mesh);
    PetscInt    *marked;

    CheckLevel(&r, layers, level);
    CHECK(!PetscMalloc1(level->num_cells, &marked));
    for (PetscInt c = 0; c < level->num_cells; c++) {
      const PetscReal *x = &level->coords[level->cell_nodes[level->cell_start[c]] * level->dim];

      marked[c] = (PetscBool)(PetscAbsReal(x[0]) + PetscAbsReal(x[level->dim - 1] - 0.3) < 0.3);
    }
    CHECK(!MeshAdapt(mesh, marked));
    CHECK(!PetscFree(marked));
  }
  CheckLevel(&r, layers, MeshFinest(mesh));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&r.t);
}

/* A scene without regions keeps no second array. */
static void TestNone(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "box", 4, 4, 0, 0, 1, 1);
  mesh = TestSceneMesh(&t);
  CHECK(MeshFinest(mesh)->cell_material == MeshFinest(mesh)->cell_body);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  const Layers *const all[] = {&Plane, &Solid};

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestNone();
  for (PetscInt i = 0; i < 2; i++) {
    for (PetscInt order = 1; order <= 2; order++) {
      TestRefined(all[i], (PetscBool)(order == 2), order);
      TestBisected(all[i], (PetscBool)(order == 1), order);
    }
  }
  PetscCall(PetscFinalize());
  return 0;
}
