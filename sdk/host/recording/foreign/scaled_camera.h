// Depth that an app has laid on the colour image: one camera in two sizes.
#pragma once

#include <spherecloud/spherecloud.h>

#include <array>
#include <string>

#include "host/recording/image_header.h"

namespace sphc::recording {

// `params`: fx, fy, cx, cy in pixels of the colour image, its corner at (0, 0).  Depth is of the same view in
// another size, in millimetres.  Throws Failure that begins with `name` when the shapes differ or sphc_rig_check
// refuses.
sphc_rig oneCameraRig(const std::array<double, 4> &params, const ImageSize &color, const ImageSize &depth,
                      const std::string &name);

}  // namespace sphc::recording
