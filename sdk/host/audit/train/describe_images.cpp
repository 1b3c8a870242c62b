// describe_images LIST OUT: what the device's feature stage finds in each grey image whose path LIST names.
// OUT, little-endian, an image after the other: uint32 count, count times float32 x, y in px, count times 128
// bytes.
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "host/audit/train/output.h"
#include "host/frames/frame_features.h"
#include "host/import/rgbd_import.h"

namespace sphc::host {
namespace {

void describe(const std::string &path, std::ostream *out) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw std::runtime_error(path + " is no image that OpenCV reads");
  FrameFeatures features(image.cols, image.rows, RgbdImportOptions().max_keypoints);
  features.extract({image.data, image.cols, image.rows, static_cast<int32_t>(image.step)});
  writeValue(features.count(), out);
  for (uint32_t i = 0; i < features.count(); ++i) {
    writeValue(features.keypoint(i).x_px, out);
    writeValue(features.keypoint(i).y_px, out);
  }
  for (uint32_t i = 0; i < features.count(); ++i) writeValue(features.descriptor(i), out);
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  if (argc != 3) {
    std::cerr << "usage: describe_images LIST OUT\n";
    return 2;
  }
  try {
    std::ifstream list(argv[1]);
    std::ofstream out(argv[2], std::ios::binary);
    for (std::string path; std::getline(list, path);) sphc::host::describe(path, &out);
    if (!out.flush()) throw std::runtime_error(std::string(argv[2]) + " cannot be written; is the disk full?");
  } catch (const std::exception &failure) {
    std::cerr << "describe_images: " << failure.what() << '\n';
    return 1;
  }
  return 0;
}
