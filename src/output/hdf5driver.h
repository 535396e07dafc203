/* hdf5driver.h -- an HDF5 driver for a file that is open already.

   After a failed write HDF5 1.10 can neither close its file nor survive MPI_Finalize(), so a full disk would end in a crash
   instead of a sentence. This driver never fails: the first error is noted, and nothing is written from then on. */
#ifndef MORTISE_HDF5DRIVER_H
#define MORTISE_HDF5DRIVER_H

#include <hdf5.h>

typedef struct {
  int   file;  /* descriptor, open for writing */
  int   error; /* errno of the first write that failed, 0 while all is well */
  hid_t driver;
} Sink;

/* Access properties for H5Fcreate(), negative on failure; sink stays the caller's until the file is closed. */
hid_t HDF5DriverCreate(Sink *sink);
void  HDF5DriverDestroy(Sink *sink);

#endif
