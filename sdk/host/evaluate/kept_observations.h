// What became of the keypoints of each frame of a run.  A report shows them of a few frames, and only at the end of
// a run is it known of which.
#pragma once
#include <spherecloud/spherecloud.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace sphc::host {

// In a file that has no name, in the folder for temporary files ($TMPDIR): a long run has more than memory should
// hold.
class KeptObservations {
 public:
  // Throws std::runtime_error with cause and cure, as do the others.
  KeptObservations();

  // Of the next frame.
  void add(const sphc_localizer_observation *observations, size_t count);
  // Of a frame, by the place in which it was added.
  std::vector<sphc_localizer_observation> of(size_t frame);

 private:
  struct Closer {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(const std::string &doing) const;

  std::string folder_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<uint64_t> starts_ = {0};  // of each frame, and of what comes next: observations before it
};

}  // namespace sphc::host
