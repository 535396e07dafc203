/* xml.c -- XML encodings of text and binary data. */
#include <string.h>
#include "output/xml.h"

void XMLWriteText(FILE *out, const char text[])
{
  static const char        reserved[] = "&<>\"'";
  static const char *const entity[]   = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};

  for (; *text; text++) {
    const char *found = strchr(reserved, *text);

    if (found) {
      fputs(entity[found - reserved], out);
    } else if ((unsigned char)*text >= ' ' || *text == '\t' ||
               *text == '\n') { /* other control characters are not XML */
      fputc(*text, out);
    }
  }
}

/* RFC 4648: three bytes become four characters of six bits. */
void XMLWriteBase64(FILE *out, size_t size, const void *bytes)
{
  static const char    digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned char *in      = (const unsigned char *)bytes;

  for (size_t i = 0; i < size; i += 3) {
    const size_t   n    = size - i < 3 ? size - i : 3;
    const unsigned word = (unsigned)in[i] << 16 | (n > 1 ? (unsigned)in[i + 1] << 8 : 0) | (n > 2 ? in[i + 2] : 0);

    fputc(digit[word >> 18 & 63], out);
    fputc(digit[word >> 12 & 63], out);
    fputc(n > 1 ? digit[word >> 6 & 63] : '=', out);
    fputc(n > 2 ? digit[word & 63] : '=', out);
  }
}
