#include "host/evaluate/kept_observations.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace sphc::host {
namespace {

constexpr size_t kBytes = sizeof(sphc_localizer_observation);

}  // namespace

KeptObservations::KeptObservations() {
  std::error_code absent;
  folder_ = std::filesystem::temp_directory_path(absent).string();
  errno = absent.value();
  if (absent) fail("kept");
  std::string name = folder_ + "/spherecloud-XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) fail("kept");
  unlink(name.c_str());
  file_.reset(fdopen(file, "w+b"));
  if (!file_) fail("kept");
}

void KeptObservations::fail(const std::string &doing) const {
  throw std::runtime_error("the keypoints of frames, for the report, cannot be " + doing + " in a file in " +
                           (folder_.empty() ? "TMPDIR" : folder_) + ": " + std::strerror(errno) +
                           "; make room there, or let TMPDIR name another folder");
}

void KeptObservations::add(const sphc_localizer_observation *observations, size_t count) {
  if (std::fwrite(observations, kBytes, count, file_.get()) != count) fail("kept");
  starts_.push_back(starts_.back() + count);
}

std::vector<sphc_localizer_observation> KeptObservations::of(size_t frame) {
  std::vector<sphc_localizer_observation> observations(starts_.at(frame + 1) - starts_.at(frame));
  if (fseeko(file_.get(), static_cast<off_t>(kBytes * starts_[frame]), SEEK_SET) != 0 ||
      std::fread(observations.data(), kBytes, observations.size(), file_.get()) != observations.size())
    fail("read again");
  return observations;
}

}  // namespace sphc::host
