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
  H5FD_t      base; /* base class of HDF5; must be the first member */
  HDF5Driver *driver;
  haddr_t     allocated, end; /* end of allocated addresses; end of written ones */
} HDF5DriverFile;

static H5FD_t *HDF5DriverOpenFn(const char *name, unsigned flags, hid_t access, haddr_t max)
{
  HDF5Driver *const *driver = (HDF5Driver *const *)H5Pget_driver_info(access);
  HDF5DriverFile    *file   = driver ? (HDF5DriverFile *)calloc(1, sizeof(*file)) : NULL;

  (void)name, (void)flags, (void)max;
  if (file) file->driver = *driver;
  if (file) file->end = file->allocated = (*driver)->size;
  return (H5FD_t *)file;
}

static herr_t HDF5DriverCloseFn(H5FD_t *file)
{
  free(file);
  return 0;
}

/* The flags of HDF5's own drivers, so that the file has the same layout. */
static herr_t HDF5DriverQueryFn(const H5FD_t *file, unsigned long *features)
{
  (void)file;
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

static haddr_t HDF5DriverAllocatedFn(const H5FD_t *file, H5FD_mem_t type)
{
  (void)type;
  return ((const HDF5DriverFile *)file)->allocated;
}

static herr_t HDF5DriverAllocateFn(H5FD_t *file, H5FD_mem_t type, haddr_t end)
{
  (void)type;
  ((HDF5DriverFile *)file)->allocated = end;
  return 0;
}

static haddr_t HDF5DriverEndFn(const H5FD_t *file, H5FD_mem_t type)
{
  (void)type;
  return ((const HDF5DriverFile *)file)->end;
}

/* Bytes that cannot be read are 0. */
static herr_t HDF5DriverReadFn(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size, void *buffer)
{
  const HDF5DriverFile *file = (const HDF5DriverFile *)base;
  ssize_t               n    = 1;

  (void)type, (void)transfer;
  memset(buffer, 0, size);
  for (size_t done = 0; done < size && n > 0; done += (size_t)(n > 0 ? n : 0))
    n = pread(file->driver->file, (char *)buffer + done, size - done, (off_t)(at + done));
  for (const HDF5DriverChange *change = file->driver->changes; change; change = change->next) {
    const haddr_t begin = change->at > at ? change->at : at;
    const haddr_t end   = change->at + change->size < at + size ? change->at + change->size : at + size;

    if (begin < end) memcpy((char *)buffer + (begin - at), change->bytes + (begin - change->at), end - begin);
  }
  return 0;
}

/* Notes a change of bytes that the file had. */
static void HDF5DriverKeep_Private(HDF5Driver *driver, haddr_t at, size_t size, const void *buffer)
{
  HDF5DriverChange *change = malloc(sizeof(*change) + size);

  if (!change) {
    driver->error = ENOMEM;
    return;
  }
  *change = (HDF5DriverChange){.at = at, .size = size};
  memcpy(change->bytes, buffer, size);
  if (driver->latest)
    driver->latest->next = change;
  else
    driver->changes = change;
  driver->latest = change;
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

static herr_t HDF5DriverWriteFn(H5FD_t *base, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size,
                                const void *buffer)
{
  HDF5DriverFile *file   = (HDF5DriverFile *)base;
  HDF5Driver     *driver = file->driver;

  const size_t old = at >= driver->size ? 0 : driver->size - at < size ? (size_t)(driver->size - at) : size;

  (void)type, (void)transfer;
  if (at + size > file->end) file->end = at + size;
  if (old && !driver->error) HDF5DriverKeep_Private(driver, at, old, buffer);
  if (old < size && !driver->error)
    driver->error = HDF5DriverWriteBytes(driver->file, at + old, size - old, (const char *)buffer + old);
  return 0;
}

static herr_t HDF5DriverTruncateFn(H5FD_t *base, hid_t transfer, hbool_t closing)
{
  HDF5DriverFile *file = (HDF5DriverFile *)base;

  (void)transfer, (void)closing;
  if (file->end != file->allocated && file->allocated >= file->driver->size && !file->driver->error &&
      ftruncate(file->driver->file, (off_t)file->allocated))
    file->driver->error = errno;
  file->end = file->allocated;
  return 0;
}

static const H5FD_class_t driver_class = {
#if H5_VERSION_GE(1, 13, 2)
    .version = H5FD_CLASS_VERSION,
    .value   = H5_VFD_RESERVED + 1, /* a number of this program's own driver */
#endif
    .name      = "mortise",
    .maxaddr   = ((haddr_t)1 << 62) - 1,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(HDF5Driver *),
    .open      = HDF5DriverOpenFn,
    .close     = HDF5DriverCloseFn,
    .query     = HDF5DriverQueryFn,
    .get_eoa   = HDF5DriverAllocatedFn,
    .set_eoa   = HDF5DriverAllocateFn,
    .get_eof   = HDF5DriverEndFn,
    .read      = HDF5DriverReadFn,
    .write     = HDF5DriverWriteFn,
    .truncate  = HDF5DriverTruncateFn,
    .fl_map    = H5FD_FLMAP_DICHOTOMY};

hid_t HDF5DriverCreate(HDF5Driver *driver)
{
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);

  driver->id = H5FDregister(&driver_class);
  if (access >= 0 && (driver->id < 0 || H5Pset_driver(access, driver->id, &driver) < 0)) {
    H5Pclose(access);
    access = -1;
  }
  return access;
}

void HDF5DriverDestroy(HDF5Driver *driver)
{
  if (driver->id >= 0) H5FDunregister(driver->id);
}

int HDF5DriverCommit(HDF5Driver *driver)
{
  for (const HDF5DriverChange *change = driver->changes; change && !driver->error; change = change->next)
    driver->error = HDF5DriverWriteBytes(driver->file, change->at, change->size, change->bytes);
  return driver->error;
}

void HDF5DriverForget(HDF5Driver *driver)
{
  while (driver->changes) {
    HDF5DriverChange *next = driver->changes->next;

    free(driver->changes);
    driver->changes = next;
  }
  driver->latest = NULL;
}
