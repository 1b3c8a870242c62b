#include "host/cli/common/band_option.h"

#include <map>

#include "host/report/run.h"

namespace sphc::host {

CLI::Option *addBandOption(CLI::App *app, sphc_band *band, const char *text) {
  std::map<std::string, sphc_band> bands;
  for (sphc_band one : {SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED}) bands[bandName(one)] = one;
  return app->add_option("--band", *band, text)
      ->transform(CLI::CheckedTransformer(bands).description(""))
      ->default_str(bandName(*band))
      ->type_name("visible|infrared");
}

}  // namespace sphc::host
