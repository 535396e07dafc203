/* test_adaptcurves.c -- curved sides of meshes that are bisected: of files of first and second order, and of maps, on any number of ranks. */
#include "mesh_scene.h"

enum { NUM_SECTORS = 16, BALL_STEPS = 5, NUM_ARCS = 8, NUM_LAYERS = 2 };

/* A file of first order: vertices, cells with the group 1, facets with the group 2. */
typedef struct {
  PetscInt  dim, num_vertices, num_cells, num_facets;
  PetscReal x[512][3];
  PetscInt  cell[512][4], facet[512][3];
} Model;

static void ModelWrite(const Model *model, const char path[])
{
  const char *const names[] = {"cells", "rim"};
  FILE             *file;
  PetscMPIInt       rank;

  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) {
    file = fopen(path, "w");
    CHECK(file);
    fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n");
    for (int i = 0; i < 2; i++) fprintf(file, "%d %d \"%s\"\n", (int)model->dim - i, i + 1, names[i]);
    fprintf(file, "$EndPhysicalNames\n$Nodes\n%d\n", (int)model->num_vertices);
    for (PetscInt v = 0; v < model->num_vertices; v++)
      fprintf(file, "%d %.17g %.17g %.17g\n", (int)v + 1, model->x[v][0], model->x[v][1], model->x[v][2]);
    fprintf(file, "$EndNodes\n$Elements\n%d\n", (int)(model->num_cells + model->num_facets));
    for (PetscInt f = 0; f < model->num_facets; f++) {
      fprintf(file, "%d %d 2 2 2", (int)f + 1, model->dim == 2 ? 1 : 2);
      for (PetscInt i = 0; i < model->dim; i++) fprintf(file, " %d", (int)model->facet[f][i] + 1);
      fprintf(file, "\n");
    }
    for (PetscInt c = 0; c < model->num_cells; c++) {
      fprintf(file, "%d %d 2 1 1", (int)(model->num_facets + c) + 1, model->dim == 2 ? 2 : 4);
      for (PetscInt i = 0; i <= model->dim; i++) fprintf(file, " %d", (int)model->cell[c][i] + 1);
      fprintf(file, "\n");
    }
    fprintf(file, "$EndElements\n");
    fclose(file);
  }
  CHECK(!MPI_Barrier(PETSC_COMM_WORLD));
}

/* Sectors of the unit disc. */
static void ModelDisc(Model *model)
{
  memset(model, 0, sizeof(*model));
  model->dim          = 2;
  model->num_vertices = NUM_SECTORS + 1;
  model->num_cells = model->num_facets = NUM_SECTORS;
  for (PetscInt i = 0; i < NUM_SECTORS; i++) {
    const PetscInt next = (i + 1) % NUM_SECTORS + 1;

    model->x[i + 1][0] = PetscCosReal(2 * PETSC_PI * i / NUM_SECTORS);
    model->x[i + 1][1] = PetscSinReal(2 * PETSC_PI * i / NUM_SECTORS);
    model->cell[i][1] = model->facet[i][0] = i + 1;
    model->cell[i][2] = model->facet[i][1] = next;
  }
}

/* The vertex at a place, added if it is new. */
static PetscInt ModelVertex(Model *model, const PetscReal x[3])
{
  PetscInt v = 0;

  for (; v < model->num_vertices; v++) {
    if (PetscSqr(model->x[v][0] - x[0]) + PetscSqr(model->x[v][1] - x[1]) + PetscSqr(model->x[v][2] - x[2]) < 1e-20)
      return v;
  }
  memcpy(model->x[v], x, 3 * sizeof(PetscReal));
  return model->num_vertices++;
}

/* The unit ball: an octahedron's faces in parts, each with the centre. */
static void ModelBall(Model *model)
{
  memset(model, 0, sizeof(*model));
  model->dim          = 3;
  model->num_vertices = 1;
  for (PetscInt face = 0; face < 8; face++) {
    for (PetscInt i = 0; i < BALL_STEPS; i++) {
      for (PetscInt j = 0; j < 2 * (BALL_STEPS - i) - 1; j++) {
        const PetscInt up = j / 2, turned = j % 2;
        const PetscInt at[3][2] = {{i + turned, up + (turned ? 0 : 0)}, {i + 1, up + turned}, {i, up + 1}};

        for (PetscInt k = 0; k < 3; k++) {
          const PetscReal a    = PETSC_PI / 2 * at[k][0] / BALL_STEPS; // along great circles
          const PetscReal t    = at[k][0] < BALL_STEPS ? PETSC_PI / 2 * at[k][1] / (BALL_STEPS - at[k][0]) : 0;
          const PetscReal x[3] = {PetscSinReal(a) * (face & 1 ? -1 : 1),
                                  PetscCosReal(a) * PetscCosReal(t) * (face & 2 ? -1 : 1),
                                  PetscCosReal(a) * PetscSinReal(t) * (face & 4 ? -1 : 1)};

          model->cell[model->num_cells][k + 1] = model->facet[model->num_facets][k] = ModelVertex(model, x);
        }
        model->num_cells++;
        model->num_facets++;
      }
    }
  }
}

/* The unit cylinder: prisms of columns p < q < r in three cells each, whose diagonals go up to the later column. The rim is its round side. */
static void ModelCylinder(Model *model)
{
  memset(model, 0, sizeof(*model));
  model->dim = 3;
  for (PetscInt i = 0; i < NUM_SECTORS * NUM_LAYERS; i++) {
    const PetscInt q = PetscMin(i % NUM_SECTORS, (i + 1) % NUM_SECTORS),
                   r = q + (i % NUM_SECTORS == NUM_SECTORS - 1 ? NUM_SECTORS - 1 : 1);
    PetscInt low[3], high[3]; // vertices of the axis and of both columns of the rim

    for (PetscInt k = 0; k < 3; k++) {
      const PetscReal angle  = 2 * PETSC_PI * (k == 1 ? q : r) / NUM_SECTORS;
      const PetscReal bottom = -1 + 2. / NUM_LAYERS * (i / NUM_SECTORS);

      low[k]  = ModelVertex(model, (PetscReal[]){k ? PetscCosReal(angle) : 0, k ? PetscSinReal(angle) : 0, bottom});
      high[k] = ModelVertex(
          model, (PetscReal[]){k ? PetscCosReal(angle) : 0, k ? PetscSinReal(angle) : 0, bottom + 2. / NUM_LAYERS});
    }
    for (PetscInt k = 0; k < 3; k++) {
      PetscInt *cell = model->cell[model->num_cells++];

      for (PetscInt j = 0; j < 4; j++) cell[j] = j <= k ? low[j] : high[j - 1];
      if (k) memcpy(model->facet[model->num_facets++], &cell[1], 3 * sizeof(PetscInt));
    }
  }
}

/* A body of a file whose rim meets a box. */
static Mesh MakeMesh(TestScene *t, const char file[], PetscInt dim, PetscInt order)
{
  SceneBody *body;

  TestSceneInit(t);
  t->scene.dim      = dim;
  t->scene.adapt.on = PETSC_TRUE;
  body              = TestSceneAddFile(t, "round", file, NULL);
  body->order       = order;
  body              = TestSceneAddBox(t, "box", 1, 1, -1, -2, 1, -1);
  body->order       = order;
  body->faces[2]    = 1;
  body->lower[2]    = -1;
  body->upper[2]    = 1;
  TestSceneAddPair(t, "joint", 0, "rim", 1, dim == 2 ? "top" : "back");
  return TestSceneMesh(t);
}

/* Marks cells whose first vertex is near a place. */
static void Adapt(Mesh mesh, PetscReal x, PetscReal y, PetscReal radius)
{
  const Level *level = MeshFinest(mesh);
  PetscInt    *marked;

  CHECK(!PetscMalloc1(level->num_cells, &marked));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscReal *at      = &level->coords[level->cell_nodes[level->cell_start[c]] * level->dim];
    PetscReal        nearest = PETSC_MAX_REAL;

    for (PetscInt i = 0; i <= level->dim; i++) {
      at      = &level->coords[level->cell_nodes[level->cell_start[c] + i] * level->dim];
      nearest = PetscMin(nearest, PetscSqr(at[0] - x) + PetscSqr(at[1] - y));
    }
    marked[c] = (PetscBool)(nearest < radius * radius);
  }
  CHECK(!MeshAdapt(mesh, marked));
  CHECK(!PetscFree(marked));
}

/* The area or volume of a body. */
static PetscReal BodyVolume(const Level *level, PetscInt body)
{
  PetscReal volume = 0;

  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];
    PetscReal X[3 * ELEMENT_MAX_NODES], xi[3 * ELEMENT_MAX_POINTS], weight[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES];
    const PetscInt num = QuadratureRule(type, ElementOrder(type) > 1 ? level->dim : 1, xi, weight);

    if (level->cell_body[c] != body) continue;
    for (PetscInt i = 0; i < level->cell_start[c + 1] - level->cell_start[c]; i++)
      memcpy(&X[i * level->dim], &level->coords[level->cell_nodes[level->cell_start[c] + i] * level->dim],
             (size_t)level->dim * sizeof(PetscReal));
    for (PetscInt q = 0; q < num; q++) volume += weight[q] * ElementMap(type, X, &xi[q * level->dim], NULL, phi, NULL);
  }
  return Total(volume);
}

/* All nodes of a side are on a circle or cylinder (two axes), or on a sphere (three). */
static void CheckRound(TestScene *t, Level *level, const char side[], PetscInt axes, PetscReal radius,
                       PetscReal tolerance)
{
  Facets facets;

  CHECK(!LevelGetFacets(level, &t->scene, 0, side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
      const PetscReal *x = &level->coords[facets.nodes[f * ELEMENT_MAX_FACET_NODES + i] * level->dim];

      CHECK_NEAR(PetscSqrtReal(x[0] * x[0] + x[1] * x[1] + (axes == 3 ? x[2] * x[2] : 0)), radius, tolerance);
    }
  }
  CHECK(!FacetsDestroy(&facets));
}

/* A file of first order that is taken for smooth: a disc, a ball. Nodes are on them, and the volume tends to theirs. */
static void TestRound(PetscInt dim, PetscInt order)
{
  char            path[64];
  const PetscReal exact = dim == 2 ? PETSC_PI : 4 * PETSC_PI / 3;
  static Model    model;
  TestScene       t;
  Mesh            mesh;
  PetscReal       error[4];
  PetscMPIInt     size;

  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  (void)snprintf(path, sizeof(path), "round%dd_%d.msh", (int)dim,
                 size); // tests with other ranks may run beside this one
  if (dim == 2)
    ModelDisc(&model);
  else
    ModelBall(&model);
  ModelWrite(&model, path);
  mesh = MakeMesh(&t, path, dim, order);
  CHECK(t.bodies[0].arcs);
  for (PetscInt step = 0; step < (dim == 2 ? 4 : 1); step++) { // around the place of contact, then everywhere
    CheckRound(&t, MeshFinest(mesh), "rim", dim, 1, 1e-13);
    Adapt(mesh, 0, -1, .3 * PetscPowRealInt(.5, (int)step));
  }
  CheckRound(&t, MeshFinest(mesh), "rim", dim, 1, 1e-13);
  for (PetscInt step = 0; step < (dim == 2 ? 3 : 2); step++) {
    error[step] = PetscAbsReal(BodyVolume(MeshFinest(mesh), 0) - exact);
    CHECK(!MeshAdaptAll(mesh));
    CheckRound(&t, MeshFinest(mesh), "rim", dim, 1, 1e-13);
    if (step) CHECK(error[step] < (order == 1 ? .3 : .08) * error[step - 1]); // 1/4 and 1/16
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A cylinder of a file of first order. Edges along its axis that halve curved faces are straight: their middle nodes are on the cylinder, too. */
static void TestCylinder(void)
{
  char         path[64];
  static Model model;
  TestScene    t;
  Mesh         mesh;
  PetscMPIInt  size;

  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  (void)snprintf(path, sizeof(path), "cylinder_%d.msh", size);
  ModelCylinder(&model);
  ModelWrite(&model, path);
  mesh = MakeMesh(&t, path, 3, 2);
  for (PetscInt step = 0; step < 4; step++) {
    CheckRound(&t, MeshFinest(mesh), "rim", 2, 1, 1e-13);
    Adapt(mesh, 0, -1, .4 * PetscPowRealInt(.5, (int)step));
  }
  CheckRound(&t, MeshFinest(mesh), "rim", 2, 1, 1e-13);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A ring that a map makes of a box, and a file of second order, whose parabolas stay what they are. */
static void TestRing(PetscInt order)
{
  TestScene  t;
  SceneBody *body;
  Mesh       mesh;
  PetscReal  error[4];

  TestSceneInit(&t);
  t.scene.adapt.on = PETSC_TRUE;
  body             = TestSceneAddBox(&t, "ring", 2, 4, 1, 0, 2, 1);
  body->order      = order;
  TestSceneSetMap(body, "x*cos(1.5*y), x*sin(1.5*y)");
  TestSceneAddBox(&t, "box", 1, 1, 2, 0, 3, 1)->order = order;
  TestSceneAddPair(&t, "joint", 0, "right", 1, "left");
  mesh = TestSceneMesh(&t);
  for (PetscInt step = 0; step < 4; step++) Adapt(mesh, 2, 0, PetscPowRealInt(.5, (int)step));
  for (PetscInt step = 0; step < 3; step++) {
    error[step] = PetscAbsReal(BodyVolume(MeshFinest(mesh), 0) - 2.25);
    CheckRound(&t, MeshFinest(mesh), "right", 2, 2, 1e-14);
    CHECK(!MeshAdaptAll(mesh));
    if (step) CHECK(error[step] < (order == 1 ? .3 : .08) * error[step - 1]);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The area of eight parabolas through points of the unit circle, and of their chords on two uniform levels below. */
static void TestParabolas(PetscInt order)
{
  const PetscReal half = PETSC_PI / NUM_ARCS, chords = NUM_ARCS * PetscSinReal(half) * PetscCosReal(half);
  const PetscReal between = NUM_ARCS * 2. / 3 * 2 * PetscSinReal(half) * (1 - PetscCosReal(half));
  TestScene       t;
  Mesh            mesh = MakeMesh(&t, MESHES "/disc_22.msh", 2, order);
  PetscReal       part = order == 1 ? 0 : 1; // of what is between

  for (PetscInt step = 0; step < 3; step++) {
    CHECK_NEAR(BodyVolume(MeshFinest(mesh), 0), chords + part * between, 1e-8);
    CHECK(!MeshAdaptAll(mesh));
    part = (3 + part) / 4; // chords of halves of a parabola leave a quarter
  }
  for (PetscInt step = 0; step < 3; step++) {
    Adapt(mesh, 0, -1, PetscPowRealInt(.5, (int)step));
    if (order == 2) CHECK_NEAR(BodyVolume(MeshFinest(mesh), 0), chords + between, 1e-8);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A map that bends cells of order 2 so much that halves are tangled and quarters are not. */
static void TestTangled(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.adapt.on                                         = PETSC_TRUE;
  TestSceneAddBox(&t, "a", 2, 2, 0, 0, 1, 1)->order        = 2;
  TestSceneAddBox(&t, "box", 1, 1, 0, -1, 1, -.5)->simplex = PETSC_TRUE;
  TestSceneSetMap(t.bodies,
                  "x+0.1*exp(-((x-0.125)^2+(y-0.125)^2)/0.15^2), y+0.1*exp(-((x-0.125)^2+(y-0.125)^2)/0.15^2)");
  mesh = TestSceneMesh(&t);
  CHECK(MeshIsCut(mesh, 0));
  CHECK(!MeshIsCut(mesh, 1));
  CHECK(!MeshAdaptAll(mesh)); // 4 times 8 cells, 14 of them more for the tangled ones, and 4 times 2
  CHECK_NEAR(Total(MeshFinest(mesh)->num_cells), 46 + 8, 0);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 2; dim <= 3; dim++) {
    for (PetscInt order = 1; order <= 2; order++) TestRound(dim, order);
  }
  TestCylinder();
  for (PetscInt order = 1; order <= 2; order++) {
    TestRing(order);
    TestParabolas(order);
  }
  TestTangled();
  PetscCall(PetscFinalize());
  return 0;
}
