// describe_images LIST OUT: what the device's feature stage finds in each grey image whose path LIST names.
// OUT, little-endian, an image after the other: uint32 count, count times float32 x, y in px, count times 128
// bytes.
#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "host/frames/frame_features.h"
#include "host/import/rgbd_import.h"
#include "lab/train/plain_values.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

void describe(const std::string &path, std::ostream *out) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw std::runtime_error(path + " is no image that OpenCV reads");
  FrameFeatures features(image.cols, image.rows, RgbdImportOptions().max_keypoints);
  features.extract({image.data, image.cols, image.rows, static_cast<int32_t>(image.step)});
  writePlain(features.count(), out);
  for (uint32_t i = 0; i < features.count(); ++i) {
    writePlain(features.keypoint(i).x_px, out);
    writePlain(features.keypoint(i).y_px, out);
  }
  for (uint32_t i = 0; i < features.count(); ++i) writePlain(features.descriptor(i), out);
}

void run(char **arguments) {
  std::ifstream list(arguments[1]);
  std::ofstream out(arguments[2], std::ios::binary);
  for (std::string path; std::getline(list, path);) describe(path, &out);
  if (!out.flush()) throw std::runtime_error(std::string(arguments[2]) + " cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("describe_images LIST OUT", argc == 3, [&] { sphc::host::run(argv); });
}
