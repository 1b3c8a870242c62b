// The parameters of a search by their ids.
#pragma once
#include "runtime/localizer/config.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// UNSUPPORTED for an id that is not known; the others need one that is.
sphc_status checkParameter(sphc_localizer_parameter parameter, sphc_message *message);
sphc_localizer_parameter_range rangeOf(sphc_localizer_parameter parameter);
double valueOf(const SearchParameters &parameters, sphc_localizer_parameter parameter);
// ARGUMENT for a value out of range; *parameters is then as it was.
sphc_status setValue(sphc_localizer_parameter parameter, double value, SearchParameters *parameters,
                     sphc_message *message);

}  // namespace sphc
