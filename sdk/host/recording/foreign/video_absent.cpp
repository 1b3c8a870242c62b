// In place of video.cpp where libavformat is not installed.
#include "host/recording/failure.h"
#include "host/recording/foreign/video.h"

namespace sphc::recording {

struct Video::Decoder {};

Video::Video(const std::filesystem::path &file) {
  throw Failure(SPHC_E_UNSUPPORTED, shortPath(file.string()) +
                                        ": this build reads no video; install libavformat-dev and libswscale-dev "
                                        "and build again, or put its frames "
                                        "beside it as images: docs/imports.md has the command");
}

Video::~Video() = default;
Video::Video(Video &&) noexcept = default;
uint32_t Video::width() const { return 0; }
uint32_t Video::height() const { return 0; }
uint32_t Video::frameCount() const { return 0; }
sphc_image Video::read(uint32_t) { return {}; }

}  // namespace sphc::recording
