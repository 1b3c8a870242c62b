// The parameters of a search, as the command's options set them.
#pragma once
#include <spherecloud/spherecloud.hpp>

namespace sphc::host {

// What it is where nobody sets it.
double initialValue(sphc_localizer_parameter parameter);

struct Parameters {
  double max_ratio = initialValue(SPHC_PARAMETER_MAX_RATIO);
  double probes = initialValue(SPHC_PARAMETER_PROBES);
  double max_iterations = initialValue(SPHC_PARAMETER_MAX_ITERATIONS);
  double min_inliers = initialValue(SPHC_PARAMETER_MIN_INLIERS);

  spherecloud::Status setOn(spherecloud::Localizer *localizer) const;
};

}  // namespace sphc::host
