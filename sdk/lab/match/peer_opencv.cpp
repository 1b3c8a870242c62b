#include "lab/match/variant.h"

#if SPHC_HAVE_OPENCV_FEATURES2D
#include <opencv2/features2d.hpp>
#endif

namespace sphc::host {

#if SPHC_HAVE_OPENCV_FEATURES2D
namespace {

constexpr int kChecks[] = {32, 128, 512};
constexpr size_t kLargestExact = 200000;  // beyond that it takes too long to wait for

cv::Mat floats(const Descriptor *rows, size_t count) {
  cv::Mat result;
  cv::Mat(static_cast<int>(count), kDescriptorBytes, CV_8U, const_cast<Descriptor *>(rows))
      .convertTo(result, CV_32F);
  return result;
}

class OpenCvSearch : public MatchSearch {
 public:
  OpenCvSearch(const MatchCase &c, cv::Ptr<cv::DescriptorMatcher> matcher)
      : matcher_(std::move(matcher)), queries_(floats(c.queries.data(), c.queries.size())) {
    cv::setNumThreads(1);
    matcher_->add(floats(c.map.descriptors().data(), c.map.pointCount()));
    matcher_->train();
  }
  double seconds() override {
    found_.clear();  // FLANN's appends
    const double begin = cpuSeconds();
    matcher_->knnMatch(queries_, found_, 2);
    return cpuSeconds() - begin;
  }
  std::vector<TopTwo> answer() override {
    seconds();
    std::vector<TopTwo> answer(found_.size());
    for (size_t q = 0; q < found_.size(); ++q)
      if (found_[q].size() == 2)
        answer[q] = {found_[q][0].trainIdx, static_cast<double>(found_[q][0].distance),
                     static_cast<double>(found_[q][1].distance)};
    return answer;
  }

 private:
  cv::Ptr<cv::DescriptorMatcher> matcher_;
  cv::Mat queries_;
  std::vector<std::vector<cv::DMatch>> found_;
};

MatchVariant peer(const std::string &name, size_t largest_map,
                  const std::function<cv::Ptr<cv::DescriptorMatcher>()> &make) {
  MatchVariant variant;
  variant.name = name;
  variant.largest_map = largest_map;
  variant.prepare = [make](const MatchCase &c) { return std::make_unique<OpenCvSearch>(c, make()); };
  return variant;
}

}  // namespace

std::vector<MatchVariant> openCvMatchPeers() {
  std::vector<MatchVariant> peers = {
      peer("opencv brute force", kLargestExact, [] { return cv::BFMatcher::create(cv::NORM_L2); })};
  for (const int checks : kChecks)
    peers.push_back(peer("opencv flann, " + std::to_string(checks) + " checks", SIZE_MAX, [checks] {
      return cv::makePtr<cv::FlannBasedMatcher>(cv::makePtr<cv::flann::KDTreeIndexParams>(4),
                                                cv::makePtr<cv::flann::SearchParams>(checks));
    }));
  return peers;
}

#else

std::vector<MatchVariant> openCvMatchPeers() {
  MatchVariant absent;
  absent.name = "opencv matchers";
  absent.absent = "not built in: apt-get install libopencv-features2d-dev and build again";
  return {absent};
}

#endif

}  // namespace sphc::host
