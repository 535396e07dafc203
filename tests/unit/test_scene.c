/* test_scene.c -- a scene read from options: what arrives, and the sentence that each mistake is answered with. */
#include "base/compat.h"
#include "base/usererror.h"
#include "scene/scene.h"
#include <string.h>
#include <test.h>

/* Two boxes and a pair; every mistake below changes a little of it. */
static const char *const base[][2] = {{"-bodies", "upper,lower"},
                                      {"-upper_dm_plex_box_faces", "4,3"},
                                      {"-upper_dm_plex_simplex", "0"},
                                      {"-upper_young", "8e9"},
                                      {"-upper_poisson", "0.3"},
                                      {"-upper_bc_displacement", "top"},
                                      {"-upper_bc_displacement_top", "free,-0.02"},
                                      {"-upper_bc_traction", "left,right"},
                                      {"-upper_bc_traction_left", "3e6*(1-y^2),-4e6"},
                                      {"-upper_bc_traction_right", "0,1"},
                                      {"-lower_dm_plex_box_faces", "2,2"},
                                      {"-lower_dm_plex_box_lower", "0,-1"},
                                      {"-lower_dm_plex_box_upper", "1,0"},
                                      {"-lower_young", "1e9"},
                                      {"-lower_poisson", "0.2"},
                                      {"-lower_bc_displacement", "bottom"},
                                      {"-lower_bc_displacement_bottom", "0,0"},
                                      {"-lower_bc_normal", "left+right"},
                                      {"-pairs", "joint"},
                                      {"-joint_nonmortar", "upper:bottom"},
                                      {"-joint_mortar", "lower:top"}};

/* The base scene without one option and with up to three others. */
typedef struct {
  const char *without;
  const char *change[3][2];
  const char *words[3]; /* that the sentence must hold */
} Mistake;

static const Mistake mistakes[] = {
    /* names */
    {"-bodies", {{NULL}}, {"-bodies", "missing"}},
    {"-bodies", {{"-bodeis", "upper,lower"}}, {"-bodeis upper,lower", "-bodies"}},
    {NULL, {{"-bodies", "upper,,lower"}}, {"-bodies", "empty"}},
    {NULL, {{"-bodies", "upper,lower,upper"}}, {"-bodies", "upper", "twice"}},
    {NULL, {{"-bodies", "upper,Lower,lower"}}, {"lower", "twice"}},
    {NULL, {{"-bodies", "upper,lower,2nd"}}, {"2nd", "letter"}},
    {NULL, {{"-bodies", "upper,lower,ksp"}}, {"ksp", "PETSc"}},
    {NULL, {{"-bodies", "upper,lower,upper_bc_traction"}}, {"upper_bc_traction", "option of both"}},
    {NULL, {{"-bodies", "upper,lower,upper_1"}}, {"upper_1", "rename"}},
    {NULL, {{"-pairs", "upper"}}, {"-pairs", "upper", "twice"}},
    /* misspelt options */
    {"-upper_young", {{"-upper_yuong", "1"}}, {"-upper_yuong 1", "-upper_young"}},
    {"-upper_bc_traction_left",
     {{"-upper_bc_tracton_left", "1,1"}},
     {"-upper_bc_tracton_left", "-upper_bc_traction_left"}},
    {NULL, {{"-tickness", "1"}}, {"-tickness 1", "-thickness"}},
    {NULL, {{"-uper_young", "1"}}, {"-uper_young", "-upper_young"}},
    {NULL, {{"-gravity_acceleration", "9.81"}}, {"-gravity_acceleration 9.81", "-<body>_body_force"}},
    {NULL, {{"-joint_mortr", "lower:top"}}, {"-joint_mortr", "-joint_mortar"}},
    {"-upper_dm_plex_box_faces",
     {{"-upper_dm_plex_box_face", "4,4"}},
     {"-upper_dm_plex_box_face 4,4", "-upper_dm_plex_box_faces?"}},
    {NULL, {{"-upper_bc_traction_top", "1,1"}}, {"-upper_bc_traction_top 1,1", "not listed in -upper_bc_traction"}},
    {NULL, {{"-output_format", "vtu"}}, {"-output_format vtu", "nothing in this scene"}},
    {NULL, {{"-upper_material_angle", "30"}}, {"-upper_material_angle 30", "nothing"}},
    {NULL, {{"-joint_obstacle_point", "0,0"}}, {"-joint_obstacle_point", "nothing in this scene"}},
    /* the scene as a whole */
    {NULL, {{"-model", "plane_strian"}}, {"-model plane_strian", "plane_stress", "did you mean plane_strain"}},
    {NULL, {{"-model", "solid"}}, {"-upper_dm_plex_box_faces", "-model solid has three dimensions"}},
    {NULL, {{"-model", "axisymmetric"}, {"-thickness", "2"}}, {"-thickness 2", "whole ring"}},
    {NULL, {{"-thickness", "0"}}, {"-thickness 0", "above 0"}},
    {NULL, {{"-thickness", "thin"}}, {"-thickness", "thin"}},
    {NULL, {{"-thickness", "1+x"}}, {"-thickness 1+x", "vary"}},
    {NULL, {{"-thickness", NULL}}, {"-thickness", "no value"}},
    {NULL, {{"-order", "3"}}, {"-order 3", "1, 2"}},
    {NULL, {{"-dm_refine", "-1"}}, {"-dm_refine -1", "smallest value is 0"}},
    {NULL, {{"-dm_refine", "2.5"}}, {"-dm_refine 2.5", "whole number"}},
    {NULL, {{"-dm_refine", sizeof(PetscInt) > 4 ? "30" : "16"}}, {"-upper_dm_plex_box_faces", "-dm_refine"}},
    /* meshes */
    {"-lower_dm_plex_box_faces", {{NULL}}, {"-lower_dm_plex_box_faces", "mesh"}},
    {NULL, {{"-upper_dm_plex_box_faces", "4"}}, {"-upper_dm_plex_box_faces 4", "2 wanted"}},
    {NULL, {{"-upper_dm_plex_box_faces", "4,0"}}, {"-upper_dm_plex_box_faces 4,0", "smallest"}},
    {NULL, {{"-upper_dm_plex_box_faces", "4,4,4"}}, {"-upper_dm_plex_box_faces 4,4,4", "same dimensions"}},
    {NULL, {{"-upper_dm_plex_box_faces", "4,many"}}, {"'many'", "whole number"}},
    {NULL, {{"-upper_dm_plex_box_upper", "1,-1"}}, {"-upper_dm_plex_box_upper 1,-1", "empty along y"}},
    {NULL, {{"-upper_dm_plex_simplex", "maybe"}}, {"-upper_dm_plex_simplex maybe", "yes"}},
    {NULL, {{"-upper_dm_plex_filename", "gear.msh"}}, {"-upper_dm_plex_box_faces", "-upper_dm_plex_filename gear.msh"}},
    {"-upper_dm_plex_box_faces",
     {{"-upper_dm_plex_filename", "no_such.msh"}},
     {"-upper_dm_plex_filename no_such.msh", "no such file"}},
    {NULL, {{"-upper_map", "x"}}, {"-upper_map", "2 wanted"}},
    /* materials */
    {"-upper_young", {{NULL}}, {"-upper_young", "missing", "-upper_stiffness"}},
    {"-upper_poisson", {{NULL}}, {"-upper_poisson", "missing"}},
    {NULL, {{"-upper_young", "0"}}, {"-upper_young 0", "above 0"}},
    {NULL, {{"-upper_young", "-8e9"}}, {"-upper_young -8e9", "above 0"}},
    {NULL, {{"-upper_young", "steel"}}, {"-upper_young", "steel"}},
    {NULL, {{"-upper_poisson", "0.5"}}, {"-upper_poisson 0.5", "mixed method", "below 0.4999995"}},
    {NULL, {{"-upper_poisson", "-1"}}, {"-upper_poisson -1", "above -1"}},
    {NULL, {{"-upper_poisson", "0.6"}, {"-model", "plane_stress"}}, {"-upper_poisson 0.6", "below 0.5"}},
    {NULL, {{"-upper_stiffness", "1,0,0,1,0,1"}}, {"-upper_young 8e9", "-upper_stiffness"}},
    {NULL, {{"-lower_poisson", "0.2,0.3"}}, {"-lower_poisson", "1 wanted"}},
    /* supports and loads */
    {NULL, {{"-upper_bc_displacement", "tpo"}}, {"tpo", "left, right, bottom, top"}},
    {NULL, {{"-upper_bc_traction", "left,right,left"}}, {"-upper_bc_traction", "left", "twice"}},
    {NULL, {{"-upper_bc_traction", "left+left,right"}}, {"-upper_bc_traction", "left", "twice"}},
    {NULL, {{"-upper_bc_traction", "left+,right"}}, {"-upper_bc_traction", "empty part"}},
    {"-upper_bc_traction_left", {{NULL}}, {"-upper_bc_traction_left", "missing", "-upper_bc_traction"}},
    {NULL, {{"-upper_bc_traction_left", "1,free"}}, {"-upper_bc_traction_left", "free"}},
    {NULL, {{"-upper_bc_displacement_top", "0,0,0"}}, {"-upper_bc_displacement_top", "2 wanted"}},
    {NULL, {{"-lower_bc_normal", NULL}}, {"-lower_bc_normal"}},
    /* pairs */
    {NULL, {{"-joint_nonmortar", "bottom"}}, {"-joint_nonmortar bottom", "body:side"}},
    {NULL, {{"-joint_nonmortar", "uper:bottom"}}, {"uper", "upper, lower", "did you mean upper"}},
    {NULL, {{"-joint_nonmortar", "upper:botom"}}, {"botom", "did you mean bottom"}},
    {NULL, {{"-joint_mortar", "upper:bottom"}}, {"upper:bottom", "itself"}},
    {NULL, {{"-joint_nonmortar", "lower:bottom"}}, {"-joint_nonmortar", "lower:bottom", "-lower_bc_displacement"}},
    {NULL, {{"-joint_nonmortar", "lower:left"}, {"-joint_mortar", "upper:right"}}, {"lower:left", "-lower_bc_normal"}},
    {"-joint_mortar", {{NULL}}, {"-joint_mortar", "missing", "-joint_obstacle"}},
    {"-joint_nonmortar", {{NULL}}, {"-joint_nonmortar", "missing", "-joint_sides"}},
    {NULL, {{"-joint_sides", "upper:bottom,lower:top"}}, {"-joint_nonmortar", "-joint_sides"}},
    {NULL, {{"-joint_type", "glued"}}, {"-joint_type glued", "contact, tied"}},
    {NULL, {{"-joint_type", "tied"}, {"-joint_gap", "1"}}, {"-joint_gap 1", "tied"}},
    {NULL, {{"-joint_reach", "-1"}}, {"-joint_reach -1", "above 0"}},
    {NULL, {{"-joint_gap", "1,2"}}, {"-joint_gap", "1 wanted"}},
    {NULL,
     {{"-pairs", "joint,again"}, {"-again_nonmortar", "lower:top"}, {"-again_mortar", "upper:bottom"}},
     {"joint", "again", "same two sides"}},
    /* obstacles */
    {NULL, {{"-joint_obstacle", "plane"}}, {"-joint_obstacle plane", "-joint_mortar lower:top"}},
    {"-joint_mortar", {{"-joint_obstacle", "plain"}}, {"-joint_obstacle plain", "did you mean plane"}},
    {"-joint_mortar", {{"-joint_obstacle", "cylinder"}}, {"cylinder", "circle"}},
    {"-joint_mortar", {{"-joint_obstacle", "plane"}}, {"-joint_obstacle_normal", "missing"}},
    {"-joint_mortar",
     {{"-joint_obstacle", "plane"}, {"-joint_obstacle_normal", "0,0"}},
     {"-joint_obstacle_normal 0,0", "zero"}},
    {"-joint_mortar",
     {{"-joint_obstacle", "ball"}, {"-joint_obstacle_radius", "0"}},
     {"-joint_obstacle_radius 0", "zero"}},
    {"-joint_mortar", {{"-joint_obstacle", "expression"}}, {"-joint_obstacle_gap", "missing"}},
    {"-joint_mortar",
     {{"-joint_obstacle", "plane"}, {"-joint_obstacle_normal", "0,0,1"}},
     {"-joint_obstacle_normal \"0,0,1\"", "2 wanted"}},
    {"-joint_mortar",
     {{"-joint_obstacle", "circle"}, {"-joint_obstacle_radius", "1"}, {"-joint_obstacle_axis", "0,1"}},
     {"-joint_obstacle_axis 0,1", "nothing in this scene"}},
    {"-joint_mortar",
     {{"-model", "axisymmetric"}, {"-joint_obstacle", "cylinder"}, {"-joint_obstacle_axis", "0,1"}},
     {"-joint_obstacle_axis 0,1", "axis of the scene"}},
    {"-joint_mortar",
     {{"-model", "axisymmetric"}, {"-joint_obstacle", "cylinder"}},
     {"-joint_obstacle_radius", "missing"}},
    {"-joint_mortar",
     {{"-joint_obstacle", "ball"}, {"-joint_obstacle_radius", "1"}, {"-joint_type", "tied"}},
     {"-joint_type tied", "-upper_bc_displacement"}},
    /* exact solutions */
    {NULL, {{"-upper_exact_displacement", "x"}}, {"-upper_exact_displacement", "2 wanted"}},
    {NULL, {{"-upper_exact_displacement", "x,free"}}, {"-upper_exact_displacement", "free"}},
    {NULL, {{"-joint_exact_pressure", "1,2"}}, {"-joint_exact_pressure", "1 wanted"}},
    {NULL, {{"-joint_exact_pressure", "1"}, {"-joint_type", "tied"}}, {"-joint_exact_pressure 1", "tied"}},
    {NULL, {{"-joint_multipliers", "edges"}}, {"-joint_multipliers edges", "nodes, vertices"}},
    /* studies */
    {NULL, {{"-study", NULL}}, {"-study", "no value"}},
    {NULL, {{"-study", "unifrom"}}, {"-study unifrom", "did you mean uniform"}},
    {NULL, {{"-study_levels", "3"}}, {"-study_levels 3", "nothing in this scene", "With -study"}},
    {NULL, {{"-study_orders", "1"}}, {"-study_orders 1", "nothing in this scene", "With -study"}},
    {NULL, {{"-study", "uniform"}, {"-study_levels", "0"}}, {"-study_levels 0", "smallest value is 1"}},
    {NULL,
     {{"-study", "uniform"}, {"-study_levels", sizeof(PetscInt) > 4 ? "31" : "17"}},
     {"-upper_dm_plex_box_faces", "-study_levels"}},
    {NULL, {{"-study", "uniform"}, {"-study_orders", "2,1"}}, {"-study_orders 2,1", "lower one first", "1,2"}},
    {NULL, {{"-study", "uniform"}, {"-study_orders", "1,1"}}, {"-study_orders 1,1", "once"}},
    {NULL, {{"-study", "uniform"}, {"-study_orders", "3"}}, {"-study_orders 3", "'3'", "1,2"}},
    {NULL, {{"-study", "uniform"}, {"-study_orders", "1,2,3"}}, {"-study_orders 1,2,3", "there are 2"}},
    {NULL,
     {{"-study", "uniform"}, {"-study_orders", "1,2"}, {"-upper_order", "2"}},
     {"-upper_order 2", "-study_orders", "one of the two"}},
    {NULL, {{"-study", "uniform"}, {"-study_memory", "much"}}, {"-study_memory much", "4G"}},
    {NULL, {{"-study", "uniform"}, {"-study_memory", "4GB"}}, {"-study_memory 4GB", "4G"}},
    {NULL, {{"-study", "uniform"}, {"-study_memory", "-1"}}, {"-study_memory -1", "above 0"}},
    /* probes, results, solver */
    {NULL, {{"-report", NULL}}, {"-report", "-output"}},
    {NULL, {{"-probes", "tip"}}, {"-probe_tip_at", "missing"}},
    {NULL, {{"-probes", "tip"}, {"-probe_tip_at", "0,0"}}, {"-probe_tip_body", "missing"}},
    {NULL,
     {{"-probes", "tip"}, {"-probe_tip_at", "0,0"}, {"-probe_tip_body", "uper"}},
     {"-probe_tip_body uper", "did you mean upper"}},
    {NULL, {{"-probes", "tip"}, {"-probe_tip_at", "0"}, {"-probe_tip_body", "upper"}}, {"-probe_tip_at", "2 wanted"}},
    {NULL, {{"-probe_tip_at", "0,0"}}, {"-probe_tip_at 0,0"}},
    {NULL, {{"-output", "out"}, {"-output_format", "xdmf,vtk"}}, {"'vtk'", "xdmf, vtu"}},
    {NULL, {{"-quiet", NULL}, {"-monitor", NULL}}, {"-monitor", "-quiet"}},
    {NULL, {{"-snes_type", "newtonls"}}, {"-snes_type newtonls", "vinewtonrsls", "bounds"}},
    {NULL, {{"-snes_pdas_strt", "full"}}, {"-snes_pdas_strt full", "-snes_pdas_start"}},
    {NULL, {{"-dm_refin", "3"}}, {"-dm_refin 3", "-dm_refine"}},
    {NULL, {{"-upper_dm_view", NULL}}, {"-upper_dm_view"}},
    {NULL, {{"-snes_type", "pdsa"}}, {"-snes_type pdsa", "did you mean pdas"}},
};

static PetscErrorCode ReadScene(const char *without, PetscInt num, const char *const change[][2], Scene *scene)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsClear(NULL));
  for (size_t i = 0; i < sizeof(base) / sizeof(base[0]); i++) {
    if (!without || strcmp(base[i][0], without)) PetscCall(PetscOptionsSetValue(NULL, base[i][0], base[i][1]));
  }
  for (PetscInt i = 0; i < num && change[i][0]; i++) PetscCall(PetscOptionsSetValue(NULL, change[i][0], change[i][1]));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, scene));
  PetscCall(SceneSetFromOptions(*scene));
  PetscCall(SceneCheckUnused(*scene, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TestMistake(const Mistake *mistake)
{
  Scene          scene = NULL;
  PetscErrorCode code  = ReadScene(mistake->without, 3, mistake->change, &scene);

  PetscFunctionBeginUser;
  if (code != MORTISE_ERR_USER) {
    fprintf(stderr, "no fault: without %s, with %s %s\n", mistake->without, mistake->change[0][0],
            mistake->change[0][1]);
  }
  CHECK(code == MORTISE_ERR_USER);
  for (PetscInt i = 0; i < 3 && mistake->words[i]; i++) {
    if (!strstr(UserErrorSentence(), mistake->words[i])) fprintf(stderr, "the sentence lacks: %s\n", mistake->words[i]);
    CHECK(strstr(UserErrorSentence(), mistake->words[i]));
  }
  CHECK(!strchr(UserErrorSentence(), '\n'));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the base scene says arrives; what it does not say has its default. */
static PetscErrorCode TestBase(void)
{
  Scene     scene;
  PetscReal x[3] = {0, 0.5, 0}, value[3];

  PetscFunctionBeginUser;
  PetscCall(ReadScene(NULL, 0, NULL, &scene));
  CHECK(scene->dim == 2 && scene->model == MODEL_PLANE_STRAIN && scene->thickness == 1 && scene->refine == 0);
  CHECK(scene->num_bodies == 2 && scene->num_pairs == 1 && scene->num_probes == 0);
  CHECK(!scene->output && !scene->summary && !scene->quiet && !scene->title[0]);

  const SceneBody *upper = &scene->bodies[0], *lower = &scene->bodies[1];

  CHECK(!strcmp(upper->name, "upper") && !upper->mesh_file && !upper->region && !upper->simplex && upper->order == 1);
  CHECK(upper->faces[0] == 4 && upper->faces[1] == 3 && upper->lower[0] == 0 && upper->upper[1] == 1);
  CHECK(lower->simplex && lower->lower[1] == -1 && lower->upper[1] == 0);
  CHECK(upper->material.young && upper->material.poisson && !upper->material.stiffness && !upper->map &&
        !upper->material.body_force);
  CHECK(upper->num_boundaries == 3 && lower->num_boundaries == 2);
  CHECK(upper->boundaries[0].kind == BOUNDARY_DISPLACEMENT && ExpressionIsFree(upper->boundaries[0].value, 0));
  CHECK(upper->boundaries[1].kind == BOUNDARY_TRACTION && !strcmp(upper->boundaries[2].side, "right"));
  PetscCall(ExpressionEvaluate(upper->boundaries[1].value, 2, x, value));
  CHECK_NEAR(value[0], 3e6 * 0.75, 1e-9);
  CHECK(lower->boundaries[1].kind == BOUNDARY_NORMAL && !lower->boundaries[1].value);
  CHECK(!strcmp(lower->boundaries[1].side, "left+right"));

  const ScenePair *joint = &scene->pairs[0];

  CHECK(joint->type == PAIR_CONTACT && !joint->roles_open && joint->nonmortar.body == 0 && joint->mortar.body == 1);
  CHECK(!strcmp(joint->nonmortar.side, "bottom") && !strcmp(joint->mortar.side, "top"));
  CHECK(joint->obstacle.kind == OBSTACLE_NONE && !joint->gap && !joint->gap_offset && joint->reach < 0);
  PetscCall(SceneView(scene));
  PetscCall(SceneCheckUnused(scene, PETSC_FALSE));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Everything that the base scene leaves out. */
static PetscErrorCode TestRest(void)
{
  static const char *const change[][2] = {{"-model", "plane_stress"},
                                          {"-thickness", "0.1"},
                                          {"-upper_dm_plex_box_upper", "2,pi/2"},
                                          {"-upper_map", "x*cos(y),x*sin(y)"},
                                          {"-upper_bc_traction_right", "1e-3*x,atan2(y,x)"},
                                          {"-joint_obstacle", "parabola"},
                                          {"-joint_obstacle_normal", "3e-200,4e-200"},
                                          {"-joint_obstacle_radius", "-2"},
                                          {"-joint_gap_offset", "-1e-5"},
                                          {"-probes", "tip,core"},
                                          {"-probe_tip_at", "0.5,0.5"},
                                          {"-probe_tip_body", "lower"},
                                          {"-probe_core_at", "0.5,0.25"},
                                          {"-probe_core_body", "upper"},
                                          {"-output", "results/two"},
                                          {"-output_format", "vtu,xdmf"},
                                          {"-summary", "-"},
                                          {"-quiet", NULL},
                                          {"-cross_check", "yes"},
                                          {"-measure_linear", "1"},
                                          {"-snes_type", "vinewtonrsls"},
                                          {"-title", "Two plates"}};
  Scene                    scene;

  PetscFunctionBeginUser;
  PetscCall(ReadScene("-joint_mortar", (PetscInt)(sizeof(change) / sizeof(change[0])), change, &scene));
  CHECK(scene->model == MODEL_PLANE_STRESS && scene->thickness == 0.1 && !strcmp(scene->title, "Two plates"));
  CHECK_NEAR(scene->bodies[0].upper[1], PETSC_PI / 2, 1e-15);
  CHECK(ExpressionSize(scene->bodies[0].map) == 2 && ExpressionSize(scene->bodies[0].boundaries[2].value) == 2);
  CHECK(scene->pairs[0].obstacle.kind == OBSTACLE_PARABOLA && scene->pairs[0].mortar.body == -1);
  CHECK_NEAR(scene->pairs[0].obstacle.normal[0], 0.6, 1e-15);
  CHECK_NEAR(scene->pairs[0].obstacle.normal[1], 0.8, 1e-15);
  CHECK(scene->pairs[0].obstacle.radius == -2 && scene->pairs[0].gap_offset);
  CHECK(scene->num_probes == 2 && scene->probes[0].body == 1 && scene->probes[1].body == 0 &&
        scene->probes[1].at[1] == 0.25);
  CHECK(!strcmp(scene->output, "results/two") && scene->formats == (OUTPUT_XDMF | OUTPUT_VTU));
  CHECK(!strcmp(scene->summary, "-") && scene->quiet && scene->cross_check && scene->measure_linear && !scene->monitor);
  PetscCall(SceneView(scene));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Orders, exact solutions and studies. */
static PetscErrorCode TestStudy(void)
{
  static const char *const exact[][2] = {{"-order", "2"},
                                         {"-lower_order", "1"},
                                         {"-upper_exact_displacement", "x*(1-y),sin(x)"},
                                         {"-joint_exact_pressure", "1-x^2"},
                                         {"-joint_multipliers", "vertices"},
                                         {"-output", "results/two"},
                                         {"-report", NULL},
                                         {"-study", "uniform"}};
  static const char *const both[][2]  = {{"-order", "2"},
                                         {"-study", "uniform"},
                                         {"-study_levels", "5"},
                                         {"-study_orders", "1, 2"},
                                         {"-study_memory", "1.5g"}};
  static const char *const same[][2]  = {{"-order", "2"}, {"-study", "uniform"}, {"-study_memory", "4096"}};
  Scene                    scene;

  PetscFunctionBeginUser;
  PetscCall(ReadScene(NULL, 0, NULL, &scene));
  CHECK(scene->study.kind == STUDY_NONE && !scene->report && !scene->bodies[0].exact && !scene->pairs[0].exact);
  CHECK(scene->pairs[0].multipliers == MULTIPLIERS_NODES);
  PetscCall(SceneDestroy(&scene));
  PetscCall(ReadScene(NULL, PETSC_STATIC_ARRAY_LENGTH(exact), exact, &scene));
  CHECK(scene->bodies[0].order == 2 && scene->bodies[1].order == 1 && scene->report);
  CHECK(ExpressionSize(scene->bodies[0].exact) == 2 && !scene->bodies[1].exact && scene->pairs[0].exact);
  CHECK(scene->pairs[0].multipliers == MULTIPLIERS_VERTICES);
  CHECK(scene->study.kind == STUDY_UNIFORM && scene->study.levels == 4 && scene->study.memory > PETSC_MAX_REAL);
  CHECK(scene->study.num_orders == 1 && scene->study.orders[0] == STUDY_OWN_ORDERS);
  PetscCall(SceneView(scene));
  PetscCall(SceneDestroy(&scene));
  PetscCall(ReadScene(NULL, PETSC_STATIC_ARRAY_LENGTH(both), both, &scene));
  CHECK(scene->study.levels == 5 && scene->study.num_orders == 2);
  CHECK(scene->study.orders[0] == 1 && scene->study.orders[1] == 2);
  CHECK(scene->study.memory == 1.5 * 1024 * 1024 * 1024);
  PetscCall(SceneView(scene));
  PetscCall(SceneDestroy(&scene));
  PetscCall(ReadScene(NULL, PETSC_STATIC_ARRAY_LENGTH(same), same, &scene));
  CHECK(scene->study.num_orders == 1 && scene->study.orders[0] == 2 && scene->study.memory == 4096);
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Roles of a pair stay open, unless only one of the sides can carry the multiplier. */
static PetscErrorCode TestRoles(void)
{
  static const char *const open[][2]   = {{"-joint_sides", "upper:bottom,lower:top"}};
  static const char *const closed[][2] = {
      {"-pairs", "held"}, {"-held_sides", "lower:bottom,upper:bottom"}, {"-options_allow_unused", NULL}};
  Scene scene;

  PetscFunctionBeginUser;
  CHECK(ReadScene("-joint_mortar", 1, open, &scene) == MORTISE_ERR_USER); /* it has its nonmortar side */
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscOptionsClear(NULL));
  PetscCall(ReadScene("-joint_mortar", 3, closed, &scene));
  CHECK(!scene->pairs[0].roles_open && scene->pairs[0].nonmortar.body == 0 && scene->pairs[0].mortar.body == 1);
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscOptionsClear(NULL));
  PetscCall(PetscOptionsInsertString(
      NULL, "-bodies a,b -a_dm_plex_box_faces 1,1 -b_dm_plex_box_faces 1,1 -a_young 1 -b_young 1 "
            "-a_poisson 0 -b_poisson 0 -pairs p -p_sides a:top,b:bottom"));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  CHECK(scene->pairs[0].roles_open && scene->pairs[0].nonmortar.body == 0 &&
        !strcmp(scene->pairs[0].mortar.side, "bottom"));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What PETSc may read late waits for the end of the solve; what belongs to its own beginning and end is never told. */
static PetscErrorCode TestLate(void)
{
  static const char *const change[][2] = {{"-sub_pc_type", "ilu"}, {"-log_view", NULL}, {"-malloc_dump", NULL}};
  Scene                    scene;

  PetscFunctionBeginUser;
  PetscCall(ReadScene(NULL, 3, change, &scene));
  CHECK(SceneCheckUnused(scene, PETSC_FALSE) == MORTISE_ERR_USER);
  CHECK(strstr(UserErrorSentence(), "-sub_pc_type ilu"));
  PetscCall(PetscOptionsClearValue(NULL, "-sub_pc_type"));
  PetscCall(SceneCheckUnused(scene, PETSC_FALSE));
  PetscCall(PetscOptionsClearValue(NULL, "-log_view"));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A Hooke matrix that is positive definite is taken, turned or not; one that is not, is not. */
static PetscErrorCode TestStiffness(void)
{
  static const char *const values[] = {"4,1,0,3,0,1", "1,2,0,1,0,1", "1,1,0,1,0,1"};
  Scene                    scene;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; i++) {
    PetscCall(PetscOptionsClear(NULL));
    PetscCall(PetscOptionsInsertString(NULL, "-bodies wood -wood_dm_plex_box_faces 2,2 -wood_material_angle 30"));
    PetscCall(PetscOptionsSetValue(NULL, "-wood_stiffness", values[i]));
    PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
    CHECK(SceneSetFromOptions(scene) == (i == 0 ? PETSC_SUCCESS : MORTISE_ERR_USER));
    if (i == 0)
      CHECK(scene->bodies[0].material.angle[0] == 30 && !scene->bodies[0].material.young &&
            ExpressionSize(scene->bodies[0].material.stiffness) == 6);
    else
      CHECK(strstr(UserErrorSentence(), "-wood_stiffness") && strstr(UserErrorSentence(), "positive definite"));
    PetscCall(SceneDestroy(&scene));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(TestBase());
  PetscCall(TestRest());
  PetscCall(TestStudy());
  for (size_t i = 0; i < sizeof(mistakes) / sizeof(mistakes[0]); i++) PetscCall(TestMistake(&mistakes[i]));
  PetscCall(TestLate());
  PetscCall(TestRoles());
  PetscCall(TestStiffness());
  SceneHelp(stdout);
  PetscCall(PetscFinalize());
  return 0;
}
