// The images of a layout that keeps them in a way of its own: in a video, beside a confidence, as floats.
#pragma once

#include <spherecloud/spherecloud_capture.h>

#include <functional>
#include <memory>

namespace sphc::recording {

struct RecordedImage;

class LayoutImages {
 public:
  virtual ~LayoutImages() = default;
  // Fills `pixels` with an image of the camera's size: DEPTH16, or colour in `format`.  Throws Failure without a
  // name, as decodeImage does.
  virtual void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
                    uint8_t *pixels) = 0;
  // Likewise the amplitudes of a depth image that has a place of them, as GRAY16.
  virtual void readAmplitude(const RecordedImage &, const sphc_camera &, uint16_t *) {}
};

// Each reader of a recording has its own, since they remember where they are.
using LayoutImagesMaker = std::function<std::unique_ptr<LayoutImages>()>;

}  // namespace sphc::recording
