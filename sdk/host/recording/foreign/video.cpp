#include "host/recording/foreign/video.h"

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "host/recording/failure.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

namespace {

// FFmpeg goes by the bytes, and a list of other files is a video to it: only MP4 gets there.
void requireMp4(const std::filesystem::path &path) {
  const File file(path);
  char head[12] = {};
  if (file.size() >= sizeof head) file.read(0, reinterpret_cast<uint8_t *>(head), sizeof head);
  if (std::string_view(head + 4, 4) != "ftyp")
    throw Failure(SPHC_E_DEVICE, file.name() + ": is no MP4 file; copy it again");
}

uint32_t property(const cv::VideoCapture &capture, int id, double most) {
  const double value = capture.get(id);
  return value >= 1 && value <= most ? static_cast<uint32_t>(value) : 0;
}

}  // namespace

struct Video::Decoder {
  void open() {
    next = 0;
    // By FFmpeg alone, and by a path from the root: a name may hold what others take for a pattern or an address.
    if (!capture.open(path, cv::CAP_FFMPEG))
      throw Failure(SPHC_E_DEVICE, shortPath(path) + ": cannot be decoded; copy the video again");
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
  }

  std::string path;
  cv::VideoCapture capture;
  cv::Mat frame;
  uint32_t next = 0, width = 0, height = 0, count = 0;
};

Video::Video(const std::filesystem::path &file) : decoder_(std::make_unique<Decoder>()) {
  requireMp4(file);
  decoder_->path = std::filesystem::absolute(file).string();
  decoder_->open();
  decoder_->width = property(decoder_->capture, cv::CAP_PROP_FRAME_WIDTH, SPHC_CAMERA_MAX_PX);
  decoder_->height = property(decoder_->capture, cv::CAP_PROP_FRAME_HEIGHT, SPHC_CAMERA_MAX_PX);
  decoder_->count = property(decoder_->capture, cv::CAP_PROP_FRAME_COUNT, 1e9);
  if (!decoder_->width || !decoder_->height || !decoder_->count)
    throw Failure(SPHC_E_DEVICE, shortPath(decoder_->path) + ": holds no frames of up to " +
                                     std::to_string(SPHC_CAMERA_MAX_PX) + " pixels a side; copy the video again");
}

Video::~Video() = default;
Video::Video(Video &&) noexcept = default;

uint32_t Video::width() const { return decoder_->width; }
uint32_t Video::height() const { return decoder_->height; }
uint32_t Video::frameCount() const { return decoder_->count; }

sphc_image Video::read(uint32_t index) {
  Decoder &video = *decoder_;
  if (index < video.next) video.open();
  bool is_there = true;
  for (; is_there && video.next < index; ++video.next) is_there = video.capture.grab();
  is_there = is_there && video.capture.read(video.frame) && video.frame.type() == CV_8UC3;
  ++video.next;
  if (!is_there)
    throw Failure(SPHC_E_DEVICE, "cannot be decoded: the video ends or is damaged before it; copy it again");
  return {video.frame.data, static_cast<uint32_t>(video.frame.cols), static_cast<uint32_t>(video.frame.rows),
          static_cast<uint32_t>(video.frame.step), SPHC_FORMAT_BGR8};
}

}  // namespace sphc::recording
