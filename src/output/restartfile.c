/* restartfile.c -- what a new run takes from the file of an older one: displacement and time of the last solved step.

   Where regions meet, a node is several points with one displacement. */
#include <hdf5.h>
#include <string.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "kernel/boxtree.h"
#include "output/restartfile.h"
#include "output/xdmf.h"

/* Places nearer than this part of the extent of all bodies are the same: maps and refinements leave roundoff. */
static const PetscReal SAME_POINT = 1e-10;

enum { GROUP_NAME = 64, WHY_LENGTH = PETSC_MAX_PATH_LEN + 512 };

/* What the file holds; the same on all ranks. */
typedef struct {
  PetscInt   num;
  PetscReal *points, *moved; /* [num][3] */
  int       *body;           /* [num] */
  PetscReal  t;
} Past;

/* An array of a file. [out] rows, columns - its shape; [out] values - of size bytes each, owned by the caller; NULL where there is no such array */
static PetscErrorCode PastReadArray_Private(hid_t file, const char name[], hid_t type, size_t size, PetscInt *rows,
                                            PetscInt *columns, void **values)
{
  const hid_t set      = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space    = set < 0 ? -1 : H5Dget_space(set);
  hsize_t     shape[2] = {0, 1};

  PetscFunctionBeginUser;
  *values = NULL;
  if (space >= 0 && H5Sget_simple_extent_ndims(space) <= 2 && H5Sget_simple_extent_dims(space, shape, NULL) > 0) {
    PetscCall(PetscMalloc((size_t)(shape[0] * shape[1]) * size, values));
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *values) < 0) PetscCall(PetscFree(*values));
  }
  if (space >= 0) H5Sclose(space);
  if (set >= 0) H5Dclose(set);
  *rows    = (PetscInt)shape[0];
  *columns = (PetscInt)shape[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An attribute of one number; whether there is one. */
static PetscBool PastReadNumber_Private(hid_t group, const char name[], double *value)
{
  const hid_t attribute = H5Aexists(group, name) > 0 ? H5Aopen(group, name, H5P_DEFAULT) : -1;
  herr_t      bad       = -1;

  if (attribute >= 0) {
    bad = H5Aread(attribute, H5T_NATIVE_DOUBLE, value);
    H5Aclose(attribute);
  }
  return (PetscBool)(bad >= 0);
}

/* The group of the last solved step, "" for none. */
static void PastFindStep_Private(hid_t file, char name[GROUP_NAME], PetscReal *t)
{
  const FieldSeries series = {0};

  name[0] = '\0';
  if (H5Lexists(file, "steps", H5P_DEFAULT) <= 0) return;
  for (PetscInt i = 0;; i++) {
    char   step[XDMF_STEP_NAME];
    double solved = 0, time = 0;
    hid_t  group;

    XDMFStepName(&series, i, step);
    if (H5Lexists(file, step, H5P_DEFAULT) <= 0) return;
    group = H5Gopen2(file, step, H5P_DEFAULT);
    if (group < 0) return;
    if (PastReadNumber_Private(group, "solved", &solved) && solved > 0 && PastReadNumber_Private(group, "t", &time)) {
      snprintf(name, GROUP_NAME, "%s", step);
      *t = time;
    }
    H5Gclose(group);
  }
}

/* The body of each point, from those of the cells. [out] whether the file has all that */
static PetscErrorCode PastSetBodies_Private(hid_t file, Past *past, PetscBool *good)
{
  int     *cells, *bodies;
  PetscInt rows, columns, num, one, at = 0;

  PetscFunctionBeginUser;
  PetscCall(PastReadArray_Private(file, "cells", H5T_NATIVE_INT, sizeof(int), &rows, &columns, (void **)&cells));
  PetscCall(PastReadArray_Private(file, "body", H5T_NATIVE_INT, sizeof(int), &num, &one, (void **)&bodies));
  PetscCall(PetscMalloc1(past->num, &past->body));
  for (PetscInt i = 0; i < past->num; i++) past->body[i] = -1;
  *good = (PetscBool)(cells && bodies && one == 1);
  for (PetscInt c = 0; *good && c < num; c++) {
    const PetscInt nodes = columns > 1 ? columns
                           : at < rows ? XDMFTopologyGetNumNodes(cells[at++])
                                       : 0; // several types: a list

    if (!nodes || at + nodes > rows * columns) *good = PETSC_FALSE;
    for (PetscInt i = 0; *good && i < nodes; i++, at++) {
      if (cells[at] < 0 || cells[at] >= past->num)
        *good = PETSC_FALSE;
      else
        past->body[cells[at]] = bodies[c];
    }
  }
  PetscCall(PetscFree(cells));
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The arrays of an open file. [out] why - what is wrong with it, or "" */
static PetscErrorCode PastReadFile_Private(hid_t file, Past *past, char why[])
{
  char      group[GROUP_NAME], name[2 * GROUP_NAME];
  PetscInt  rows, columns, num;
  PetscBool good;

  PetscFunctionBeginUser;
  PastFindStep_Private(file, group, &past->t);
  if (!group[0]) {
    PetscCall(PetscStrncpy(why, "has no solved load step; give the .h5 file of a run with -load_steps", WHY_LENGTH));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  snprintf(name, sizeof(name), "%sdisplacement", group);
  PetscCall(
      PastReadArray_Private(file, name, H5T_NATIVE_DOUBLE, sizeof(PetscReal), &rows, &columns, (void **)&past->moved));
  PetscCall(PastReadArray_Private(file, "points", H5T_NATIVE_DOUBLE, sizeof(PetscReal), &past->num, &num,
                                  (void **)&past->points));
  good = (PetscBool)(past->moved && past->points && rows == past->num && columns == 3 && num == 3);
  if (good) PetscCall(PastSetBodies_Private(file, past, &good));
  if (!good)
    PetscCall(PetscStrncpy(why,
                           "does not have points, cells and displacements of one mesh; runs with -adapt have "
                           "several, and cannot be gone on with",
                           WHY_LENGTH));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads on the first rank and tells all. Raises user errors. */
static PetscErrorCode PastCreate_Private(MPI_Comm comm, const char path[], Past *past)
{
  PetscMPIInt rank;
  char        why[WHY_LENGTH] = "", sentence[2 * WHY_LENGTH] = "";

  PetscFunctionBeginUser;
  *past = (Past){.num = 0};
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    hid_t file;

    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // its lists of functions; what can fail here is told by us
    file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
      PetscCall(PetscStrncpy(why, "cannot be read as an HDF5 file", sizeof(why)));
    else
      PetscCall(PastReadFile_Private(file, past, why));
    if (file >= 0) H5Fclose(file);
    if (why[0]) snprintf(sentence, sizeof(sentence), "-restart %s: the file %s", path, why);
  }
  PetscCall(UserErrorCheck(comm, sentence));
  PetscCallMPI(MPI_Bcast(&past->num, 1, MPIU_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(&past->t, 1, MPIU_REAL, 0, comm));
  if (rank) {
    PetscCall(PetscMalloc1(3 * past->num, &past->points));
    PetscCall(PetscMalloc1(3 * past->num, &past->moved));
    PetscCall(PetscMalloc1(past->num, &past->body));
  }
  PetscCallMPI(MPI_Bcast(past->points, (PetscMPIInt)(3 * past->num), MPIU_REAL, 0, comm));
  PetscCallMPI(MPI_Bcast(past->moved, (PetscMPIInt)(3 * past->num), MPIU_REAL, 0, comm));
  PetscCallMPI(MPI_Bcast(past->body, (PetscMPIInt)past->num, MPI_INT, 0, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PastDestroy_Private(Past *past)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(past->points));
  PetscCall(PetscFree(past->moved));
  PetscCall(PetscFree(past->body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A tree of the places of all points. [out] width - within which places are the same */
static PetscErrorCode PastCreateTree_Private(const Past *past, BoxTree *tree, PetscReal *width)
{
  PetscReal *boxes, lower[3], upper[3];

  PetscFunctionBeginUser;
  *width = 0;
  for (PetscInt k = 0; k < 3; k++) {
    lower[k] = PETSC_MAX_REAL;
    upper[k] = PETSC_MIN_REAL;
  }
  PetscCall(PetscMalloc1(6 * past->num, &boxes));
  for (PetscInt i = 0; i < past->num; i++) {
    for (PetscInt k = 0; k < 3; k++) {
      boxes[6 * i + k] = boxes[6 * i + 3 + k] = past->points[3 * i + k];
      lower[k]                                = PetscMin(lower[k], past->points[3 * i + k]);
      upper[k]                                = PetscMax(upper[k], past->points[3 * i + k]);
    }
  }
  for (PetscInt k = 0; k < 3; k++) *width = PetscMax(*width, SAME_POINT * (upper[k] - lower[k]));
  PetscCall(BoxTreeCreate(3, past->num, boxes, tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The point of a node, -1 for none, -2 for several with different displacements. */
static PetscErrorCode PastFindPoint_Private(const Past *past, BoxTree tree, PetscReal width, const Level *level,
                                            PetscInt node, PetscInt *found)
{
  PetscReal       box[6] = {0};
  PetscInt        num;
  const PetscInt *hits;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal x = k < level->dim ? level->coords[node * level->dim + k] : 0;

    box[k]     = x - width;
    box[3 + k] = x + width;
  }
  PetscCall(BoxTreeQuery(tree, box, &num, &hits));
  *found = -1;
  for (PetscInt h = 0; h<num && * found> - 2; h++) {
    PetscBool same = PETSC_TRUE;

    if (past->body[hits[h]] != level->node_body[node]) continue;
    for (PetscInt k = 0; *found >= 0 && k < 3; k++)
      if (past->moved[3 * hits[h] + k] != past->moved[3 * *found + k]) same = PETSC_FALSE;
    *found = same ? hits[h] : -2;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error of the first owned node without a point. [in] node - -1 for none; several - whether it has too many */
static PetscErrorCode PastCheckNode_Private(const Level *level, const char path[], PetscInt node, PetscBool several)
{
  char sentence[2 * WHY_LENGTH] = "", place[WHY_LENGTH] = "";

  PetscFunctionBeginUser;
  if (node >= 0) {
    const PetscReal *x = &level->coords[node * level->dim];

    for (PetscInt k = 0, at = 0; k < level->dim; k++)
      at += (PetscInt)snprintf(place + at, sizeof(place) - (size_t)at, "%s%.6g", k ? ", " : "", (double)x[k]);
    snprintf(sentence, sizeof(sentence), "-restart %s: the body %s has %s at (%s)%s", path,
             level->scene->bodies[level->node_body[node]].name,
             several ? "several nodes" : "a node that the file does not have", place,
             several ? ", which the file cannot tell apart" : "; give the scene, with its mesh, that made the file");
  }
  PetscCall(UserErrorCheck(level->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RestartFileRead(Level *level, const char path[], Vec *u, PetscReal *t)
{
  Past         past;
  BoxTree      tree;
  PetscReal    width;
  PetscScalar *value;
  PetscInt     wrong = -1, point = 0;

  PetscFunctionBeginUser;
  PetscCall(PastCreate_Private(level->comm, path, &past));
  PetscCall(PastCreateTree_Private(&past, &tree, &width));
  PetscCall(LevelCreateVec(level, level->dim, u));
  PetscCall(VecGetArray(*u, &value));
  for (PetscInt i = 0; i < level->num_owned && wrong < 0; i++) {
    PetscCall(PastFindPoint_Private(&past, tree, width, level, i, &point));
    if (point < 0) wrong = i;
    for (PetscInt k = 0; point >= 0 && k < level->dim; k++) value[i * level->dim + k] = past.moved[3 * point + k];
  }
  PetscCall(VecRestoreArray(*u, &value));
  *t = past.t;
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PastDestroy_Private(&past));
  PetscCall(PastCheckNode_Private(level, path, wrong, (PetscBool)(point == -2)));
  PetscCall(VecGhostUpdateBegin(*u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(*u, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}
