/* output.c -- the result files of a run, which appear together. */
#include <string.h>
#include "output/pathtable.h"
#include "output/output.h"
#include "base/usererror.h"
#include "base/compat.h"
#include "output/staleplots.h"
#include "output/fieldwriter.h"

struct _n_Output {
  MPI_Comm    comm;
  PetscMPIInt rank;
  FileSet     files; /* of the first rank */
};

struct _n_OutputSeries {
  PetscInt     num;   /* files of fields: of the bodies, of each pair */
  FieldSeries *file;  /* [num] */
  const Level *level; /* of the last step; borrowed, to be compared */
};

/* Path of one file of the scene's output; pair may be NULL. */
static PetscErrorCode OutputGetPath_Private(Scene scene, const char pair[], const char suffix[],
                                            char path[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  PetscCall(
      PetscSNPrintf(path, PETSC_MAX_PATH_LEN, "%s%s%s%s", scene->output, pair ? "_" : "", pair ? pair : "", suffix));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error for an output that names a folder: its files would be hidden ones. Collective. */
static PetscErrorCode OutputCheckName_Private(Scene scene)
{
  const char *slash = strrchr(scene->output, '/'), *name = slash ? slash + 1 : scene->output;

  PetscFunctionBeginUser;
  if (!name[0] || !strcmp(name, ".") || !strcmp(name, "..")) {
    PetscCall(UserErrorRaise(scene->comm,
                             "-output \"%s\" names no file; give the beginning of a name, such as %s%sresult",
                             scene->output, scene->output, name[0] ? "/" : ""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputCheck(Scene scene)
{
  char path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (scene->output) {
    const char *const files[] = {".json", scene->formats & OUTPUT_XDMF ? ".h5" : NULL,
                                 scene->formats & OUTPUT_XDMF ? ".xdmf" : NULL,
                                 scene->formats & OUTPUT_VTU ? ".vtu" : NULL, ".csv"};
    const size_t      num     = sizeof(files) / sizeof(files[0]);

    PetscCall(OutputCheckName_Private(scene));
    for (PetscInt p = -1; p < scene->num_pairs; p++) { /* the bodies have no table, a pair has no summary */
      for (size_t i = p < 0 ? 0 : 1; i < (p < 0 ? num - 1 : num); i++) {
        if (!files[i]) continue;
        PetscCall(OutputGetPath_Private(scene, p < 0 ? NULL : scene->pairs[p].name, files[i], path));
        if (scene->summary && !strcmp(path, scene->summary)) {
          PetscCall(UserErrorRaise(
              scene->comm, "-summary %s: -output %s writes this file, too; name another one, or - to print the summary",
              scene->summary, scene->output));
        }
        PetscCall(FileSetCheck(scene->comm, "-output", path));
      }
    }
  }
  if (scene->summary && strcmp(scene->summary, "-") != 0) {
    PetscCall(FileSetCheck(scene->comm, "-summary", scene->summary));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Content of a file of fields: fields of a pair or (pair < 0) of all bodies; without fields the motion of
   bodies, or their sides. */
typedef struct {
  VI                 vi;
  Fields             fields;
  const SceneMotion *motion;
  const SetupCheck  *setup;
  PetscInt           pair;
  OutputSeries       series; /* or NULL */
} Told;

static PetscErrorCode OutputWriteFields_Private(const Told *told, FieldWriter *writer)
{
  PetscFunctionBeginUser;
  if (told->setup) {
    PetscCall(BodyFieldsWriteSetup(writer, told->vi, told->setup));
  } else if (!told->fields) {
    PetscCall(BodyFieldsWriteMotion(writer, told->vi, told->motion));
  } else if (told->pair < 0) {
    PetscCall(BodyFieldsWrite(writer, told->fields));
  } else {
    PetscCall(SurfaceFieldsWrite(writer, told->fields, told->pair));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "upper,lower". [out] names - owned by the caller */
static PetscErrorCode OutputJoinBodies_Private(Scene scene, char **names)
{
  size_t length = 1, at = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) length += strlen(scene->bodies[b].name) + 1;
  PetscCall(PetscCalloc1(length, names));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    at += (size_t)snprintf(*names + at, length - at, "%s%s", b ? "," : "", scene->bodies[b].name);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds files of fields in the formats of the scene. Collective.
   [in] first - the quantities that a viewer shows first, as attributes of VTK's PointData */
static PetscErrorCode OutputAddFormats_Private(Output output, const Told *told, const char first[])
{
  static const struct {
    OutputFormat       bit;
    const FieldFormat *format;
    const char        *files[2]; // suffixes
  } formats[] = {{OUTPUT_XDMF, &field_format_hdf5, {".h5", ".xdmf"}}, {OUTPUT_VTU, &field_format_vtu, {".vtu", NULL}}};
  const Scene scene = told->vi->scene;
  const char *pair  = told->pair < 0 ? NULL : told->vi->pairs[told->pair]->spec->name;
  char        path[PETSC_MAX_PATH_LEN], *bodies;

  PetscFunctionBeginUser;
  PetscCall(OutputJoinBodies_Private(scene, &bodies));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(formats); i++) {
    if (scene->formats & formats[i].bit) {
      FieldWriter writer = {
          .base = path, .title = pair ? pair : scene->title, .bodies = bodies, .first = first, .files = &output->files};

      if (told->series) writer.series = &told->series->file[told->pair + 1];

      PetscCall(OutputGetPath_Private(scene, pair, "", path));
      PetscCall(FieldWriterOpen(output->comm, formats[i].format, &writer));
      PetscCall(OutputWriteFields_Private(told, &writer));
      PetscCall(FieldWriterClose(&writer));
    } else if (output->rank == 0) {
      for (PetscInt k = 0; k < 2 && formats[i].files[k]; k++) {
        PetscCall(OutputGetPath_Private(scene, pair, formats[i].files[k], path));
        PetscCall(FileSetRemove(&output->files, path));
      }
    }
  }
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputCreate(MPI_Comm comm, Output *output)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(output));
  (*output)->comm = comm;
  PetscCallMPI(MPI_Comm_rank(comm, &(*output)->rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tables that an earlier run of another kind may have left. What this run has of them is added afterwards. */
static PetscErrorCode OutputRemoveTables_Private(Output output, Scene scene)
{
  const char *const names[] = {"paths", "steps", "study"};
  char              path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (output->rank) PetscFunctionReturn(PETSC_SUCCESS);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names); i++) {
    PetscCall(OutputGetPath_Private(scene, names[i], ".csv", path));
    PetscCall(FileSetRemove(&output->files, path));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] series - or NULL */
static PetscErrorCode OutputAddFields_Private(Output output, OutputSeries series, Fields fields)
{
  const VI vi = fields->vi;
  char     path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(OutputAddFormats_Private(output, &(Told){.vi = vi, .fields = fields, .pair = -1, .series = series},
                                     "Vectors=\"displacement\" Tensors=\"stress\" Scalars=\"von_mises\""));
  if (output->rank == 0) PetscCall(StalePlotsRemove(&output->files, vi->scene->output));
  PetscCall(OutputRemoveTables_Private(output, vi->scene)); // before a pair of that name writes its own
  if (vi->scene->num_paths) {
    PetscCall(OutputGetPath_Private(vi->scene, "paths", ".csv", path));
    PetscCall(PathTableWrite(fields, &output->files, path));
  }
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    PetscCall(OutputGetPath_Private(vi->scene, vi->pairs[p]->spec->name, ".csv", path));
    PetscCall(CSVWritePair(fields, p, &output->files, path));
    PetscCall(OutputAddFormats_Private(output, &(Told){.vi = vi, .fields = fields, .pair = p, .series = series},
                                       "Vectors=\"displacement\" Scalars=\"pressure\" Normals=\"normal\""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddFields(Output output, Fields fields)
{
  PetscFunctionBeginUser;
  PetscCall(OutputAddFields_Private(output, NULL, fields));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputSeriesCreate(Scene scene, OutputSeries *series)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(series));
  (*series)->num = 1 + scene->num_pairs;
  PetscCall(PetscCalloc1((*series)->num, &(*series)->file));
  for (PetscInt i = 0; i < (*series)->num; i++) {
    (*series)->file[i].num_past = scene->steps.num_past;
    (*series)->file[i].past     = scene->steps.past;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputSeriesDestroy(OutputSeries *series)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < (*series)->num; i++) {
    PetscCall(PetscFree((*series)->file[i].t));
    PetscCall(PetscFree((*series)->file[i].grid));
  }
  PetscCall(PetscFree((*series)->file));
  PetscCall(PetscFree(*series));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddStep(Output output, OutputSeries series, Fields fields, PetscBool solved)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < series->num; i++) {
    FieldSeries *file = &series->file[i];

    if (file->num == file->capacity) {
      file->capacity = 2 * file->capacity + 16;
      PetscCall(PetscRealloc(file->capacity * sizeof(*file->t), &file->t));
      PetscCall(PetscRealloc(file->capacity * sizeof(*file->grid), &file->grid));
    }
    file->solved          = solved;
    file->varies          = fields->vi->scene->adapt.on;
    file->fresh           = (PetscBool)(fields->vi->level != series->level);
    file->t[file->num]    = fields->vi->scene->time;
    file->grid[file->num] = file->fresh ? (FieldGrid){0} : file->grid[file->num - 1];
    if (file->fresh) file->grid[file->num].step = file->varies ? file->num : -1;
    file->num++;
  }
  series->level = fields->vi->level;
  PetscCall(OutputAddFields_Private(output, series, fields));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All files of fields that an earlier run of the scene may have left. */
static PetscErrorCode OutputRemoveFields_Private(Output output, Scene scene)
{
  const char *const suffixes[] = {".csv", ".h5", ".xdmf", ".vtu"}; // the bodies have no table
  char              path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (output->rank) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = -1; p < scene->num_pairs; p++) {
    for (size_t i = p < 0; i < PETSC_STATIC_ARRAY_LENGTH(suffixes); i++) {
      PetscCall(OutputGetPath_Private(scene, p < 0 ? NULL : scene->pairs[p].name, suffixes[i], path));
      PetscCall(FileSetRemove(&output->files, path));
    }
  }
  PetscCall(OutputRemoveTables_Private(output, scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddMotion(Output output, VI vi, const SceneMotion *motion)
{
  PetscFunctionBeginUser;
  PetscCall(OutputRemoveFields_Private(output, vi->scene));
  PetscCall(OutputAddFormats_Private(output, &(Told){.vi = vi, .motion = motion, .pair = -1}, "Vectors=\"motion\""));
  if (output->rank == 0) PetscCall(StalePlotsRemove(&output->files, vi->scene->output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddSetup(Output output, VI vi, const SetupCheck *check)
{
  PetscFunctionBeginUser;
  PetscCall(OutputRemoveFields_Private(output, vi->scene));
  PetscCall(OutputAddFormats_Private(output, &(Told){.vi = vi, .setup = check, .pair = -1}, "Scalars=\"sides\""));
  if (output->rank == 0) PetscCall(StalePlotsRemove(&output->files, vi->scene->output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddText(Output output, const char path[], const char text[])
{
  FILE *out;

  PetscFunctionBeginUser;
  if (output->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FileSetOpen(&output->files, path, &out));
  if (out) fprintf(out, "%s\n", text);
  PetscCall(FileSetClose(&output->files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputFinish(Output *output)
{
  PetscFunctionBeginUser;
  PetscCall(FileSetFinish((*output)->comm, &(*output)->files));
  PetscCall(PetscFree(*output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputPrintNames(Scene scene, PetscBool pairs)
{
  PetscFunctionBeginUser;
  for (PetscInt p = -1; p < (pairs ? scene->num_pairs : 0); p++) { // -1: the bodies
    if (p >= 0) PetscCall(PetscPrintf(scene->comm, ", _%s.csv", scene->pairs[p].name));
    if (scene->formats & OUTPUT_XDMF) PetscCall(PetscPrintf(scene->comm, ", .h5, .xdmf"));
    if (scene->formats & OUTPUT_VTU) PetscCall(PetscPrintf(scene->comm, ", .vtu"));
  }
  if (pairs && scene->num_paths) PetscCall(PetscPrintf(scene->comm, ", _paths.csv"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[])
{
  Output output;

  PetscFunctionBeginUser;
  PetscCall(OutputCreate(comm, &output));
  PetscCall(OutputAddText(output, path, text));
  PetscCall(OutputFinish(&output));
  PetscFunctionReturn(PETSC_SUCCESS);
}
