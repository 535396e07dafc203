/* sceneparts.h -- the parts of SceneSetFromOptions(), one file each, in the order they run. */
#ifndef SCENE_PARTS_H
#define SCENE_PARTS_H

#include "scene/sceneoption.h"

/* scenenames.c: bodies, pairs and probes by name, before their options are read. User errors: names that are
   not legal, are given twice, or give one option two meanings. Collective. */
PetscErrorCode SceneNamesRead(Scene scene);
/* The i-th of all names and what it names; NULL behind the last one. Not collective. */
const char *SceneNamesGet(Scene scene, PetscInt i, OptionScope *scope);
/* Index of the body of that name; a user error that lists the bodies if there is none. Collective. */
PetscErrorCode SceneNamesFindBody(Scene scene, const Option *option, const char name[], PetscInt *body);

/* unusedoptions.c: raises a user error on an option that no row of the table documents; with only_near, only
   if one is near. Collective. */
PetscErrorCode UnusedOptionsCheckUnknown(Scene scene, PetscBool only_near);
/* Whether an option (with its dash) begins as PETSc's own options do, so that no body or pair may.
   Not collective. */
PetscBool UnusedOptionsBeginsLikePETSc(const char option[]);
/* The unused option in the database that looks like a misspelling of this one, "" if there is none. It may
   also look like its datum for a side that is not listed. Not collective. */
PetscErrorCode UnusedOptionsNearest(const Option *option, char near[OPTION_MAX]);

/* optionsuggestion.c: the documented option nearest to a misspelt one, "" if none is near. Not collective. */
PetscErrorCode OptionSuggestionFind(Scene scene, const char misspelt[], char near[OPTION_MAX]);

/* sceneunits.c: names of units. Collective. */
PetscErrorCode SceneUnitsRead(Scene scene);

/* unmodelled.c: for an option that other programs have, what is not modelled and what to give instead; else
   NULL. Not collective.
   [in] name - of the option, without its dash and the name of its body or pair */
const char *UnmodelledFind(const char name[]);

/* sceneadapt.c: before the bodies, whose order it changes. Collective. */
PetscErrorCode SceneAdaptRead(Scene scene);
/* Raises a user error for a goal that has no number; call when bodies and probes are read. Collective. */
PetscErrorCode SceneAdaptCheck(Scene scene);
PetscErrorCode SceneAdaptDestroy(SceneAdapt *adapt);
/* scenestudy.c: before the bodies, whose meshes a study refines. Collective. */
PetscErrorCode SceneStudyRead(Scene scene);
/* The orders of a study that names none are those of the bodies; call when they are read. Not collective. */
PetscErrorCode SceneStudySetOrders(Scene scene);

/* scenesteps.c: -load_steps and -load_steps_scale. Collective. */
PetscErrorCode SceneStepsRead(Scene scene);
/* The same file: -restart and -load_steps_halved, when all else is read. Collective. */
PetscErrorCode SceneRestartRead(Scene scene);
PetscErrorCode SceneHalvedRead(Scene scene);

/* scenebodies.c: one body. scenematerials.c: its materials. sceneboundaries.c: its supports and loads.
   Collective. */
PetscErrorCode SceneBodyRead(Scene scene, SceneBody *body);
PetscErrorCode SceneBodyDestroy(SceneBody *body);
PetscErrorCode SceneMaterialsRead(Scene scene, SceneBody *body);
PetscErrorCode SceneMaterialDestroy(SceneMaterial *material);
PetscErrorCode SceneBoundariesRead(Scene scene, SceneBody *body);
/* Whether a side's displacement is given in all components. Not collective. */
PetscBool SceneBoundaryFixesAll(Scene scene, const SceneBoundary *boundary);

/* scenesides.c: raises a user error on a side that cannot be: empty parts of a '+' list, or a name that a box
   does not have. Collective. */
PetscErrorCode SceneSideCheck(const Option *option, const SceneBody *body, const char side[]);
/* Whether two sides, each joined with '+' of one or more, have one in common. Not collective.
   [out] common - the first one, array of shape [OPTION_MAX]; may be NULL */
PetscBool SceneSideOverlaps(const char a[], const char b[], char common[]);

/* scenepairs.c, sceneobstacle.c, sceneresults.c. Collective. */
PetscErrorCode ScenePairRead(Scene scene, ScenePair *pair);
PetscErrorCode ScenePairDestroy(ScenePair *pair);
PetscErrorCode SceneObstacleRead(Scene scene, ScenePair *pair, const Option *shape);
PetscErrorCode SceneProbeRead(Scene scene, SceneProbe *probe);
PetscErrorCode ScenePathRead(Scene scene, ScenePath *path);
/* sceneresults.c: before all that may warn. Collective. */
PetscErrorCode SceneWarningsRead(Scene scene);
PetscErrorCode SceneResultsRead(Scene scene);

#endif
