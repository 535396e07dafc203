/* test_output.c -- files that are complete or absent, numbers that read back, pictures of mixed meshes. */
#include "test.h"
#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <mortise/compat.h>
#include <mortise/fault.h>
#include <mortise/output.h>
#include <mortise/json.h>
#include "../../src/result/picture.h"
#include "../../src/result/xdmf.h"
#include "../../src/result/xml.h"

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

/* A quad and two triangles beside it, sorted by type as PictureCreate() does. */
static void FillPicture(Picture *picture)
{
  static PetscReal points[6 * 3] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0};
  static PetscInt  start[4] = {0, 3, 6, 10}, nodes[10] = {1, 4, 5, 1, 5, 2, 0, 1, 2, 3};
  static PetscInt  type[3] = {ELEMENT_TRI3, ELEMENT_TRI3, ELEMENT_QUAD4};
  static PetscReal vector[18], tensor[54], scalar[6] = {1, 2, 3, 4, 5, 6}, gap[6], status[6] = {-1, 0, 1, 2, -1, -1};
  static PetscReal body[3] = {1, 1, 0};

  for (int i = 0; i < 18; ++i) vector[i] = 0.5 * i;
  for (int i = 0; i < 54; ++i) tensor[i] = i;
  for (int i = 0; i < 6; ++i) gap[i] = i < 3 ? 0.25 * i : NAN;
  memset(picture, 0, sizeof(*picture));
  picture->title            = "a <mixed> & small one";
  picture->first            = "Vectors=\"displacement\"";
  picture->num_points       = 6;
  picture->num_cells        = 3;
  picture->points           = points;
  picture->cell_start       = start;
  picture->cell_nodes       = nodes;
  picture->cell_type        = type;
  picture->num_point_arrays = 6;
  picture->num_cell_arrays  = 1;
  picture->point[0]         = (PictureArray){"displacement", 3, PETSC_FALSE, vector};
  picture->point[1]         = (PictureArray){"stress", 9, PETSC_FALSE, tensor};
  picture->point[2]         = (PictureArray){"von_mises", 1, PETSC_FALSE, scalar};
  picture->point[3]         = (PictureArray){"pressure", 1, PETSC_FALSE, scalar};
  picture->point[4]         = (PictureArray){"gap", 1, PETSC_FALSE, gap};
  picture->point[5]         = (PictureArray){"status", 1, PETSC_TRUE, status};
  picture->cell[0]          = (PictureArray){"body", 1, PETSC_TRUE, body};
}

static PetscErrorCode TestPicture(void)
{
  static const int expected[13] = {4, 1, 4, 5, 4, 1, 5, 2, 5, 0, 1, 2, 3};
  Picture          picture;
  Files            files = {0};
  int              cells[13];
  double           displacement[18], gap[6];
  hid_t            file, set;
  char            *text;

  PetscFunctionBeginUser;
  FillPicture(&picture);
  PetscCall(PictureWriteHDF5(&picture, &files, "folder/below/picture.h5"));
  PetscCall(PictureWriteXDMF(&picture, &files, "folder/below/picture.xdmf", "folder/below/picture.h5"));
  PetscCall(PictureWriteVTU(&picture, &files, "folder/below/picture.vtu"));
  CHECK(!Exists("folder/below/picture.h5")); /* not before it is finished */
  PetscCall(FilesFinish(PETSC_COMM_SELF, &files));

  file = H5Fopen("folder/below/picture.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
  CHECK(file >= 0);
  set = H5Dopen2(file, "cells", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells) >= 0);
  CHECK(memcmp(cells, expected, sizeof(expected)) == 0);
  H5Dclose(set);
  set = H5Dopen2(file, "displacement", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, displacement) >= 0);
  for (int i = 0; i < 18; ++i) CHECK(displacement[i] == 0.5 * i);
  H5Dclose(set);
  set = H5Dopen2(file, "gap", H5P_DEFAULT);
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, gap) >= 0);
  CHECK(gap[2] == 0.5 && isnan(gap[3]));
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

/* Cells of second order keep their nodes in the order of element.h, which is that of XDMF and of VTK; the numbers by which
   the formats know them are 36 and 35, 22 and 28. */
static PetscErrorCode TestQuadraticCells(void)
{
  static const int expected[17] = {36, 0, 1, 2, 3, 4, 5, 35, 1, 6, 7, 2, 8, 9, 10, 4, 11};
  static PetscInt  start[3] = {0, 6, 15}, nodes[15] = {0, 1, 2, 3, 4, 5, 1, 6, 7, 2, 8, 9, 10, 4, 11};
  static PetscInt  type[2] = {ELEMENT_TRI6, ELEMENT_QUAD9};
  Picture          picture;
  Topology         topology;
  Files            files = {0};
  char            *text;

  PetscFunctionBeginUser;
  FillPicture(&picture);
  picture.num_cells  = 2;
  picture.cell_start = start;
  picture.cell_nodes = nodes;
  picture.cell_type  = type;
  PetscCall(TopologyCreate(&picture, &topology));
  CHECK(strcmp(topology.name, "Mixed") == 0 && topology.rows == 17 && topology.columns == 1);
  CHECK(memcmp(topology.values, expected, sizeof(expected)) == 0);
  PetscCall(TopologyDestroy(&topology));
  for (PetscInt first = 0; first < 2; ++first) {
    static const char *const name[2]  = {"Triangle_6", "Quadrilateral_9"};
    PetscInt                 alone[2] = {0, first ? 9 : 6};

    picture.num_cells  = 1;
    picture.cell_start = alone;
    picture.cell_type  = &type[first];
    PetscCall(TopologyCreate(&picture, &topology));
    CHECK(strcmp(topology.name, name[first]) == 0 && topology.rows == 1 && topology.columns == alone[1]);
    PetscCall(TopologyDestroy(&topology));
  }
  picture.num_cells  = 2;
  picture.cell_start = start;
  picture.cell_type  = type;
  PetscCall(PictureWriteVTU(&picture, &files, "picture.vtu"));
  PetscCall(FilesFinish(PETSC_COMM_SELF, &files));
  text = Slurp("picture.vtu");
  CHECK(strstr(text, "Name=\"types\" format=\"binary\">\nAgAAAAAAAAAWHA==\n")); /* 2 bytes: 22, 28 */
  free(text);
  unlink("picture.vtu");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A disk that is full after 4 KiB: an error, a sentence, and no file at all, not even those that would have fitted. */
static PetscErrorCode TestFullDisk(void)
{
  struct rlimit  old, small;
  Picture        picture;
  Files          files = {0};
  FILE          *out;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  FillPicture(&picture);
  CHECK(getrlimit(RLIMIT_FSIZE, &old) == 0);
  small = (struct rlimit){4096, old.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  PetscCall(FilesOpen(&files, "fits.txt", &out));
  fputs("short", out);
  PetscCall(FilesClose(&files, &out));
  CHECK(!files.failure[0]);
  PetscCall(PictureWriteHDF5(&picture, &files, "large.h5"));
  CHECK(strstr(files.failure, "cannot write large.h5: "));
  PetscCall(PictureWriteVTU(&picture, &files, "large.vtu")); /* does nothing any more */
  CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FilesFinish(PETSC_COMM_SELF, &files);
  PetscCall(PetscPopErrorHandler());
  CHECK(error == PETSC_ERR_FILE_WRITE);
  CHECK(!Exists("fits.txt") && !Exists("large.h5") && !Exists("large.vtu"));

  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  files = (Files){0};
  PetscCall(FilesOpen(&files, "deep/down/long.txt", &out));
  for (int i = 0; i < 10000; ++i) fputs("too long\n", out);
  PetscCall(FilesClose(&files, &out));
  CHECK(setrlimit(RLIMIT_FSIZE, &old) == 0);
  CHECK(strstr(files.failure, "cannot write deep/down/long.txt: "));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FilesFinish(PETSC_COMM_SELF, &files);
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
  PetscCall(FilesCheck(PETSC_COMM_SELF, "-output", "new/folders/run.json"));
  CHECK(!Exists("new"));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FilesCheck(PETSC_COMM_SELF, "-output", "plain/run.json");
  PetscCall(PetscPopErrorHandler());
  CHECK(error == MORTISE_ERR_FAULT);
  CHECK(strstr(FaultSentence(), "-output") && strstr(FaultSentence(), "plain/run.json"));
  CHECK(mkdir("taken", 0777) == 0);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = FilesCheck(PETSC_COMM_SELF, "-summary", "taken");
  PetscCall(PetscPopErrorHandler());
  CHECK(error == MORTISE_ERR_FAULT);
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
  PetscCall(GatherInts(PETSC_COMM_WORLD, n, mine, &total, &all));
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
  if (rank == 0) {
    CHECK(mkdtemp(folder) && chdir(folder) == 0);
    TestNumbers();
    TestXML();
    PetscCall(TestPicture());
    PetscCall(TestQuadraticCells());
    PetscCall(TestFullDisk());
    PetscCall(TestCheck());
    CHECK(chdir("..") == 0 && rmdir(folder) == 0);
  }
  PetscCall(PetscFinalize());
  return 0;
}
