// Frames through a localizer; what it answers as bytes that can be compared.
#pragma once

#include <spherecloud/spherecloud.hpp>

#include "recorded.h"

namespace sphc::guest {

class PoseLog {
 public:
  explicit PoseLog(const std::string &folder) {
    spherecloud::readFile((folder + kMapFile).c_str(), &file_).orThrow();
    spherecloud::Map::open(file_.data(), file_.size(), &map_).orThrow();
    sphc_localizer_config config = spherecloud::defaultConfig();
    config.rig = readCameras(folder).rig;
    spherecloud::Localizer::make(config, map_, &localizer_).orThrow();
  }

  // Without a clock the times of the stages are 0, so that equal frames give equal bytes.
  void add(const sphc_localizer_frame &frame) {
    sphc_localizer_result result = spherecloud::emptyResult();
    localizer_.process(frame, &result).orThrow();
    results_.push_back(result);
    localized_ += result.outcome == SPHC_OUTCOME_LOCALIZED;
  }

  const sphc_localizer_result *results() const { return results_.data(); }
  const void *data() const { return results_.data(); }
  size_t bytes() const { return results_.size() * sizeof(sphc_localizer_result); }
  uint32_t localized() const { return localized_; }

 private:
  spherecloud::AlignedBuffer file_;
  spherecloud::Map map_;
  spherecloud::Localizer localizer_;
  std::vector<sphc_localizer_result> results_;
  uint32_t localized_ = 0;
};

}  // namespace sphc::guest
