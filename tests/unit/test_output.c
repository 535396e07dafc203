/* test_output.c -- files that are complete or absent, numbers that read back, pictures of mixed meshes. */
#include "test.h"
#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "output/output.h"
#include "base/json.h"
#include "output/fieldwriter.h"
#include "result/gatherarrays.h"
#include "output/xdmf.h"
#include "output/xml.h"

static PetscBool Exists(const char path[])
{
  return (PetscBool)(access(path, F_OK) == 0);
}

/* Whole file as text, owned by the caller. */
static char *Slurp(const char path[])
{
  FILE  *file = fopen(path, "rb");
  char  *text = (char *)calloc(1, 1 << 20);
  size_t n;

  CHECK(file && text);
  n = fread(text, 1, (1 << 20) - 1, file);
  CHECK(n > 0);
  fclose(file);
  return text;
}

/* Every double reads back as it was; what is not finite is null. */
static void TestNumbers(void)
{
  const PetscReal values[] = {0.1,  1.0 / 3.0,          -5.90791326180123e3, 4.9e-324, 1.7976931348623157e308,
                              1e22, 123456789.123456789};
  cJSON          *object   = cJSON_CreateObject(), *back;
  char           *text;
  const PetscReal mixed[] = {1.5, NAN, -INFINITY};

  JSONAddReals(object, "values", 7, values);
  JSONAddReals(object, "mixed", 3, mixed);
  JSONAddReal(object, "nothing", NAN);
  JSONAddInt(object, "count", 42);
  text = cJSON_PrintUnformatted(object);
  back = cJSON_Parse(text);
  CHECK(back);
  for (int i = 0; i < 7; ++i) {
    CHECK(cJSON_GetArrayItem(cJSON_GetObjectItem(back, "values"), i)->valuedouble == values[i]);
  }
  CHECK(strstr(text, "[0.1,"));
  CHECK(strstr(text, "\"mixed\":[1.5,null,null]"));
  CHECK(strstr(text, "\"nothing\":null") && strstr(text, "\"count\":42"));
  cJSON_Delete(back);
  cJSON_Delete(object);
  free(text);
}

/* The vectors of RFC 4648, and the five characters of XML. */
static void TestXML(void)
{
  static const char *const bytes[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
  static const char *const coded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  char                     text[64];

  for (int i = 0; i < 7; ++i) {
    FILE *out = fmemopen(text, sizeof(text), "w");

    XMLWriteBase64(out, strlen(bytes[i]), bytes[i]);
    fputc('\0', out);
    fclose(out);
    CHECK(strcmp(text, coded[i]) == 0);
  }
  {
    FILE *out = fmemopen(text, sizeof(text), "w");

    XMLWriteText(out, "<a & \"b\">\x01");
    fputc('\0', out);
    fclose(out);
    CHECK(strcmp(text, "&lt;a &amp; &quot;b&quot;&gt;") == 0);
  }
}

/* A quad and two triangles beside it. */
static const FieldMesh small_part = {.dim        = 2,
                                     .num_points = 6,
                                     .coords     = (const PetscReal[]){0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 1},
                                     .num_cells  = 3,
                                     .cell_type  = (const PetscInt[]){ELEMENT_QUAD4, ELEMENT_TRI3, ELEMENT_TRI3},
                                     .cell_nodes = (const PetscInt[]){0, 1, 2, 3, 1, 4, 5, 1, 5, 2}};

/* Quantities at the points of a part. */
static PetscErrorCode WritePicture(MPI_Comm comm, const FieldFormat *format, const FieldMesh *part, FileSet *files,
                                   const char base[])
{
  const PetscInt n       = part->num_points + 3; /* nodes or cells, at most */
  FieldWriter    picture = {.base   = base,
                            .title  = "a <mixed> & small one",
                            .bodies = "one,other",
                            .first  = "Vectors=\"displacement\"",
                            .files  = files};
  PetscReal     *values;

  PetscFunctionBeginUser;
  PetscCall(FieldWriterOpen(comm, format, &picture));
  PetscCall(FieldWriterMesh(&picture, part));
  PetscCall(PetscMalloc1(n * 9, &values));
  for (PetscInt i = 0; i < n * 9; ++i) values[i] = 0.5 * (PetscReal)i;
  PetscCall(FieldWriterPoints(&picture, (Quantity){"displacement", 3, PETSC_FALSE}, 2, values));
  PetscCall(FieldWriterPoints(&picture, (Quantity){"stress", 9, PETSC_FALSE}, 9, values));
  PetscCall(FieldWriterPoints(&picture, (Quantity){"von_mises", 1, PETSC_FALSE}, 1, values));
  PetscCall(FieldWriterPoints(&picture, (Quantity){"pressure", 1, PETSC_FALSE}, 1, values));
  for (PetscInt i = 0; i < n; ++i) values[i] = i < 3 ? 0.25 * (PetscReal)i : NAN;
  PetscCall(FieldWriterPoints(&picture, (Quantity){"gap", 1, PETSC_FALSE}, 1, values));
  for (PetscInt i = 0; i < n; ++i) values[i] = (PetscReal)(i % 4 - 1);
  PetscCall(FieldWriterPoints(&picture, (Quantity){"status", 1, PETSC_TRUE}, 1, values));
  for (PetscInt c = 0; c < part->num_cells; ++c) values[c] = part->cell_type[c] != ELEMENT_QUAD4;
  PetscCall(FieldWriterCells(&picture, (Quantity){"body", 1, PETSC_TRUE}, values));
  PetscCall(FieldWriterClose(&picture));
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TestPicture(void)
{
  static const int expected[13] = {4, 1, 4, 5, 4, 1, 5, 2, 5, 0, 1, 2, 3};
  FileSet          files        = {0};
  int              cells[13], status[6];
  double           displacement[18], gap[6];
  hid_t            file, set;
  char            *text;

  PetscFunctionBeginUser;
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_hdf5, &small_part, &files, "folder/below/picture"));
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_vtu, &small_part, &files, "folder/below/picture"));
  CHECK(!Exists("folder/below/picture.h5")); /* not before it is finished */
  PetscCall(FileSetFinish(PETSC_COMM_SELF, &files));

  file = H5Fopen("folder/below/picture.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
  CHECK(file >= 0);
  set = H5Dopen2(file, "cells", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells) >= 0);
  CHECK(memcmp(cells, expected, sizeof(expected)) == 0);
  H5Dclose(set);
  set = H5Dopen2(file, "displacement", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, displacement) >= 0);
  for (int i = 0; i < 18; ++i) CHECK(displacement[i] == (i % 3 < 2 ? 0.5 * (i - i / 3) : 0.0)); /* in the plane */
  H5Dclose(set);
  set = H5Dopen2(file, "gap", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, gap) >= 0);
  CHECK(gap[2] == 0.5 && isnan(gap[3]));
  H5Dclose(set);
  set = H5Dopen2(file, "status", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, status) >= 0);
  CHECK(status[0] == -1 && status[3] == 2 && status[5] == 0);
  H5Dclose(set);
  H5Fclose(file);

  text = Slurp("folder/below/picture.xdmf");
  CHECK(strstr(text, "TopologyType=\"Mixed\"") && strstr(text, ">picture.h5:/cells<"));
  CHECK(strstr(text, "a &lt;mixed&gt; &amp; small one"));
  free(text);
  text = Slurp("folder/below/picture.vtu");
  CHECK(strstr(text, "NumberOfPoints=\"6\" NumberOfCells=\"3\""));
  free(text);
  unlink("folder/below/picture.h5");
  unlink("folder/below/picture.xdmf");
  unlink("folder/below/picture.vtu");
  CHECK(rmdir("folder/below") == 0 && rmdir("folder") == 0); /* nothing else was left there */
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells of second order keep their nodes in the order of element.h, which is that of XDMF and of VTK. The
   numbers by which the formats know them are 36 and 35, 22 and 28. */
static PetscErrorCode TestQuadraticCells(void)
{
  static const int       expected[17] = {36, 0, 1, 2, 3, 4, 5, 35, 1, 6, 7, 2, 8, 9, 10, 4, 11};
  static PetscInt        start[3] = {0, 6, 15}, nodes[15] = {0, 1, 2, 3, 4, 5, 1, 6, 7, 2, 8, 9, 10, 4, 11};
  static const PetscInt  type[2]        = {ELEMENT_TRI6, ELEMENT_QUAD9};
  const FieldRows        rows           = {2, 2, 2, {{ELEMENT_TRI6, 1, 1, 0}, {ELEMENT_QUAD9, 1, 1, 1}}};
  static const PetscReal places[12 * 2] = {0};
  const FieldMesh        part           = {
                       .dim = 2, .num_points = 12, .coords = places, .num_cells = 2, .cell_type = type, .cell_nodes = nodes};
  Topology topology;
  FileSet  files = {0};
  char    *text;

  PetscFunctionBeginUser;
  PetscCall(XDMFTopologyCreate(&rows, &(SortedCells){start, nodes}, &topology));
  CHECK(strcmp(topology.name, "Mixed") == 0 && topology.rows == 17 && topology.columns == 1);
  CHECK(memcmp(topology.values, expected, sizeof(expected)) == 0);
  PetscCall(XDMFTopologyDestroy(&topology));
  for (PetscInt first = 0; first < 2; ++first) {
    static const char *const name[2]  = {"Triangle_6", "Quadrilateral_9"};
    PetscInt                 alone[2] = {0, first ? 9 : 6};

    PetscCall(XDMFTopologyCreate(&(FieldRows){1, 1, 1, {{(ElementType)type[first], 1, 1, 0}}},
                                 &(SortedCells){alone, nodes}, &topology));
    CHECK(strcmp(topology.name, name[first]) == 0 && topology.rows == 1 && topology.columns == alone[1]);
    PetscCall(XDMFTopologyDestroy(&topology));
  }
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_vtu, &part, &files, "picture"));
  PetscCall(FileSetFinish(PETSC_COMM_SELF, &files));
  text = Slurp("picture.vtu");
  CHECK(strstr(text, "Name=\"types\" format=\"binary\">\nAgAAAAAAAAAWHA==\n")); /* 2 bytes: 22, 28 */
  free(text);
  unlink("picture.vtu");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Points that are some of the nodes. Rank 1 has nothing, others have cells of two types: a triangle and, on
   rank 2 before it, a quad. */
static PetscErrorCode TestSomeNodes(void)
{
  static const int alone[3] = {0, 1, 2}, mixed[13] = {4, 0, 1, 2, 4, 3, 4, 5, 5, 3, 4, 5, 6};
  PetscMPIInt      rank, ranks;
  const PetscReal  coords[] = {0, 0, 1, 0, 2, 0, 3, 1, 4, 1};
  const PetscInt   nodes[] = {0, 2, 3, 4}, types[] = {ELEMENT_QUAD4, ELEMENT_TRI3};
  PetscInt         corners[7], first               = 0, num;
  FileSet          files = {0};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  CHECK(ranks <= 3);
  num   = rank == 1 ? 0 : rank ? 4 : 3;
  first = rank ? 3 : 0;
  for (PetscInt i = 0; i < 7; ++i) corners[i] = first + (i < 4 ? i : i - 4);
  PetscCall(WritePicture(PETSC_COMM_WORLD, &field_format_hdf5,
                         &(FieldMesh){.dim        = 2,
                                      .num_points = num,
                                      .nodes      = num ? nodes : NULL,
                                      .coords     = coords,
                                      .num_cells  = num ? num - 2 : 0,
                                      .cell_type  = rank ? types : &types[1],
                                      .cell_nodes = rank ? corners : &corners[4]},
                         &files, "side"));
  PetscCall(FileSetFinish(PETSC_COMM_WORLD, &files));
  if (rank == 0) {
    const hid_t file    = H5Fopen("side.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t sets[4] = {H5Dopen2(file, "points", H5P_DEFAULT), H5Dopen2(file, "cells", H5P_DEFAULT),
                           H5Dopen2(file, "displacement", H5P_DEFAULT), H5Dopen2(file, "body", H5P_DEFAULT)};
    double      points[3 * 7], moved[3 * 7];
    int         cells[14] = {0}, body[3] = {-1, -1, -1};

    CHECK(H5Dread(sets[0], H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, points) >= 0);
    CHECK(H5Dread(sets[1], H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells) >= 0);
    CHECK(H5Dread(sets[2], H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, moved) >= 0);
    CHECK(H5Dread(sets[3], H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, body) >= 0);
    CHECK(points[0] == 0 && points[3] == 2 && points[6] == 3 && points[7] == 1);
    if (ranks <= 2) CHECK(memcmp(cells, alone, sizeof(alone)) == 0 && body[0] == 1);
    if (ranks > 2) {
      CHECK(memcmp(cells, mixed, sizeof(mixed)) == 0);
      CHECK(points[9] == 0 && points[12] == 2 && points[18] == 4 && moved[12] == 0.5 * 4 && moved[13] == 0.5 * 5);
      CHECK(body[0] == 1 && body[1] == 1 && body[2] == 0);
    }
    for (int i = 0; i < 4; ++i) H5Dclose(sets[i]);
    H5Fclose(file);
    CHECK(unlink("side.h5") == 0 && unlink("side.xdmf") == 0);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* While a large picture is written, the first rank holds one quantity and not all: less than half of the file. */
static PetscErrorCode TestMemory(void)
{
#if !defined(__SANITIZE_ADDRESS__) /* which keeps what is freed */
  enum { NUM = 400000 };
  PetscReal *coords;
  PetscInt   nodes[3] = {0, 1, 2};
  FieldMesh  part     = {
           .dim = 2, .num_points = NUM, .num_cells = 1, .cell_type = (const PetscInt[]){ELEMENT_TRI3}, .cell_nodes = nodes};
  FileSet       files = {0};
  struct rusage before, after;
  struct stat   info;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(NUM * 2, &coords));
  for (PetscInt i = 0; i < NUM * 2; ++i) coords[i] = (PetscReal)i;
  part.coords = coords;
  CHECK(getrusage(RUSAGE_SELF, &before) == 0);
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_hdf5, &part, &files, "large"));
  CHECK(getrusage(RUSAGE_SELF, &after) == 0);
  PetscCall(FileSetFinish(PETSC_COMM_SELF, &files));
  CHECK(stat("large.h5", &info) == 0 && info.st_size > (3 + 3 + 9 + 3) * NUM * 8);
  CHECK((after.ru_maxrss - before.ru_maxrss) * 1024 < info.st_size * 2 / 3);
  PetscCall(PetscFree(coords));
  CHECK(unlink("large.h5") == 0 && unlink("large.xdmf") == 0);
#else
  PetscFunctionBeginUser;
#endif
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first rank takes no part of what others write, and is told when one of them cannot. */
static PetscErrorCode TestSpread(void)
{
  enum { NUM = 400000 };
  PetscMPIInt    rank, ranks;
  PetscReal     *coords;
  const PetscInt nodes[3] = {0, 1, 2}, type = ELEMENT_TRI3;
  FileSet        files = {0};
  FieldMesh      part  = {.dim = 3, .cell_type = &type, .cell_nodes = nodes};
  struct rusage  before, after;
  struct rlimit  old;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  if (ranks == 1) PetscFunctionReturn(PETSC_SUCCESS);
  if (rank == 1) part.num_points = NUM;
  if (rank == 1) part.num_cells = 1;
  PetscCall(PetscCalloc1(3 * part.num_points, &coords));
  part.coords = coords;
  CHECK(getrusage(RUSAGE_SELF, &before) == 0);
  PetscCall(WritePicture(PETSC_COMM_WORLD, &field_format_hdf5, &part, &files, "large"));
  CHECK(getrusage(RUSAGE_SELF, &after) == 0);
#if !defined(__SANITIZE_ADDRESS__)
  if (rank != 1) CHECK((after.ru_maxrss - before.ru_maxrss) * 1024 < NUM * 8);
#endif
  PetscCall(FileSetFinish(PETSC_COMM_WORLD, &files));
  if (rank == 0) CHECK(unlink("large.h5") == 0 && unlink("large.xdmf") == 0);

  CHECK(getrlimit(RLIMIT_FSIZE, &old) == 0);
  signal(SIGXFSZ, SIG_IGN);
  if (rank == 1) CHECK(setrlimit(RLIMIT_FSIZE, &(struct rlimit){1 << 16, old.rlim_max}) == 0);
  files = (FileSet){0};
  PetscCall(WritePicture(PETSC_COMM_WORLD, &field_format_hdf5, &part, &files, "large"));
  CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  if (rank == 0) CHECK(strstr(files.failure, "cannot write large.h5: "));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FileSetFinish(PETSC_COMM_WORLD, &files);
  PetscCall(PetscPopErrorHandler());
  CHECK(error == PETSC_ERR_FILE_WRITE && !Exists("large.h5") && !Exists("large.xdmf"));
  PetscCall(PetscFree(coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A disk that is full after 4 KiB: an error, a sentence, and no file at all, not even those that would have fitted. */
static PetscErrorCode TestFullDisk(void)
{
  struct rlimit  old, small;
  FileSet        files = {0};
  FILE          *out;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  CHECK(getrlimit(RLIMIT_FSIZE, &old) == 0);
  small = (struct rlimit){4096, old.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  PetscCall(FileSetOpen(&files, "fits.txt", &out));
  fputs("short", out);
  PetscCall(FileSetClose(&files, &out));
  CHECK(!files.failure[0]);
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_hdf5, &small_part, &files, "large"));
  CHECK(strstr(files.failure, "cannot write large.h5: "));
  PetscCall(WritePicture(PETSC_COMM_SELF, &field_format_vtu, &small_part, &files, "large")); /* does nothing any more */
  CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FileSetFinish(PETSC_COMM_SELF, &files);
  PetscCall(PetscPopErrorHandler());
  CHECK(error == PETSC_ERR_FILE_WRITE);
  CHECK(!Exists("fits.txt") && !Exists("large.h5") && !Exists("large.xdmf") && !Exists("large.vtu"));

  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  files = (FileSet){0};
  PetscCall(FileSetOpen(&files, "deep/down/long.txt", &out));
  for (int i = 0; i < 10000; ++i) fputs("too long\n", out);
  PetscCall(FileSetClose(&files, &out));
  CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  CHECK(strstr(files.failure, "cannot write deep/down/long.txt: "));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FileSetFinish(PETSC_COMM_SELF, &files);
  PetscCall(PetscPopErrorHandler());
  CHECK(error == PETSC_ERR_FILE_WRITE && !Exists("deep"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What cannot be written is known before anything is computed, and trying it leaves nothing. */
static PetscErrorCode TestCheck(void)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  PetscCall(OutputWriteText(PETSC_COMM_SELF, "plain", "a file, not a folder"));
  PetscCall(FileSetCheck(PETSC_COMM_SELF, "-output", "new/folders/run.json"));
  CHECK(!Exists("new"));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FileSetCheck(PETSC_COMM_SELF, "-output", "plain/run.json");
  PetscCall(PetscPopErrorHandler());
  CHECK(error == MORTISE_ERR_USER);
  CHECK(strstr(UserErrorSentence(), "-output") && strstr(UserErrorSentence(), "plain/run.json"));
  CHECK(mkdir("taken", 0777) == 0);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FileSetCheck(PETSC_COMM_SELF, "-summary", "taken");
  PetscCall(PetscPopErrorHandler());
  CHECK(error == MORTISE_ERR_USER);
  CHECK(rmdir("taken") == 0 && unlink("plain") == 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Ranks give different amounts, one gives nothing. */
static PetscErrorCode TestGather(void)
{
  PetscMPIInt rank, ranks;
  PetscInt    n, total, *all, mine[8];

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  n = rank == 1 ? 0 : rank + 1;
  for (PetscInt i = 0; i < n; ++i) mine[i] = 10 * rank + i;
  PetscCall(GatherArraysInt(PETSC_COMM_WORLD, n, mine, &total, &all));
  if (rank == 0) {
    CHECK(total == (ranks == 1 ? 1 : ranks * (ranks + 1) / 2 - 2) && all[0] == 0);
    if (ranks > 2) CHECK(all[1] == 20 && all[3] == 22);
  } else {
    CHECK(total == 0 && !all);
  }
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  char        folder[] = "mortise_test_XXXXXX";
  PetscMPIInt rank;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(TestGather());
  if (rank == 0) CHECK(mkdtemp(folder));
  PetscCallMPI(MPI_Bcast(folder, sizeof(folder), MPI_CHAR, 0, PETSC_COMM_WORLD));
  CHECK(chdir(folder) == 0);
  PetscCall(TestSomeNodes());
  PetscCall(TestSpread());
  if (rank == 0) {
    TestNumbers();
    TestXML();
    PetscCall(TestPicture());
    PetscCall(TestQuadraticCells());
    PetscCall(TestMemory());
    PetscCall(TestFullDisk());
    PetscCall(TestCheck());
    CHECK(chdir("..") == 0 && rmdir(folder) == 0);
  }
  PetscCall(PetscFinalize());
  return 0;
}
