// The plain C interface of libvolumark_oiio.so. Pixels are RGBA float, row 0 on top. Zero is success; otherwise `error`
// holds the reason, cut to error_size.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// 8-bit values (srgb8 != 0: RGB encoded by the sRGB curve, alpha dropped) or 32-bit float RGBA. `note` becomes the
// image's description; empty: none.
int vm_oiio_write(const char* path, const char* format, int width, int height, const float* rgba, int srgb8,
                  const char* note, char* error, size_t error_size);
// *rgba is freed by vm_oiio_free. 8- and 16-bit integer RGB is decoded from sRGB; a missing alpha is 1.
int vm_oiio_read(const char* path, int* width, int* height, float** rgba, char* error, size_t error_size);
void vm_oiio_free(float* rgba);

#ifdef __cplusplus
}
#endif
