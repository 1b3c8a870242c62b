#include "host/recording/foreign/exr_depth.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <new>
#include <vector>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/ros_images.h"

namespace sphc::recording {

namespace {

// The bytes as a stream of OpenEXR's, which reads no further than they go.
class ExrStream : public Imf::IStream {
 public:
  explicit ExrStream(ByteView bytes) : Imf::IStream("depth"), bytes_(bytes) {}

  bool read(char out[], int count) override {
    if (count < 0 || static_cast<uint64_t>(count) > bytes_.size - at_)
      throw std::runtime_error("ends early; copy it again");
    std::copy_n(bytes_.data + at_, count, out);
    at_ += static_cast<uint64_t>(count);
    return at_ < bytes_.size;
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t position) override { at_ = std::min<uint64_t>(position, bytes_.size); }

 private:
  ByteView bytes_;
  uint64_t at_ = 0;
};

[[noreturn]] void failExr(const char *why) {
  throw Failure(SPHC_E_DEVICE, std::string("cannot be decoded as OpenEXR (") + why + "); copy the file again");
}

// What OpenEXR throws is a std::exception of its own.
template <typename Action>
auto withExr(ByteView bytes, Action &&action) {
  try {
    ExrStream stream(bytes);
    Imf::InputFile file(stream, 0);
    return action(file);
  } catch (const Failure &) {
    throw;
  } catch (const std::bad_alloc &) {
    throw;
  } catch (const std::exception &error) {
    failExr(error.what());
  }
}

ImageSize sizeOfWindow(const Imf::InputFile &file) {
  const Imath::Box2i window = file.header().dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > SPHC_CAMERA_MAX_PX || height > SPHC_CAMERA_MAX_PX) failExr("its size");
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

const char *depthChannel(const Imf::ChannelList &channels) {
  if (channels.findChannel("R")) return "R";
  auto second = channels.begin();
  const auto first = second;
  if (first == channels.end() || ++second != channels.end()) failExr("neither one channel nor R");
  return first.name();
}

}  // namespace

ImageSize exrSizeOf(ByteView file) {
  return withExr(file, [](const Imf::InputFile &exr) { return sizeOfWindow(exr); });
}

void decodeExrDepth(ByteView file, const sphc_camera &camera, uint16_t *depth_mm) {
  withExr(file, [&](Imf::InputFile &exr) {
    const ImageSize size = sizeOfWindow(exr);
    requireSize(size.width, size.height, camera, false);
    const Imath::Box2i window = exr.header().dataWindow();
    std::vector<float> depth_m(size_t{size.width} * size.height);
    // OpenEXR counts from the origin of its window, which may be anywhere.
    Imf::FrameBuffer frame;
    frame.insert(depthChannel(exr.header().channels()),
                 Imf::Slice::Make(Imf::FLOAT, depth_m.data(), window, sizeof(float), sizeof(float) * size.width));
    exr.setFrameBuffer(frame);
    exr.readPixels(window.min.y, window.max.y);
    std::transform(depth_m.begin(), depth_m.end(), depth_mm, millimetresOf);
  });
}

}  // namespace sphc::recording
