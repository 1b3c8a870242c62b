#include "runtime/capi/parameters.h"

#include "runtime/base/message.h"
#include "runtime/localizer/localizer.h"

namespace sphc {

sphc_status checkParameter(sphc_localizer_parameter parameter, sphc_message *message) {
  switch (parameter) {
    case SPHC_PARAMETER_MAX_RATIO:
    case SPHC_PARAMETER_PROBES:
    case SPHC_PARAMETER_MAX_ITERATIONS:
    case SPHC_PARAMETER_MIN_INLIERS:
      return SPHC_OK;
    default:
      MessageWriter(message) << "parameter " << parameter << " is none that " << sphc_version_string()
                             << " knows; leave it, or use another library";
      return SPHC_E_UNSUPPORTED;
  }
}

sphc_localizer_parameter_range rangeOf(sphc_localizer_parameter parameter) {
  sphc_localizer_parameter_range range = {};
  range.struct_size = sizeof range;
  range.initial = valueOf(SearchParameters(), parameter);
  range.whole = parameter != SPHC_PARAMETER_MAX_RATIO;
  switch (parameter) {
    case SPHC_PARAMETER_MAX_RATIO:
      range.lowest = 0.1, range.highest = 1;
      break;
    case SPHC_PARAMETER_PROBES:
      range.lowest = 0, range.highest = Localizer::kMostProbes;
      break;
    case SPHC_PARAMETER_MAX_ITERATIONS:
      range.lowest = 1, range.highest = 1e6;
      break;
    default:
      range.lowest = 4, range.highest = 4096;
  }
  return range;
}

double valueOf(const SearchParameters &parameters, sphc_localizer_parameter parameter) {
  switch (parameter) {
    case SPHC_PARAMETER_MAX_RATIO:
      return parameters.max_ratio;
    case SPHC_PARAMETER_PROBES:
      return parameters.probes;
    case SPHC_PARAMETER_MAX_ITERATIONS:
      return parameters.max_iterations;
    default:
      return parameters.min_inliers;
  }
}

sphc_status setValue(sphc_localizer_parameter parameter, double value, SearchParameters *parameters,
                     sphc_message *message) {
  const sphc_localizer_parameter_range range = rangeOf(parameter);
  const bool in_range = value >= range.lowest && value <= range.highest;
  const auto whole = static_cast<uint32_t>(in_range ? value : 0);
  if (!in_range || (range.whole && static_cast<double>(whole) != value)) {
    MessageWriter(message) << sphc_localizer_parameter_name(parameter) << " is " << value << "; it must be "
                           << (range.whole ? "a whole number of " : "in ") << range.lowest << " to "
                           << range.highest;
    return SPHC_E_ARGUMENT;
  }
  switch (parameter) {
    case SPHC_PARAMETER_MAX_RATIO:
      parameters->max_ratio = value;
      break;
    case SPHC_PARAMETER_PROBES:
      parameters->probes = whole;
      break;
    case SPHC_PARAMETER_MAX_ITERATIONS:
      parameters->max_iterations = whole;
      break;
    default:
      parameters->min_inliers = whole;
  }
  return SPHC_OK;
}

}  // namespace sphc
