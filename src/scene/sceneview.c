/* sceneview.c -- -scene_view, as far as it is known without a mesh; src/output/meshview.c prints the rest. */
#include "scene/sceneparts.h"
#include <stdarg.h>
#include <string.h>

/* Characters of a datum that a line shows. */
enum { DATUM_SHOWN = 60 };

static PetscErrorCode ViewPrint_Private(Scene scene, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);

/* Prints like printf(): PetscPrintf() would write the number 1 as "1.". */
static PetscErrorCode ViewPrint_Private(Scene scene, const char format[], ...)
{
  char    text[OPTION_SENTENCE];
  va_list args;

  PetscFunctionBeginUser;
  va_start(args, format);
  vsnprintf(text, sizeof(text), format, args);
  va_end(args);
  PetscCall(PetscPrintf(scene->comm, "%s", text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static const char *ViewShorten_Private(Expression e, char shown[DATUM_SHOWN + 4])
{
  const char *text = ExpressionText(e);

  snprintf(shown, DATUM_SHOWN + 4, "%.*s%s", DATUM_SHOWN, text, strlen(text) > DATUM_SHOWN ? "..." : "");
  return shown;
}

static PetscErrorCode ViewBoundaries_Private(Scene scene, const SceneBody *body)
{
  static const char *const words[] = {"displacement", "normal displacement 0", "traction",
                                      "pressure",     "total force",           "total moment"}; /* BoundaryKind */
  char                     shown[DATUM_SHOWN + 4];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < body->num_boundaries; i++) {
    const SceneBoundary *b = &body->boundaries[i];

    PetscCall(ViewPrint_Private(scene, "    %-12s %s%s%s\n", b->side, words[b->kind], b->value ? " " : "",
                                b->value ? ViewShorten_Private(b->value, shown) : ""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ViewBox_Private(Scene scene, const SceneBody *body)
{
  static const char *const cells[][2] = {
      [2] = {"quadrilaterals", "squares cut into triangles"}, [3] = {"hexahedra", "bricks cut into tetrahedra"}};

  PetscFunctionBeginUser;
  PetscCall(ViewPrint_Private(scene, "  body %s: box", body->name));
  for (PetscInt d = 0; d < scene->dim; d++)
    PetscCall(ViewPrint_Private(scene, "%s [%g, %g]", d ? " x" : "", (double)body->lower[d], (double)body->upper[d]));
  for (PetscInt d = 0; d < scene->dim; d++)
    PetscCall(ViewPrint_Private(scene, " %s %" PetscInt_FMT, d ? "x" : "of", body->faces[d]));
  PetscCall(ViewPrint_Private(scene, " %s", cells[scene->dim][body->simplex]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What cells are made of; nothing of a body whose regions have all of it. */
static PetscErrorCode ViewMaterial_Private(Scene scene, const SceneMaterial *material, const char inside[])
{
  char shown[DATUM_SHOWN + 4];

  PetscFunctionBeginUser;
  if (material->stiffness) {
    PetscCall(ViewPrint_Private(scene, "Hooke matrix %s, turned by", ViewShorten_Private(material->stiffness, shown)));
    for (PetscInt i = 0; i < (scene->dim == 2 ? 1 : 3); i++)
      PetscCall(ViewPrint_Private(scene, "%s %g", i ? "," : "", (double)material->angle[i]));
    PetscCall(ViewPrint_Private(scene, " degrees\n"));
  } else {
    PetscCall(ViewPrint_Private(scene, "isotropic, Young's modulus %s", ViewShorten_Private(material->young, shown)));
    PetscCall(ViewPrint_Private(scene, ", Poisson's ratio %s\n", ViewShorten_Private(material->poisson, shown)));
  }
  if (material->body_force)
    PetscCall(ViewPrint_Private(scene, "    %-12s force per volume %s\n", inside,
                                ViewShorten_Private(material->body_force, shown)));
  if (material->temperature) {
    PetscCall(ViewPrint_Private(scene, "    %-12s temperature %s", inside,
                                ViewShorten_Private(material->temperature, shown)));
    PetscCall(ViewPrint_Private(scene, ", thermal expansion %s\n", ViewShorten_Private(material->expansion, shown)));
  }
  if (material->initial_strain)
    PetscCall(ViewPrint_Private(scene, "    %-12s initial strain %s\n", inside,
                                ViewShorten_Private(material->initial_strain, shown)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body's own material, and those of its regions. */
static PetscErrorCode ViewMaterials_Private(Scene scene, const SceneBody *body)
{
  PetscFunctionBeginUser;
  if (!body->missing) {
    PetscCall(ViewPrint_Private(scene, "    "));
    PetscCall(ViewMaterial_Private(scene, &body->material, "inside"));
  }
  for (PetscInt r = 0; r < body->num_regions; r++) {
    const SceneRegion *region = &scene->regions[body->first_region + r];

    PetscCall(ViewPrint_Private(scene, "    region %s: ", region->group));
    PetscCall(ViewMaterial_Private(scene, &region->material, "  inside"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ViewBody_Private(Scene scene, const SceneBody *body)
{
  char shown[DATUM_SHOWN + 4];

  PetscFunctionBeginUser;
  if (body->mesh_file) {
    PetscCall(ViewPrint_Private(scene, "  body %s: mesh %s%s%s", body->name, body->mesh_file,
                                body->region ? ", region " : "", body->region ? body->region : ""));
  } else {
    PetscCall(ViewBox_Private(scene, body));
  }
  if (body->map) PetscCall(ViewPrint_Private(scene, ", mapped to %s", ViewShorten_Private(body->map, shown)));
  if (body->refine) PetscCall(ViewPrint_Private(scene, ", refined %" PetscInt_FMT " times", body->refine));
  PetscCall(ViewPrint_Private(scene, ", order %" PetscInt_FMT "\n", body->order));
  PetscCall(ViewMaterials_Private(scene, body));
  if (body->pretension) {
    PetscCall(ViewPrint_Private(scene, "    %-12s pretension %s along", "inside",
                                ViewShorten_Private(body->pretension, shown)));
    for (PetscInt k = 0; k < scene->dim; k++)
      PetscCall(ViewPrint_Private(scene, "%s%g", k ? ", " : " (", (double)body->axis[k]));
    PetscCall(ViewPrint_Private(scene, ")\n"));
  }
  PetscCall(ViewBoundaries_Private(scene, body));
  if (body->exact)
    PetscCall(ViewPrint_Private(scene, "    %-12s %s\n", "exact", ViewShorten_Private(body->exact, shown)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ViewPair_Private(Scene scene, const ScenePair *pair)
{
  static const char *const obstacles[] = {"",         "plane",    "ball",
                                          "cylinder", "parabola", "obstacle given by its gap"}; /* ObstacleKind */
  const SceneSide         *s = &pair->nonmortar, *m = &pair->mortar;
  char                     shown[DATUM_SHOWN + 4];

  PetscFunctionBeginUser;
  PetscCall(ViewPrint_Private(scene, "  pair %s: %s, %s:%s %s ", pair->name,
                              pair->type == PAIR_TIED      ? "tied"
                              : ScenePairHasFriction(pair) ? "contact with friction"
                                                           : "contact without friction",
                              scene->bodies[s->body].name, s->side, pair->roles_open ? "and" : "(nonmortar) on"));
  if (m->body >= 0)
    PetscCall(ViewPrint_Private(scene, "%s:%s%s", scene->bodies[m->body].name, m->side,
                                pair->roles_open ? ", roles left to the program" : " (mortar)"));
  else
    PetscCall(ViewPrint_Private(scene, "a rigid %s", obstacles[pair->obstacle.kind]));
  if (pair->type == PAIR_CONTACT)
    PetscCall(ViewPrint_Private(scene, "; gap %s", pair->gap ? ViewShorten_Private(pair->gap, shown) : "measured"));
  if (pair->gap_offset) PetscCall(ViewPrint_Private(scene, " plus %s", ViewShorten_Private(pair->gap_offset, shown)));
  if (pair->friction)
    PetscCall(ViewPrint_Private(scene, "; coefficient of friction %s", ViewShorten_Private(pair->friction, shown)));
  if (pair->bound)
    PetscCall(ViewPrint_Private(scene, "; tangential traction of at most %s", ViewShorten_Private(pair->bound, shown)));
  if (scene->bodies[s->body].order > 1 && pair->multipliers == MULTIPLIERS_VERTICES)
    PetscCall(ViewPrint_Private(scene, "; multipliers at vertices"));
  if (pair->exact) PetscCall(ViewPrint_Private(scene, "; exact pressure %s", ViewShorten_Private(pair->exact, shown)));
  PetscCall(ViewPrint_Private(scene, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts data and, among them, those that vary in space. */
static void ViewCount_Private(Expression e, PetscInt *num, PetscInt *num_varying)
{
  if (!e) return;
  ++*num;
  *num_varying += !ExpressionIsConstant(e);
}

/* The same of all data of a material. */
static void ViewCountMaterial_Private(const SceneMaterial *m, PetscInt *num, PetscInt *num_varying)
{
  const Expression data[] = {m->young,       m->poisson,   m->stiffness,     m->body_force,
                             m->temperature, m->expansion, m->initial_strain};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(data); i++) ViewCount_Private(data[i], num, num_varying);
}

/* What a scene has. */
typedef struct {
  PetscInt data, varying; /* numbers and formulas; those that vary */
  PetscInt obstacles, tied, forces;
  PetscInt straightened; /* bodies of order 1 whose file has curved sides */
  PetscInt highest;      /* order */
} SceneCounts;

static SceneCounts ViewCountScene_Private(Scene scene)
{
  SceneCounts n = {.highest = 1};

  for (const SceneBody *b = scene->bodies; b < scene->bodies + scene->num_bodies; b++) {
    ViewCountMaterial_Private(&b->material, &n.data, &n.varying);
    ViewCount_Private(b->map, &n.data, &n.varying);
    ViewCount_Private(b->pretension, &n.data, &n.varying);
    ViewCount_Private(b->exact, &n.data, &n.varying);
    for (PetscInt i = 0; i < b->num_boundaries; i++) ViewCount_Private(b->boundaries[i].value, &n.data, &n.varying);
    n.forces += b->material.body_force ? 1 : 0;
    n.straightened += b->straightened ? 1 : 0;
    n.highest = PetscMax(n.highest, b->order);
  }
  for (const SceneRegion *r = scene->regions; r < scene->regions + scene->num_regions; r++) {
    ViewCountMaterial_Private(&r->material, &n.data, &n.varying);
    n.forces += r->material.body_force ? 1 : 0;
  }
  for (const ScenePair *p = scene->pairs; p < scene->pairs + scene->num_pairs; p++) {
    ViewCount_Private(p->gap, &n.data, &n.varying);
    ViewCount_Private(p->gap_offset, &n.data, &n.varying);
    ViewCount_Private(p->obstacle.gap, &n.data, &n.varying);
    ViewCount_Private(p->exact, &n.data, &n.varying);
    ViewCount_Private(p->friction, &n.data, &n.varying);
    ViewCount_Private(p->bound, &n.data, &n.varying);
    n.obstacles += p->obstacle.kind != OBSTACLE_NONE;
    n.tied += p->type == PAIR_TIED;
  }
  return n;
}

PetscErrorCode SceneViewLeftOut(Scene scene)
{
  const SceneCounts n = ViewCountScene_Private(scene);

  PetscFunctionBeginUser;
  PetscCall(ViewPrint_Private(scene, "  left out:\n"));
  if (n.tied == scene->num_pairs)
    PetscCall(ViewPrint_Private(
        scene, "    inequalities and active sets: no pair can open, one linear system is the answer\n"));
  if (n.obstacles) {
    PetscCall(ViewPrint_Private(
        scene, "    mesh, search and coupling of %" PetscInt_FMT " mortar side%s: obstacles are rigid\n", n.obstacles,
        n.obstacles == 1 ? "" : "s"));
  }
  if (n.varying < n.data) {
    PetscCall(ViewPrint_Private(
        scene, "    evaluation of formulas for %" PetscInt_FMT " of %" PetscInt_FMT " data: plain numbers\n",
        n.data - n.varying, n.data));
  }
  if (!n.forces) PetscCall(ViewPrint_Private(scene, "    forces on the inside of bodies: none given\n"));
  if (n.straightened) {
    PetscCall(ViewPrint_Private(scene,
                                "    curved sides in the mesh files of %" PetscInt_FMT " of %" PetscInt_FMT
                                " bodies: of order 1 they are chords\n",
                                n.straightened, scene->num_bodies));
  }
  if (n.highest == 1) PetscCall(ViewPrint_Private(scene, "    nodes on edges: every body is of order 1\n"));
  if (!scene->refine) PetscCall(ViewPrint_Private(scene, "    coarser and finer meshes: -dm_refine is 0\n"));
  if (!scene->output) PetscCall(ViewPrint_Private(scene, "    files: no -output\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ViewStudy_Private(Scene scene)
{
  const SceneStudy *study = &scene->study;

  PetscFunctionBeginUser;
  if (study->kind == STUDY_NONE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ViewPrint_Private(scene, "  study: %" PetscInt_FMT " meshes, each refined once more", study->levels));
  for (PetscInt i = 0; i < study->num_orders && study->orders[i] != STUDY_OWN_ORDERS; i++)
    PetscCall(ViewPrint_Private(scene, "%s %" PetscInt_FMT, i ? " and" : ", order", study->orders[i]));
  PetscCall(ViewPrint_Private(scene, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneView(Scene scene)
{
  static const char *const models[] = {"plane strain", "plane stress", "axisymmetric", "solid"}; /* ModelKind */

  PetscFunctionBeginUser;
  PetscCall(ViewPrint_Private(scene, "Scene%s%s: %s", scene->title[0] ? " " : "", scene->title, models[scene->model]));
  if (scene->model == MODEL_AXISYMMETRIC)
    PetscCall(ViewPrint_Private(scene, ", r = x, z = y; on the axis r = 0 the radial displacement is held at 0\n"));
  else if (scene->model == MODEL_SOLID)
    PetscCall(ViewPrint_Private(scene, "\n"));
  else
    PetscCall(ViewPrint_Private(scene, ", thickness %g\n", (double)scene->thickness));
  for (PetscInt i = 0; i < scene->num_bodies; i++) PetscCall(ViewBody_Private(scene, &scene->bodies[i]));
  for (PetscInt i = 0; i < scene->num_pairs; i++) PetscCall(ViewPair_Private(scene, &scene->pairs[i]));
  PetscCall(ViewStudy_Private(scene));
  for (PetscInt i = 0; i < scene->num_probes; i++) {
    const SceneProbe *p = &scene->probes[i];

    PetscCall(ViewPrint_Private(scene, "  probe %s: (", p->name));
    for (PetscInt d = 0; d < scene->dim; d++)
      PetscCall(ViewPrint_Private(scene, "%s%g", d ? ", " : "", (double)p->at[d]));
    PetscCall(ViewPrint_Private(scene, ") in %s\n", scene->bodies[p->body].name));
  }
  if (scene->refine)
    PetscCall(ViewPrint_Private(scene, "  all bodies refined %" PetscInt_FMT " times\n", scene->refine));
  PetscFunctionReturn(PETSC_SUCCESS);
}
