#include "spherecloud/spherecloud.h"

#define SPHC_TEXT2(x) #x
#define SPHC_TEXT(x) SPHC_TEXT2(x)

uint32_t sphc_abi(void) { return SPHC_ABI; }

const char *sphc_version_string(void) {
  return SPHC_TEXT(SPHC_VERSION_MAJOR) "." SPHC_TEXT(SPHC_VERSION_MINOR) "." SPHC_TEXT(SPHC_VERSION_PATCH);
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

const char *sphc_fault_name(uint32_t fault) {
  switch (fault) {
    case SPHC_FAULT_DEPTH_RANGE:
      return "SPHC_FAULT_DEPTH_RANGE";
    case SPHC_FAULT_DEPTH_CONSTANT:
      return "SPHC_FAULT_DEPTH_CONSTANT";
    case SPHC_FAULT_DEPTH_BENT:
      return "SPHC_FAULT_DEPTH_BENT";
    case SPHC_FAULT_DEPTH_FROZEN:
      return "SPHC_FAULT_DEPTH_FROZEN";
    case SPHC_FAULT_COLOR_FROZEN:
      return "SPHC_FAULT_COLOR_FROZEN";
    case SPHC_FAULT_DEPTH_COLOR_DISAGREE:
      return "SPHC_FAULT_DEPTH_COLOR_DISAGREE";
    case SPHC_FAULT_DEPTH_SCALE:
      return "SPHC_FAULT_DEPTH_SCALE";
    case SPHC_FAULT_DEPTH_BIAS:
      return "SPHC_FAULT_DEPTH_BIAS";
    case SPHC_FAULT_VERTICAL_DISAGREES:
      return "SPHC_FAULT_VERTICAL_DISAGREES";
    default:
      return "SPHC_FAULT_?";
  }
}

const char *sphc_cut_name(uint32_t cut) {
  switch (cut) {
    case SPHC_CUT_FEATURES:
      return "SPHC_CUT_FEATURES";
    case SPHC_CUT_MATCHES:
      return "SPHC_CUT_MATCHES";
    case SPHC_CUT_SEARCH:
      return "SPHC_CUT_SEARCH";
    case SPHC_CUT_VERIFICATION:
      return "SPHC_CUT_VERIFICATION";
    default:
      return "SPHC_CUT_?";
  }
}

const char *sphc_hint_name(uint32_t hint) {
  switch (hint) {
    case SPHC_HINT_TOO_DARK:
      return "SPHC_HINT_TOO_DARK";
    case SPHC_HINT_TOO_FAST:
      return "SPHC_HINT_TOO_FAST";
    case SPHC_HINT_TOO_PLAIN:
      return "SPHC_HINT_TOO_PLAIN";
    case SPHC_HINT_NO_DEPTH_IN_RANGE:
      return "SPHC_HINT_NO_DEPTH_IN_RANGE";
    case SPHC_HINT_NOT_IN_MAP:
      return "SPHC_HINT_NOT_IN_MAP";
    case SPHC_HINT_AMBIGUOUS:
      return "SPHC_HINT_AMBIGUOUS";
    default:
      return "SPHC_HINT_?";
  }
}
