#include "spherecloud/spherecloud.h"

uint32_t sphc_format_bytes(sphc_format format) {
  switch (format) {
    case SPHC_FORMAT_GRAY8:
      return 1;
    case SPHC_FORMAT_DEPTH16:
      return 2;
    case SPHC_FORMAT_RGB8:
    case SPHC_FORMAT_BGR8:
      return 3;
    default:
      return 0;
  }
}
