#include "host/evaluate/parameters.h"

#include <utility>

namespace sphc::host {

double initialValue(sphc_localizer_parameter parameter) {
  sphc_localizer_parameter_range range = {};
  range.struct_size = sizeof range;
  spherecloud::Status(sphc_localizer_get_parameter_range(parameter, &range)).orThrow();
  return range.initial;
}

spherecloud::Status Parameters::setOn(spherecloud::Localizer *localizer) const {
  const std::pair<sphc_localizer_parameter, double> all[] = {{SPHC_PARAMETER_MAX_RATIO, max_ratio},
                                                             {SPHC_PARAMETER_PROBES, probes},
                                                             {SPHC_PARAMETER_MAX_ITERATIONS, max_iterations},
                                                             {SPHC_PARAMETER_MIN_INLIERS, min_inliers}};
  spherecloud::Status status;
  for (const auto &[parameter, value] : all)
    if (status.ok()) status = localizer->setParameter(parameter, value);
  return status;
}

}  // namespace sphc::host
