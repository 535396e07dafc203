/* meshhistory.c -- rows of the summary, and estimates, mesh after mesh. */
#include "study/meshhistory.h"
#include "base/compat.h"
#include "base/json.h"
#include "base/log.h"
#include "result/calibration.h"
#include "study/bars.h"

enum { FIRST_ROOM = 8 };

/* Part of L from changes of volume that may be wrong: recovered pressures stand for the exact ones. Measured
   on triangles at nu = .4999, where it is twice |e|^2: 1 to 10 % from 1000 unknowns on. */
static const PetscReal LOST_SHARE = 0.1;
static const PetscReal EXACT      = 1e-9; /* largest relative error that is rounding */
/* The deformation of a rigid motion is rounding: it is below this part of the displacements. */
static const PetscReal RIGID = 1e-12;

PetscReal SolvedMeshGetError(const SolvedMesh *mesh)
{
  if (mesh->norm > 0) return mesh->error / PetscSqrtReal(mesh->norm);
  return mesh->missed ? 1 : 0;
}

PetscReal SolvedMeshGetEnergy(const SolvedMesh *mesh)
{
  return 2 * mesh->potential - mesh->signs;
}

/* The error of the limit of the potential. */
static PetscReal SolvedMeshGetLimitBar_Private(const SolvedMesh *mesh)
{
  return PetscSqr(mesh->error) / 3 + LOST_SHARE * PetscAbsReal(mesh->lost);
}

/* 2 (J_h - J), estimated. Curves change the potential by a part of L, not of |e|^2. */
static PetscReal SolvedMeshGetExcess_Private(const SolvedMesh *mesh)
{
  return PetscSqr(mesh->error) - mesh->geometry + mesh->signs;
}

/* Sets theta of the latest mesh. With friction it is the standard value: the potential is not an energy that
   refinement lowers. Collective. */
static PetscErrorCode MeshHistoryCalibrate_Private(MeshHistory *history, const Level *level, const Estimate estimate)
{
  CalibrationMesh *meshes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(history->num, &meshes));
  for (PetscInt k = 0; k < history->num; k++) {
    const SolvedMesh *mesh = &history->mesh[k];

    meshes[k] = (CalibrationMesh){.squared  = PetscSqr(mesh->eta) - mesh->geometry,
                                  .energy   = SolvedMeshGetEnergy(mesh),
                                  .signs    = mesh->signs,
                                  .lost     = mesh->lost,
                                  .supports = mesh->supports};
  }
  history->mesh[history->num - 1].theta =
      SceneHasFriction(level->scene) ? estimate->standard : CalibrationFind(history->num, meshes, estimate);
  PetscCall(PetscFree(meshes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshHistoryAdd(MeshHistory *history, Run run, PetscReal seconds)
{
  const PetscReal begin = LogWallClock();
  const Level    *level = run->vi->level;
  SummaryInput    input = RunSummary(run);
  PetscInt        cells = level->num_cells;
  PetscReal       size;
  SolvedMesh     *mesh;
  Estimate        estimate;

  PetscFunctionBeginUser;
  if (history->num == history->max) {
    history->max = PetscMax(FIRST_ROOM, 2 * history->max);
    PetscCall(PetscRealloc(sizeof(SolvedMesh) * (size_t)history->max, &history->mesh));
  }
  mesh = &history->mesh[history->num++];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &cells, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCall(EstimateGet(run->fields, &estimate));
  *mesh = (SolvedMesh){.cells      = cells,
                       .unknowns   = level->num_global * level->dim,
                       .iterations = run->report.iterations,
                       .active     = run->report.active,
                       .eta        = PetscSqrtReal(estimate->squared),
                       .geometry   = estimate->geometry,
                       .norm       = estimate->norm,
                       .missed     = estimate->missed,
                       .potential  = estimate->potential,
                       .signs      = estimate->signs,
                       .lost       = estimate->lost,
                       .supports   = estimate->supports};
  PetscCall(VecNorm(run->fields->u, NORM_INFINITY, &size));
  if (mesh->norm <= PetscSqr(RIGID * size) * run->vi->stiffness) mesh->norm = 0;
  PetscCall(MeshHistoryCalibrate_Private(history, level, estimate));
  mesh->error = EstimateGetError(estimate, mesh->theta);
  PetscCall(SummaryCreateStep(&input, &mesh->row));
  PetscCall(PetscMalloc1(run->scene->num_pairs, &mesh->peak));
  for (PetscInt p = 0; p < run->scene->num_pairs; p++) PetscCall(PeakGet(run->fields, p, &mesh->peak[p]));
  mesh->seconds = seconds + LogWallClock() - begin;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshHistoryTruncate(MeshHistory *history, PetscInt num)
{
  PetscFunctionBeginUser;
  for (PetscInt k = num; k < history->num; k++) {
    cJSON_Delete(history->mesh[k].row);
    PetscCall(PetscFree(history->mesh[k].peak));
    PetscCall(PetscFree(history->mesh[k].goals));
  }
  history->num = num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshHistoryDestroy(MeshHistory *history)
{
  PetscFunctionBeginUser;
  PetscCall(MeshHistoryTruncate(history, 0));
  PetscCall(PetscFree(history->mesh));
  history->max = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool SolvedMeshIsExact(const SolvedMesh *mesh)
{
  return (PetscBool) !(SolvedMeshGetError(mesh) > EXACT);
}

/* Adds "goals", with their numbers on a mesh.
   [in] named - whether with the text of the option, and whether they are met */
static void MeshHistoryAddGoals_Private(const Scene scene, const SolvedMesh *mesh, PetscBool named, cJSON *to)
{
  cJSON *goals;

  if (!mesh->goals) return;
  goals = cJSON_AddArrayToObject(to, "goals");
  for (PetscInt g = 0; g < scene->adapt.num_goals; g++) {
    cJSON *item = cJSON_CreateObject();

    if (named) cJSON_AddStringToObject(item, "goal", scene->adapt.goals[g].text);
    JSONAddReal(item, "value", mesh->goals[g].value);
    JSONAddReal(item, "bar", mesh->goals[g].bar);
    JSONAddReal(item, "dual_estimate", mesh->goals[g].product);
    if (named) cJSON_AddBoolToObject(item, "met", SolvedMeshIsExact(mesh) || GoalIsMet(scene, &mesh->goals[g]));
    cJSON_AddItemToArray(goals, item);
  }
}

/* The summary's block "estimate". [in] sides - what sides of files do to the potential */
static cJSON *MeshHistoryCreateEstimate_Private(const MeshHistory *history, const Scene scene, PetscReal sides)
{
  const SolvedMesh *last     = &history->mesh[history->num - 1];
  const PetscReal   error    = last->error;
  const PetscBool   friction = SceneHasFriction(scene);
  cJSON            *root     = cJSON_CreateObject(), *potential, *meshes;

  JSONAddReal(root, "energy_norm", error);
  JSONAddReal(root, "energy_norm_relative", SolvedMeshGetError(last));
  JSONAddReal(root, "calibration", last->theta);
  potential = cJSON_AddObjectToObject(root, "potential");
  JSONAddReal(potential, "value", friction ? (PetscReal)NAN : last->potential - SolvedMeshGetExcess_Private(last) / 2);
  JSONAddReal(potential, "bar", friction ? (PetscReal)NAN : SolvedMeshGetLimitBar_Private(last) + sides);
  MeshHistoryAddGoals_Private(scene, last, PETSC_TRUE, root);
  meshes = cJSON_AddArrayToObject(root, "meshes");
  for (PetscInt k = 0; k < history->num; k++) {
    const SolvedMesh *mesh = &history->mesh[k];
    cJSON            *item = cJSON_CreateObject();

    JSONAddInt(item, "cells", mesh->cells);
    JSONAddInt(item, "unknowns", mesh->unknowns);
    JSONAddReal(item, "estimate", mesh->error);
    JSONAddReal(item, "energy_norm_relative", SolvedMeshGetError(mesh));
    JSONAddReal(item, "potential", mesh->potential);
    JSONAddInt(item, "iterations", mesh->iterations);
    JSONAddInt(item, "active", mesh->active);
    JSONAddReal(item, "seconds", mesh->seconds);
    MeshHistoryAddGoals_Private(scene, mesh, PETSC_FALSE, item);
    cJSON_AddItemToArray(meshes, item);
  }
  return root;
}

PetscErrorCode MeshHistoryDescribe(const MeshHistory *history, Run run)
{
  const SolvedMesh *last = &history->mesh[history->num - 1];
  BarMesh          *meshes;
  BarFloors         floors;
  BarHistory        sequence = {.num    = history->num,
                                .floors = &floors,
                                .scene  = run->scene,
                                .limit  = SolvedMeshGetLimitBar_Private(last),
                                .excess = SolvedMeshGetExcess_Private(last)};

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(history->num, &meshes));
  for (PetscInt k = 0; k < history->num; k++)
    meshes[k] = (BarMesh){.row  = history->mesh[k].row,
                          .eta  = history->mesh[k].eta,
                          .lost = (PetscBool)(SolvedMeshGetError(&history->mesh[k]) >= 1),
                          .peak = history->mesh[k].peak};
  sequence.mesh = meshes;
  PetscCall(BarFloorsCreate(run->fields, run->reactions, &floors));
  RunForgetBlocks(run);
  PetscCall(BarsCreate(&sequence, &run->bars));
  if (last->goals) PetscCall(GoalsRaiseBars(run->scene, last->row, run->bars, last->goals));
  PetscCall(BarFloorsDestroy(&floors));
  PetscCall(PetscFree(meshes));
  run->estimate = MeshHistoryCreateEstimate_Private(history, run->scene, floors.potential);
  PetscFunctionReturn(PETSC_SUCCESS);
}
