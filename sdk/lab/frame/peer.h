// Package peers of the whole frame (OpenCV, faiss, hnswlib), in one Python process.  They work on an open point map
// of the same place: true 3D points with their own descriptors, nothing hidden.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "lab/frame/variant.h"

namespace sphc::host {

class FramePeers {
 public:
  // A Python that is not there, and packages that it lacks, show as absent variants.
  explicit FramePeers(const std::string &python);

  // All that there are, absent ones too; those present run once `index` was called.
  const std::vector<FrameVariant> &variants() const { return variants_; }

  // Names and versions of the packages that are there.
  const std::string &packages() const { return packages_; }

  // Cameras and depth range of `config`; `chosen` are the names of the variants to prepare.
  // The following throw std::runtime_error with cause and cure.
  void begin(const sphc_localizer_config &config, const std::vector<std::string> &chosen);
  // One of the frames that the map is made of.
  void addMappingFrame(const sphc_localizer_frame &frame, const Rigid &world_from_camera);
  // Makes the maps and indexes of so many points; gives how many of them are of the place itself, the fewest of
  // all.
  uint32_t index(uint32_t points);

 private:
  struct Conversation;

  std::vector<FrameVariant> variants_;
  std::string packages_;
  std::shared_ptr<Conversation> conversation_;
  std::vector<uint32_t> chosen_;
};

}  // namespace sphc::host
