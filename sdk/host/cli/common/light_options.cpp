#include "host/cli/common/light_options.h"

#include <utility>
#include <vector>

#include "host/cli/common/choices.h"
#include "host/cli/common/number_checks.h"
#include "host/report/run.h"

namespace sphc::host {

CLI::Option *addBandOption(CLI::App *app, sphc_band *band, const char *text) {
  std::vector<std::pair<std::string, sphc_band>> bands;
  for (sphc_band one : {SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED}) bands.emplace_back(bandName(one), one);
  return app->add_option("--band", *band, text)
      ->transform(oneOf(bands))
      ->default_str(bandName(*band))
      ->type_name("visible|infrared");
}

CLI::Option *addAmplitudeOption(CLI::App *app, uint32_t *amplitude_min) {
  return app
      ->add_option(
          "--amplitude-min", *amplitude_min,
          "Depth is ignored where the sensor saw less of its own light, and between two surfaces; 0: all is "
          "believed")
      ->capture_default_str()
      ->transform(wholeFrom(0, 65535))
      ->type_name("N");
}

CLI::Option *addRowTimeOption(CLI::App *app, int64_t *row_time_ns, const std::string &behind) {
  return app
      ->add_option("--row-time-ns", *row_time_ns,
                   "Rolling shutter: nanoseconds from a row of colour to the row below it, either sign;\n" + behind)
      ->capture_default_str()
      ->transform(wholeBetween(-SPHC_ROW_TIME_MAX_NS, SPHC_ROW_TIME_MAX_NS))
      ->type_name("NS");
}

}  // namespace sphc::host
