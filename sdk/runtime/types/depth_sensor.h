// What is known of the depth sensor's measurements.
#pragma once

namespace sphc {

struct DepthSensor {
  double unit_m;        // metres per unit of the image
  double min_m, max_m;  // measurements outside are ignored
  double sigma_m;       // noise: sigma(z) = sigma_m + sigma_per_m2 z^2
  double sigma_per_m2;

  double sigmaAt(double z_m) const { return sigma_m + sigma_per_m2 * z_m * z_m; }
};

}  // namespace sphc
