/* xml.h -- text and binary data inside XML. */
#ifndef MORTISE_XML_H
#define MORTISE_XML_H

#include <stdio.h>

/* Writes text with the five characters that XML reserves replaced. */
void XMLWriteText(FILE *out, const char text[]);
/* Writes bytes in base64, as one unit with padding at its end. */
void XMLWriteBase64(FILE *out, size_t size, const void *bytes);

#endif
