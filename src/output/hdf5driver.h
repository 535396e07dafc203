/* hdf5driver.h -- an HDF5 driver for a file that is open already.

   After a failed write HDF5 1.10 can neither close its file nor pass MPI_Finalize(): the program would crash
   on a full disk. This driver never fails. It notes the first error, and writes nothing after it.

   Changes of an existing file appear all at once. New bytes are appended behind its end, which readers
   ignore. Changes of old bytes wait in memory for HDF5DriverCommit(). Until then readers read the old
   file. */
#ifndef MORTISE_HDF5DRIVER_H
#define MORTISE_HDF5DRIVER_H

#include <hdf5.h>

/* A waiting change of bytes. */
typedef struct HDF5DriverChange {
  struct HDF5DriverChange *next;
  haddr_t                  at;
  size_t                   size;
  char                     bytes[];
} HDF5DriverChange;

typedef struct {
  int               file;  /* descriptor, open for writing */
  int               error; /* errno of the first write that failed, 0 while all is well */
  hid_t             id;
  haddr_t           size;    /* bytes that the file has already */
  HDF5DriverChange *changes; /* of them, in the order of writing */
  HDF5DriverChange *latest;
} HDF5Driver;

/* Access properties for H5Fcreate(), or H5Fopen() of a file that has bytes; negative on failure. driver stays
   the caller's until the file is closed. */
hid_t HDF5DriverCreate(HDF5Driver *driver);
void  HDF5DriverDestroy(HDF5Driver *driver);
/* Writes bytes to a descriptor. Returns 0 or errno. */
int HDF5DriverWriteBytes(int file, haddr_t at, size_t size, const void *bytes);
/* Changes the bytes that the file had. Call it when the file is closed, not in a signal handler. Returns 0 or
   errno. Not collective. */
int  HDF5DriverCommit(HDF5Driver *driver);
void HDF5DriverForget(HDF5Driver *driver);

#endif
