#include "spherecloud/spherecloud.h"

#define SPHC_TEXT2(x) #x
#define SPHC_TEXT(x) SPHC_TEXT2(x)

#if SPHC_VERSION_CANDIDATE
#define SPHC_CANDIDATE_TEXT "-rc" SPHC_TEXT(SPHC_VERSION_CANDIDATE)
#else
#define SPHC_CANDIDATE_TEXT ""
#endif

uint32_t sphc_abi(void) { return SPHC_ABI; }

const char *sphc_version_string(void) {
  return SPHC_TEXT(SPHC_VERSION_MAJOR) "." SPHC_TEXT(SPHC_VERSION_MINOR) "." SPHC_TEXT(SPHC_VERSION_PATCH)
      SPHC_CANDIDATE_TEXT;
}

const char *sphc_status_name(sphc_status status) {
  switch (status) {
    case SPHC_OK:
      return "SPHC_OK";
    case SPHC_AGAIN:
      return "SPHC_AGAIN";
    case SPHC_NOT_LOCALIZED:
      return "SPHC_NOT_LOCALIZED";
    case SPHC_END:
      return "SPHC_END";
    case SPHC_OUTSIDE:
      return "SPHC_OUTSIDE";
    case SPHC_E_ARGUMENT:
      return "SPHC_E_ARGUMENT";
    case SPHC_E_STRUCT_SIZE:
      return "SPHC_E_STRUCT_SIZE";
    case SPHC_E_STATE:
      return "SPHC_E_STATE";
    case SPHC_E_IMAGE:
      return "SPHC_E_IMAGE";
    case SPHC_E_MEMORY_SIZE:
      return "SPHC_E_MEMORY_SIZE";
    case SPHC_E_MEMORY_ALIGNMENT:
      return "SPHC_E_MEMORY_ALIGNMENT";
    case SPHC_E_CAPACITY:
      return "SPHC_E_CAPACITY";
    case SPHC_E_MAP_FORMAT:
      return "SPHC_E_MAP_FORMAT";
    case SPHC_E_MAP_VERSION:
      return "SPHC_E_MAP_VERSION";
    case SPHC_E_MAP_CHECKSUM:
      return "SPHC_E_MAP_CHECKSUM";
    case SPHC_E_MAP_EXTRACTOR:
      return "SPHC_E_MAP_EXTRACTOR";
    case SPHC_E_DEVICE:
      return "SPHC_E_DEVICE";
    case SPHC_E_DEVICE_LOST:
      return "SPHC_E_DEVICE_LOST";
    case SPHC_E_UNSUPPORTED:
      return "SPHC_E_UNSUPPORTED";
    case SPHC_E_INTERNAL:
      return "SPHC_E_INTERNAL";
    default:
      return "SPHC_?";
  }
}
