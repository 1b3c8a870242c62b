#include "lab/common/interleave.h"
#include "lab/features/variant.h"

#if SPHC_HAVE_OPENCV_FEATURES2D
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#endif

namespace sphc::host {

const char kOpenCvSiftName[] = "opencv sift 1000";

#if SPHC_HAVE_OPENCV_FEATURES2D
namespace {

constexpr uint32_t kSiftBytes = 128, kOrbBytes = 32;
constexpr double kPixelCenter = 0.5;

cv::Mat wrap(const GrayView &image) {
  return cv::Mat(image.height, image.width, CV_8U, const_cast<uint8_t *>(image.data),
                 static_cast<size_t>(image.stride));
}

// `shrink` 2: on the image at half its size.
FoundFeatures extract(const cv::Ptr<cv::Feature2D> &extractor, const GrayView &image, int shrink) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors, input = wrap(image);
  FoundFeatures found;
  const double begin = threadCpuSeconds();
  if (shrink > 1) {
    cv::Mat smaller;
    cv::resize(input, smaller, {}, 1.0 / shrink, 1.0 / shrink, cv::INTER_AREA);
    input = smaller;
  }
  extractor->detectAndCompute(input, cv::noArray(), keypoints, descriptors);
  found.seconds = threadCpuSeconds() - begin;
  for (const cv::KeyPoint &k : keypoints) {
    found.pixels_px.emplace_back(shrink * (static_cast<double>(k.pt.x) + kPixelCenter),
                                 shrink * (static_cast<double>(k.pt.y) + kPixelCenter));
  }
  for (int i = 0; i < descriptors.rows; ++i) {
    if (descriptors.type() == CV_32F) {
      appendRootSift(descriptors.ptr<float>(i), &found.descriptors);
    } else {
      const uint8_t *row = descriptors.ptr<uint8_t>(i);
      found.descriptors.insert(found.descriptors.end(), row, row + descriptors.cols);
    }
  }
  return found;
}

FeaturesVariant sift(const std::string &name, int count, int shrink) {
  const cv::Ptr<cv::Feature2D> sift = cv::SIFT::create(count);
  return {name, kSiftBytes, false, [=](const GrayView &image) { return extract(sift, image, shrink); }, ""};
}

}  // namespace

std::vector<FeaturesVariant> openCvFeatures() {
  cv::setNumThreads(1);
  const cv::Ptr<cv::Feature2D> orb = cv::ORB::create(1000);
  return {sift("opencv sift 800", 800, 1),
          sift(kOpenCvSiftName, 1000, 1),
          sift("opencv sift 1000, half size", 1000, 2),
          {"opencv orb 1000", kOrbBytes, true, [=](const GrayView &image) { return extract(orb, image, 1); }, ""}};
}

#else

std::vector<FeaturesVariant> openCvFeatures() {
  return {{"opencv", 0, false, nullptr,
           "built without OpenCV's features2d: apt-get install libopencv-dev, build again"}};
}

#endif

}  // namespace sphc::host
