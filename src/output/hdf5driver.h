/* hdf5driver.h -- an HDF5 driver for a file that is open already.

   After a failed write HDF5 1.10 can neither close its file nor pass MPI_Finalize(): the program would crash
   on a full disk. This driver never fails. It notes the first error, and writes nothing after it.

   Changes of an existing file appear all at once. New bytes are appended behind its end, where readers do not
   look. Changes of old bytes wait in memory for HDF5DriverCommit(). Until then readers see the old file. */
#ifndef MORTISE_HDF5DRIVER_H
#define MORTISE_HDF5DRIVER_H

#include <hdf5.h>

/* A waiting change of bytes. */
typedef struct SinkChange {
  struct SinkChange *next;
  haddr_t            at;
  size_t             size;
  char               bytes[];
} SinkChange;

typedef struct {
  int         file;  /* descriptor, open for writing */
  int         error; /* errno of the first write that failed, 0 while all is well */
  hid_t       driver;
  haddr_t     size;    /* bytes that the file has already */
  SinkChange *changes; /* of them, in the order of writing */
  SinkChange *latest;
} Sink;

/* Access properties for H5Fcreate(), or H5Fopen() of a file that has bytes; negative on failure. sink stays
   the caller's until the file is closed. */
hid_t HDF5DriverCreate(Sink *sink);
void  HDF5DriverDestroy(Sink *sink);
/* Writes bytes to a descriptor. Returns 0 or errno. */
int HDF5DriverWriteBytes(int file, haddr_t at, size_t size, const void *bytes);
/* Changes the bytes that the file had. May be called once the file is closed, within no signal. Returns 0 or errno. */
int  HDF5DriverCommit(Sink *sink);
void HDF5DriverForget(Sink *sink);

#endif
