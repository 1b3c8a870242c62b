// What a Matroska file (RFC 9559) holds, as far as recordings of depth cameras need it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/recording/foreign/ebml.h"

namespace sphc::recording {

constexpr std::string_view kMatroskaMagic = "\x1A\x45\xDF\xA3";

struct MatroskaBlock {
  int64_t time_ns;        // of its first frame
  uint64_t start, bytes;  // of its frame, in the file; of several with their sizes in front
  uint32_t frame_count;
};

struct MatroskaTrack {
  std::string name, codec;
  std::string fourcc;  // of the codec V_MS/VFW/FOURCC
  uint32_t width = 0, height = 0;
  bool is_encoded = false;            // compressed or encrypted once more
  std::vector<MatroskaBlock> blocks;  // in the order of the file
};

struct MatroskaFile {
  std::map<uint64_t, MatroskaTrack> tracks;        // by number
  std::map<std::string, EbmlElement> attachments;  // by name: where their bytes are
  std::map<std::string, std::string> tags;         // of any target; of equal names the first counts
  uint64_t lost_count = 0;                         // blocks that are none here
  bool is_cut = false;
};

// Reads the whole file but its images.  Throws Failure with the name when it is no Matroska file.
MatroskaFile readMatroska(const std::filesystem::path &path);

}  // namespace sphc::recording
