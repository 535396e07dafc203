/* restartfile.c -- displacement of the last solved step and times, read from the file of an older run.

   Where regions meet, a node is several points with one displacement. */
#include <hdf5.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "kernel/boxtree.h"
#include "output/restartfile.h"
#include "output/xdmf.h"

/* Places nearer than this part of the extent of all bodies are the same: maps and refinements leave
   roundoff. */
static const PetscReal SAME_POINT = 1e-10;

enum { GROUP_NAME = 64, WHY_LENGTH = PETSC_MAX_PATH_LEN + 512, CHUNK = 1 << 15 };

/* Points of the file near the nodes of this rank. */
typedef struct {
  PetscInt   all, num;       /* points of the file; those that are kept */
  PetscInt  *number;         /* in the file, ascending [num] */
  PetscReal *points, *moved; /* [num][3] */
  int       *body;           /* -1 until found by a cell [num] */
  PetscBool *found;          /* whether a node of this rank is there [num] */
  PetscInt   num_times, capacity;
  PetscReal *times; /* of solved steps [num_times] */
} Past;

/* An open array, [rows][columns] or [rows]. */
typedef struct {
  hid_t   set, space; /* negative where there is no such array */
  hsize_t shape[2];
} Array;

static Array ArrayOpen_Private(hid_t file, const char name[])
{
  Array array = {.set = H5Dopen2(file, name, H5P_DEFAULT), .space = -1, .shape = {0, 1}};

  if (array.set >= 0) array.space = H5Dget_space(array.set);
  if (array.space >= 0 &&
      (H5Sget_simple_extent_ndims(array.space) > 2 || H5Sget_simple_extent_dims(array.space, array.shape, NULL) <= 0)) {
    H5Sclose(array.space);
    array.space = -1;
  }
  return array;
}

static void ArrayClose_Private(Array *array)
{
  if (array->space >= 0) H5Sclose(array->space);
  if (array->set >= 0) H5Dclose(array->set);
}

/* Reads some rows; whether it could. */
static PetscBool ArrayRead_Private(const Array *array, hid_t type, hsize_t begin, hsize_t rows, void *values)
{
  const hsize_t start[2] = {begin, 0}, count[2] = {rows, array->shape[1]};
  hid_t         memory;
  herr_t        bad;

  if (array->space < 0 || begin + rows > array->shape[0]) return PETSC_FALSE;
  memory = H5Screate_simple(H5Sget_simple_extent_ndims(array->space), count, NULL);
  bad    = H5Sselect_hyperslab(array->space, H5S_SELECT_SET, start, NULL, count, NULL);
  if (bad >= 0) bad = H5Dread(array->set, type, memory, array->space, H5P_DEFAULT, values);
  H5Sclose(memory);
  return (PetscBool)(bad >= 0);
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

/* Makes room for more times. */
static PetscErrorCode PastReserve_Private(Past *past, PetscInt more)
{
  PetscFunctionBeginUser;
  if (past->num_times + more > past->capacity) {
    past->capacity = 2 * past->capacity + more;
    PetscCall(PetscRealloc(past->capacity * sizeof(*past->times), &past->times));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The times of the runs that the file's run went on from. */
static PetscErrorCode PastReadBefore_Private(hid_t file, Past *past)
{
  const hid_t steps     = H5Gopen2(file, "steps", H5P_DEFAULT);
  const hid_t attribute = steps >= 0 && H5Aexists(steps, "before") > 0 ? H5Aopen(steps, "before", H5P_DEFAULT) : -1;
  const hid_t space     = attribute >= 0 ? H5Aget_space(attribute) : -1;
  hssize_t    num       = 0;

  PetscFunctionBeginUser;
  if (space >= 0) {
    num = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
  }
  if (num > 0) {
    PetscCall(PastReserve_Private(past, (PetscInt)num));
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, past->times) >= 0) past->num_times = (PetscInt)num;
  }
  if (attribute >= 0) H5Aclose(attribute);
  if (steps >= 0) H5Gclose(steps);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The group of the last solved step, "" for none, and the times of all of them. */
static PetscErrorCode PastFindStep_Private(hid_t file, char name[GROUP_NAME], Past *past)
{
  const FieldSeries series = {0};

  PetscFunctionBeginUser;
  name[0] = '\0';
  if (H5Lexists(file, "steps", H5P_DEFAULT) <= 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PastReadBefore_Private(file, past));
  for (PetscInt i = 0;; i++) {
    char   step[XDMF_STEP_NAME];
    double solved = 0, time = 0;
    hid_t  group;

    XDMFStepName(&series, i, step);
    group = H5Lexists(file, step, H5P_DEFAULT) > 0 ? H5Gopen2(file, step, H5P_DEFAULT) : -1;
    if (group < 0) break;
    if (PastReadNumber_Private(group, "solved", &solved) && solved > 0 && PastReadNumber_Private(group, "t", &time)) {
      snprintf(name, GROUP_NAME, "%s", step);
      PetscCall(PastReserve_Private(past, 1));
      past->times[past->num_times++] = time;
    }
    H5Gclose(group);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Keeps points within a box, and their displacements. Returns whether the file has them. [in] box - [2][3] */
static PetscErrorCode PastReadPoints_Private(const Array *points, const Array *moved, const PetscReal box[], Past *past,
                                             PetscBool *good)
{
  PetscReal *chunk, *shift;
  PetscInt   capacity = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(3 * CHUNK, &chunk, 3 * CHUNK, &shift));
  past->all = (PetscInt)points->shape[0];
  *good     = (PetscBool)(points->shape[1] == 3 && moved->shape[1] == 3 && points->shape[0] == moved->shape[0]);
  for (PetscInt begin = 0; *good && begin < past->all; begin += CHUNK) {
    const PetscInt rows = PetscMin(CHUNK, past->all - begin);

    *good = (PetscBool)(ArrayRead_Private(points, H5T_NATIVE_DOUBLE, (hsize_t)begin, (hsize_t)rows, chunk) &&
                        ArrayRead_Private(moved, H5T_NATIVE_DOUBLE, (hsize_t)begin, (hsize_t)rows, shift));
    if (past->num + rows > capacity) {
      capacity = 2 * capacity + rows;
      PetscCall(PetscRealloc(capacity * sizeof(*past->number), &past->number));
      PetscCall(PetscRealloc(3 * capacity * sizeof(PetscReal), &past->points));
      PetscCall(PetscRealloc(3 * capacity * sizeof(PetscReal), &past->moved));
    }
    for (PetscInt i = 0; *good && i < rows; i++) {
      PetscBool inside = PETSC_TRUE;

      for (PetscInt k = 0; k < 3; k++)
        inside = (PetscBool)(inside && chunk[3 * i + k] >= box[k] && chunk[3 * i + k] <= box[3 + k]);
      if (!inside) continue;
      PetscCall(PetscArraycpy(&past->points[3 * past->num], &chunk[3 * i], 3));
      PetscCall(PetscArraycpy(&past->moved[3 * past->num], &shift[3 * i], 3));
      past->number[past->num++] = begin + i;
    }
  }
  PetscCall(PetscFree2(chunk, shift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the complete cells at the begin of some rows of the list, and sets the bodies of their points; body
   NULL: counts only. Returns the number of cells, -1 for an invalid list. [out] used - rows */
static PetscInt PastTakeCells_Private(const int list[], PetscInt rows, PetscInt columns, const int body[], Past *past,
                                      PetscInt *used)
{
  PetscInt cells = 0, at = 0;

  for (; at < rows * columns; cells++) {
    const PetscInt head  = columns == 1,
                   nodes = head ? XDMFTopologyGetNumNodes(list[at]) : columns; // several types: a list

    if (!nodes) return -1;
    if (at + head + nodes > rows * columns) break;
    for (PetscInt i = 0; body && i < nodes; i++) {
      PetscInt place;

      if (list[at + head + i] < 0 || list[at + head + i] >= past->all) return -1;
      if (PetscFindInt(list[at + head + i], past->num, past->number, &place)) return -1;
      if (place >= 0) past->body[place] = body[cells];
    }
    at += head + nodes;
  }
  *used = at / columns;
  return cells;
}

/* The body of each point, from those of the cells. [out] good - whether the file has these data */
static PetscErrorCode PastReadBodies_Private(const Array *cells, const Array *bodies, Past *past, PetscBool *good)
{
  const PetscInt rows = (PetscInt)cells->shape[0], columns = PetscMin((PetscInt)cells->shape[1], ELEMENT_MAX_NODES);
  int           *list, *body;
  PetscInt       used = 0, cell = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(CHUNK * columns, &list, CHUNK, &body));
  PetscCall(PetscMalloc1(past->num, &past->body));
  for (PetscInt i = 0; i < past->num; i++) past->body[i] = -1;
  *good = (PetscBool)(bodies->shape[1] == 1 && columns > 0 && columns == (PetscInt)cells->shape[1]);
  for (PetscInt at = 0; *good && at < rows; at += used) {
    const PetscInt num = PetscMin(CHUNK, rows - at);
    PetscInt       taken;

    *good = ArrayRead_Private(cells, H5T_NATIVE_INT, (hsize_t)at, (hsize_t)num, list);
    taken = *good ? PastTakeCells_Private(list, num, columns, NULL, past, &used) : 0;
    *good = (PetscBool)(taken > 0 && ArrayRead_Private(bodies, H5T_NATIVE_INT, (hsize_t)cell, (hsize_t)taken, body) &&
                        PastTakeCells_Private(list, num, columns, body, past, &used) == taken);
    cell += taken;
  }
  PetscCall(PetscFree2(list, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The arrays of an open file.
   [in] box - of places that are kept [2][3]; [out] why - the fault of the file, or "" */
static PetscErrorCode PastReadFile_Private(hid_t file, const PetscReal box[], Past *past, char why[])
{
  char      group[GROUP_NAME], name[2 * GROUP_NAME];
  PetscBool good = PETSC_FALSE;
  Array     arrays[4];

  PetscFunctionBeginUser;
  PetscCall(PastFindStep_Private(file, group, past));
  if (!group[0]) {
    PetscCall(PetscStrncpy(why, "has no solved load step; give the .h5 file of a run with -load_steps", WHY_LENGTH));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  snprintf(name, sizeof(name), "%sdisplacement", group);
  arrays[0] = ArrayOpen_Private(file, "points");
  arrays[1] = ArrayOpen_Private(file, name);
  arrays[2] = ArrayOpen_Private(file, "cells");
  arrays[3] = ArrayOpen_Private(file, "body");
  PetscCall(PastReadPoints_Private(&arrays[0], &arrays[1], box, past, &good));
  if (good) PetscCall(PastReadBodies_Private(&arrays[2], &arrays[3], past, &good));
  for (PetscInt i = 0; i < 4; i++) ArrayClose_Private(&arrays[i]);
  if (!good)
    PetscCall(PetscStrncpy(why,
                           "does not have points, cells and displacements of one mesh; runs with -adapt have "
                           "several, and cannot be gone on with",
                           WHY_LENGTH));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Each rank reads the file in chunks, and keeps the points near its nodes. Collective. Raises user errors.
   [in] box - [2][3] */
static PetscErrorCode PastCreate_Private(MPI_Comm comm, const char path[], const PetscReal box[], Past *past)
{
  char  why[WHY_LENGTH] = "", sentence[2 * WHY_LENGTH] = "";
  hid_t file;

  PetscFunctionBeginUser;
  *past = (Past){.num = 0, .times = NULL};
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // no stack of functions: failures here have messages of this program
  file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0)
    PetscCall(PetscStrncpy(why, "cannot be read as an HDF5 file", sizeof(why)));
  else
    PetscCall(PastReadFile_Private(file, box, past, why));
  if (file >= 0) H5Fclose(file);
  if (why[0]) snprintf(sentence, sizeof(sentence), "-restart %s: the file %s", path, why);
  PetscCall(UserErrorCheck(comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PastDestroy_Private(Past *past)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(past->number));
  PetscCall(PetscFree(past->points));
  PetscCall(PetscFree(past->moved));
  PetscCall(PetscFree(past->body));
  PetscCall(PetscFree(past->found));
  PetscCall(PetscFree(past->times));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The box around the nodes of this rank. Collective.
   [out] box - [2][3]; width - within which places are the same */
static PetscErrorCode PastGetBox_Private(const Level *level, PetscReal box[], PetscReal *width)
{
  PetscReal all[6];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    const PetscBool none = (PetscBool)(k >= level->dim && level->num_owned);

    all[k]     = none ? 0 : PETSC_MAX_REAL; // the least of x and of -x
    all[3 + k] = none ? 0 : PETSC_MAX_REAL;
    for (PetscInt i = 0; i < level->num_owned && k < level->dim; i++) {
      all[k]     = PetscMin(all[k], level->coords[i * level->dim + k]);
      all[3 + k] = PetscMin(all[3 + k], -level->coords[i * level->dim + k]);
    }
  }
  for (PetscInt k = 0; k < 6; k++) box[k] = k < 3 ? all[k] : -all[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, 6, MPIU_REAL, MPI_MIN, level->comm));
  *width = 0;
  for (PetscInt k = 0; k < level->dim; k++) *width = PetscMax(*width, -SAME_POINT * (all[k] + all[3 + k]));
  for (PetscInt k = 0; k < 6; k++) box[k] += k < 3 ? -*width : *width;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A tree of the places of all points. */
static PetscErrorCode PastCreateTree_Private(const Past *past, BoxTree *tree)
{
  PetscReal *boxes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(6 * past->num, &boxes));
  for (PetscInt i = 0; i < past->num; i++)
    for (PetscInt k = 0; k < 3; k++) boxes[6 * i + k] = boxes[6 * i + 3 + k] = past->points[3 * i + k];
  PetscCall(BoxTreeCreate(3, past->num, boxes, tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The point of a node, -1 for none, -2 for several with different displacements. Marks all of its points. */
static PetscErrorCode PastFindPoint_Private(Past *past, BoxTree tree, PetscReal width, const Level *level,
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
    *found               = same ? hits[h] : -2;
    past->found[hits[h]] = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error of the first owned node without a point. [in] node - -1 for none; several - whether it
   has too many */
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

/* Raises a user error of points that no rank has. Collective. */
static PetscErrorCode PastCheckPoints_Private(const Level *level, const char path[], const Past *past)
{
  PetscInt count = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < past->num; i++) count += past->found[i];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, level->comm));
  if (count < past->all)
    PetscCall(UserErrorRaise(level->comm,
                             "-restart %s: %" PetscInt_FMT " of the file's %" PetscInt_FMT
                             " points are no nodes of the scene; give the scene, with its mesh, that made the file",
                             path, past->all - count, past->all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RestartFileRead(Level *level, const char path[], Vec *u, PetscInt *num, PetscReal **times)
{
  Past         past;
  BoxTree      tree;
  PetscReal    box[6], width = 0;
  PetscScalar *value;
  PetscInt     wrong = -1, point = 0;

  PetscFunctionBeginUser;
  PetscCall(PastGetBox_Private(level, box, &width));
  PetscCall(PastCreate_Private(level->comm, path, box, &past));
  PetscCall(PastCreateTree_Private(&past, &tree));
  PetscCall(PetscCalloc1(past.num, &past.found));
  PetscCall(LevelCreateVec(level, level->dim, u));
  PetscCall(VecGetArray(*u, &value));
  for (PetscInt i = 0; i < level->num_owned && wrong < 0; i++) {
    PetscCall(PastFindPoint_Private(&past, tree, width, level, i, &point));
    if (point < 0) wrong = i;
    for (PetscInt k = 0; point >= 0 && k < level->dim; k++) value[i * level->dim + k] = past.moved[3 * point + k];
  }
  PetscCall(VecRestoreArray(*u, &value));
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PastCheckNode_Private(level, path, wrong, (PetscBool)(point == -2)));
  PetscCall(PastCheckPoints_Private(level, path, &past));
  *num       = past.num_times;
  *times     = past.times;
  past.times = NULL;
  PetscCall(PastDestroy_Private(&past));
  PetscCall(LevelShareVec(*u, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
