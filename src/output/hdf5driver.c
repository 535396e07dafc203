/* hdf5driver.c -- HDF5's write operations on an open file. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "output/hdf5driver.h"
#if H5_VERSION_GE(1, 13, 2)
#include <H5FDdevelop.h>
#endif

typedef struct {
  H5FD_t  base; /* base class of HDF5; must be the first member */
  Sink   *sink;
  haddr_t allocated, end; /* end of allocated addresses; end of written ones */
} SinkFile;

static H5FD_t *SinkOpenFn(const char *name, unsigned flags, hid_t access, haddr_t max)
{
  Sink *const *sink = (Sink *const *)H5Pget_driver_info(access);
  SinkFile    *file = sink ? (SinkFile *)calloc(1, sizeof(*file)) : NULL;

  (void)name, (void)flags, (void)max;
  if (file) file->sink = *sink;
  if (file) file->end = file->allocated = (*sink)->size;
  return (H5FD_t *)file;
}

static herr_t SinkCloseFn(H5FD_t *file)
{
  free(file);
  return 0;
}

/* As HDF5's own drivers, so that the file is that of theirs. */
static herr_t SinkQueryFn(const H5FD_t *file, unsigned long *features)
{
  (void)file;
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

static haddr_t SinkAllocatedFn(const H5FD_t *file, H5FD_mem_t type)
{
  (void)type;
  return ((const SinkFile *)file)->allocated;
}

static herr_t SinkAllocateFn(H5FD_t *file, H5FD_mem_t type, haddr_t end)
{
  (void)type;
  ((SinkFile *)file)->allocated = end;
  return 0;
}

static haddr_t SinkEndFn(const H5FD_t *file, H5FD_mem_t type)
{
  (void)type;
  return ((const SinkFile *)file)->end;
}

/* Bytes that cannot be read are 0. */
static herr_t SinkReadFn(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size, void *buffer)
{
  const SinkFile *file = (const SinkFile *)base;
  ssize_t         n    = 1;

  (void)type, (void)transfer;
  memset(buffer, 0, size);
  for (size_t done = 0; done < size && n > 0; done += (size_t)(n > 0 ? n : 0))
    n = pread(file->sink->file, (char *)buffer + done, size - done, (off_t)(at + done));
  for (const SinkChange *change = file->sink->changes; change; change = change->next) {
    const haddr_t begin = change->at > at ? change->at : at;
    const haddr_t end   = change->at + change->size < at + size ? change->at + change->size : at + size;

    if (begin < end) memcpy((char *)buffer + (begin - at), change->bytes + (begin - change->at), end - begin);
  }
  return 0;
}

/* Notes a change of bytes that the file had. */
static void SinkKeep_Private(Sink *sink, haddr_t at, size_t size, const void *buffer)
{
  SinkChange *change = malloc(sizeof(*change) + size);

  if (!change) {
    sink->error = ENOMEM;
    return;
  }
  *change = (SinkChange){.at = at, .size = size};
  memcpy(change->bytes, buffer, size);
  if (sink->latest)
    sink->latest->next = change;
  else
    sink->changes = change;
  sink->latest = change;
}

int HDF5DriverWriteBytes(int file, haddr_t at, size_t size, const void *bytes)
{
  for (size_t done = 0; done < size;) {
    const ssize_t n = pwrite(file, (const char *)bytes + done, size - done, (off_t)(at + done));

    if (n > 0)
      done += (size_t)n;
    else if (n == 0 || errno != EINTR)
      return n == 0 ? ENOSPC : errno;
  }
  return 0;
}

static herr_t SinkWriteFn(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size, const void *buffer)
{
  SinkFile *file = (SinkFile *)base;
  Sink     *sink = file->sink;

  const size_t old = at >= sink->size ? 0 : sink->size - at < size ? (size_t)(sink->size - at) : size;

  (void)type, (void)transfer;
  if (at + size > file->end) file->end = at + size;
  if (old && !sink->error) SinkKeep_Private(sink, at, old, buffer);
  if (old < size && !sink->error)
    sink->error = HDF5DriverWriteBytes(sink->file, at + old, size - old, (const char *)buffer + old);
  return 0;
}

static herr_t SinkTruncateFn(H5FD_t *base, hid_t transfer, hbool_t closing)
{
  SinkFile *file = (SinkFile *)base;

  (void)transfer, (void)closing;
  if (file->end != file->allocated && file->allocated >= file->sink->size && !file->sink->error &&
      ftruncate(file->sink->file, (off_t)file->allocated))
    file->sink->error = errno;
  file->end = file->allocated;
  return 0;
}

static const H5FD_class_t sink_class = {
#if H5_VERSION_GE(1, 13, 2)
    .version = H5FD_CLASS_VERSION,
    .value   = H5_VFD_RESERVED + 1, /* of a driver that only this program knows */
#endif
    .name      = "mortise_sink",
    .maxaddr   = ((haddr_t)1 << 62) - 1,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(Sink *),
    .open      = SinkOpenFn,
    .close     = SinkCloseFn,
    .query     = SinkQueryFn,
    .get_eoa   = SinkAllocatedFn,
    .set_eoa   = SinkAllocateFn,
    .get_eof   = SinkEndFn,
    .read      = SinkReadFn,
    .write     = SinkWriteFn,
    .truncate  = SinkTruncateFn,
    .fl_map    = H5FD_FLMAP_DICHOTOMY};

hid_t HDF5DriverCreate(Sink *sink)
{
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);

  sink->driver = H5FDregister(&sink_class);
  if (access >= 0 && (sink->driver < 0 || H5Pset_driver(access, sink->driver, &sink) < 0)) {
    H5Pclose(access);
    access = -1;
  }
  return access;
}

void HDF5DriverDestroy(Sink *sink)
{
  if (sink->driver >= 0) H5FDunregister(sink->driver);
}

int HDF5DriverCommit(Sink *sink)
{
  for (const SinkChange *change = sink->changes; change && !sink->error; change = change->next)
    sink->error = HDF5DriverWriteBytes(sink->file, change->at, change->size, change->bytes);
  return sink->error;
}

void HDF5DriverForget(Sink *sink)
{
  while (sink->changes) {
    SinkChange *next = sink->changes->next;

    free(sink->changes);
    sink->changes = next;
  }
  sink->latest = NULL;
}
