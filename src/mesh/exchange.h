/* exchange.h -- records that ranks send to each other, and answers to them. */
#ifndef MORTISE_EXCHANGE_H
#define MORTISE_EXCHANGE_H

#include <petscsys.h>

typedef struct {
  MPI_Comm    comm;
  PetscInt    num, num_sent;                                        /* records that came, and those that went */
  PetscMPIInt size, *sent, *sent_begin, *received, *received_begin; /* by rank [size] */
  PetscInt   *place;                                                /* of each own record among those sent [num_sent] */
} Exchange;

/* Collective. [in] rank - which each record goes to [num] */
PetscErrorCode ExchangeCreate(MPI_Comm comm, PetscInt num, const PetscMPIInt rank[], Exchange *exchange);
PetscErrorCode ExchangeDestroy(Exchange *exchange);
/* Sends records, all of so many bytes. They come in the order of ranks, and of each rank as they are there. Collective. [in] records -
   [num_sent]; [out] received - [num] */
PetscErrorCode ExchangeSend(const Exchange *exchange, size_t bytes, const void *records, void *received);
/* Sends an answer to each record back. Collective. [in] answers - [num]; [out] own - in the order of the own records [num_sent] */
PetscErrorCode ExchangeAnswer(const Exchange *exchange, size_t bytes, const void *answers, void *own);

#endif
