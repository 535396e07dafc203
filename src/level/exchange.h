/* exchange.h -- records that ranks send to each other, and answers to them. */
#ifndef MORTISE_EXCHANGE_H
#define MORTISE_EXCHANGE_H

#include <petscsys.h>

typedef struct {
  MPI_Comm    comm;
  PetscInt    num, num_sent;                                        /* records received, and sent */
  PetscMPIInt size, *sent, *sent_begin, *received, *received_begin; /* by rank [size] */
  PetscInt   *place; /* index of each own record in the order of ranks [num_sent] */
} Exchange;

/* Collective.
   [in] rank - to which each record goes [num]; [out] exchange - owned by the caller, ExchangeDestroy() */
PetscErrorCode ExchangeCreate(MPI_Comm comm, PetscInt num, const PetscMPIInt rank[], Exchange *exchange);
PetscErrorCode ExchangeDestroy(Exchange *exchange);
/* Sends records of equal size. They are received in the order of ranks, and from each rank in its order.
   Collective.
   [in] bytes - of a record; [in] records - [num_sent]; [out] received - [num] */
PetscErrorCode ExchangeSend(const Exchange *exchange, size_t bytes, const void *records, void *received);
/* Sends an answer to each received record back. Collective.
   [in] bytes - of an answer; [in] answers - [num]; [out] own - in the order of the own records [num_sent] */
PetscErrorCode ExchangeAnswer(const Exchange *exchange, size_t bytes, const void *answers, void *own);

#endif
