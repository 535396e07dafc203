/* mutate.c -- see the header. */
#include "mutate.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned state;

void RandomSeed(unsigned seed)
{
  state = seed;
}

int Random(int end)
{
  return end > 1 ? rand_r(&state) % end : 0;
}

int RandomInteger(void)
{
  static const int values[] = {0, 1, 2, 3, 7, 10, -1, -7, INT_MAX, INT_MIN, INT_MAX - 1, INT_MAX / 2, 100000000};

  return values[Random(sizeof(values) / sizeof(*values))];
}

/* A piece of the text. */
typedef struct {
  size_t begin, end;
} Span;

static int IsOf_Private(uint8_t letter, const char letters[])
{
  return letter && strchr(letters, letter) != NULL;
}

/* The piece between two of the given letters that a random place is in; a line has its end with it. */
static Span SpanChoose_Private(const uint8_t *data, size_t size, const char between[], int with_end)
{
  Span span = {(size_t)Random((int)size), 0};

  while (span.begin < size && IsOf_Private(data[span.begin], between)) ++span.begin;
  span.end = span.begin;
  while (span.begin > 0 && !IsOf_Private(data[span.begin - 1], between)) --span.begin;
  while (span.end < size && !IsOf_Private(data[span.end], between)) ++span.end;
  if (with_end && span.end < size) ++span.end;
  return span;
}

/* Puts bytes in the place of a piece, unless there is no room. Returns the new size. */
static size_t Replace_Private(uint8_t *data, size_t size, size_t max_size, Span span, const char bytes[], size_t length)
{
  if (size - (span.end - span.begin) + length > max_size) return size;
  memmove(data + span.begin + length, data + span.end, size - span.end);
  memcpy(data + span.begin, bytes, length);
  return size - (span.end - span.begin) + length;
}

size_t MutateText(uint8_t *data, size_t size, size_t max_size)
{
  static const char *const words[] = {"0",     "-0",    "1e300",       "1e-320", "nan",  "inf",
                                      "1e999", "-1e99", "99999999999", "1e-12",  "0x10", "1.5",
                                      "free",  "none",  "#",           "\"\"",   "a:b",  "0,0,0"};
  const int                lines   = Random(2);
  const char *const        between = lines ? "\n" : Random(2) ? " \t\n" : " \t\n,:=+()*/\"";
  char                     number[16], *copy;
  Span                     span, other;

  if (!size) return LLVMFuzzerMutate(data, size, max_size);
  span  = SpanChoose_Private(data, size, between, lines);
  other = SpanChoose_Private(data, size, between, lines);
  switch (Random(5)) {
  case 0: return Replace_Private(data, size, max_size, span, "", 0);
  case 1: // once more, or another one beside it
    if (Random(2)) other = span;
    span.end = span.begin;
    break;
  case 2: break; // another one in its place
  case 3:
    snprintf(number, sizeof(number), "%d", RandomInteger());
    return Replace_Private(data, size, max_size, span, number, strlen(number));
  default: {
    const char *word = words[Random(sizeof(words) / sizeof(*words))];

    return Replace_Private(data, size, max_size, span, word, strlen(word));
  }
  }
  copy = malloc(other.end - other.begin + 1);
  if (!copy) return size;
  memcpy(copy, data + other.begin, other.end - other.begin);
  size = Replace_Private(data, size, max_size, span, copy, other.end - other.begin);
  free(copy);
  return size;
}
