/* exchange.c -- records by MPI_Alltoallv().

   It takes one step for any number of records. PetscSF would need the position of each record on its rank
   first. */
#include "level/exchange.h"
#include "base/compat.h"
#include <string.h>

PetscErrorCode ExchangeCreate(MPI_Comm comm, PetscInt num, const PetscMPIInt rank[], Exchange *x)
{
  PetscMPIInt *fill;

  PetscFunctionBeginUser;
  *x = (Exchange){.comm = comm, .num_sent = num};
  PetscCallMPI(MPI_Comm_size(comm, &x->size));
  PetscCall(PetscCalloc5(x->size, &x->sent, x->size, &x->sent_begin, x->size, &x->received, x->size, &x->received_begin,
                         num, &x->place));
  for (PetscInt i = 0; i < num; i++) x->sent[rank[i]]++;
  PetscCallMPI(MPI_Alltoall(x->sent, 1, MPI_INT, x->received, 1, MPI_INT, comm));
  for (PetscMPIInt r = 1; r < x->size; r++) {
    x->sent_begin[r]     = x->sent_begin[r - 1] + x->sent[r - 1];
    x->received_begin[r] = x->received_begin[r - 1] + x->received[r - 1];
  }
  x->num = x->received_begin[x->size - 1] + x->received[x->size - 1];
  PetscCall(PetscMalloc1(x->size, &fill));
  PetscCall(PetscArraycpy(fill, x->sent_begin, x->size));
  for (PetscInt i = 0; i < num; i++) x->place[i] = fill[rank[i]]++;
  PetscCall(PetscFree(fill));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExchangeDestroy(Exchange *x)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(x->sent, x->sent_begin, x->received, x->received_begin, x->place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sends own records to their ranks, or the answers back to them. */
static PetscErrorCode ExchangeRun_Private(const Exchange *x, PetscBool back, size_t bytes, const void *from, void *to)
{
  MPI_Datatype type; // one record: counts of bytes might not fit into an int
  char        *sorted;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCall(PetscMalloc1((size_t)x->num_sent * bytes, &sorted));
  for (PetscInt i = 0; i < x->num_sent && !back; i++)
    memcpy(sorted + (size_t)x->place[i] * bytes, (const char *)from + (size_t)i * bytes, bytes);
  PetscCallMPI(
      back ? MPI_Alltoallv(from, x->received, x->received_begin, type, sorted, x->sent, x->sent_begin, type, x->comm)
           : MPI_Alltoallv(sorted, x->sent, x->sent_begin, type, to, x->received, x->received_begin, type, x->comm));
  for (PetscInt i = 0; i < x->num_sent && back; i++)
    memcpy((char *)to + (size_t)i * bytes, sorted + (size_t)x->place[i] * bytes, bytes);
  PetscCall(PetscFree(sorted));
  PetscCallMPI(MPI_Type_free(&type));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExchangeSend(const Exchange *x, size_t bytes, const void *records, void *received)
{
  return ExchangeRun_Private(x, PETSC_FALSE, bytes, records, received);
}

PetscErrorCode ExchangeAnswer(const Exchange *x, size_t bytes, const void *answers, void *own)
{
  return ExchangeRun_Private(x, PETSC_TRUE, bytes, answers, own);
}
