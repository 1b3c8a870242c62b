#include "host/audit/score/audit_context.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "host/audit/attack/photos.h"
#include "host/audit/attack/stacks.h"
#include "host/audit/score/layers.h"
#include "host/publish/fakes/strategy.h"
#include "host/publish/secret_random.h"
#include "runtime/map/crc32.h"

namespace sphc::host {
namespace {

constexpr SecretKey kControlKey = {1};  // of a control; hides nothing

uint32_t crcOf(const std::vector<uint8_t> &file) { return crc32(0, file.data(), file.size()); }

size_t releasesNotGivenOf(const AuditInput &input) {
  std::set<uint32_t> given = {crcOf(input.file)};
  for (const std::vector<uint8_t> &release : input.releases) given.insert(crcOf(release));
  size_t not_given = 0;
  for (const auto *releases : {&input.place->releases, &input.other_releases})
    for (const Release &release : *releases) not_given += !given.count(release.crc32);
  return not_given;
}

// The paper's fakes do not.
bool liesInStacks(const AuditInput &input) { return input.place->strategy != gaussianFakes()->name(); }

std::string bytesOf(const Descriptor &descriptor) {
  return {reinterpret_cast<const char *>(descriptor.bytes), kDescriptorBytes};
}

RealOrFakeStudy studyOf(const Published &map, const std::vector<bool> &real, const std::vector<uint32_t> &layers,
                        const std::string &networks) {
  std::vector<RealOrFakeGuess> guesses = turnedGuesses(map, real, networks);
  RealOrFakeStudy study = {scoreRealOrFake(guesses, real, layers), {}};
  const auto strongest = std::max_element(study.scores.begin(), study.scores.end() - 1,
                                          [](const auto &a, const auto &b) { return a.auc < b.auc; });
  study.strongest = std::move(guesses[static_cast<size_t>(strongest - study.scores.begin())].scores);
  return study;
}

}  // namespace

AuditContext::AuditContext(const AuditInput &input, std::function<void(double share)> progress)
    : input_(input), progress_(std::move(progress)), map_(publishedIn(input.file)) {
  if (!input.place) return;
  releases_not_given_ = releasesNotGivenOf(input);
  truth_ = truthOf(map_, *input.place);
  for (const EntryTruth &entry : truth_) real_.push_back(entry.real);
  eta_ = static_cast<double>(std::count(real_.begin(), real_.end(), true)) / static_cast<double>(real_.size());
}

const Published &AuditContext::unprotected() {
  if (unprotected_) return *unprotected_;
  unprotected_.emplace();
  for (const PlacePoint &point : input_.place->points) {
    unprotected_->directions.push_back((point.seen.position_m - input_.place->centre_m).normalized());
    unprotected_->descriptors.push_back(point.seen.descriptor);
  }
  return *unprotected_;
}

const std::vector<uint32_t> &AuditContext::stacks() {
  if (!stacks_) stacks_ = stacksOf(map_.directions);
  return *stacks_;
}

const std::vector<uint32_t> &AuditContext::layers() {
  if (!layers_) layers_ = layersOf(truth_, stacks());
  return *layers_;
}

const std::vector<std::vector<ModelPoint>> &AuditContext::photos() {
  if (photos_) return *photos_;
  std::set<std::string> mapped;
  for (const PlacePoint &point : input_.place->points) mapped.insert(bytesOf(point.seen.descriptor));
  photos_.emplace();
  for (const std::vector<ModelPoint> &frame : input_.photos.empty() ? input_.queries : input_.photos) {
    photos_->emplace_back();
    for (const ModelPoint &point : frame)
      if (!mapped.count(bytesOf(point.descriptor))) photos_->back().push_back(point);
  }
  return *photos_;
}

std::vector<std::vector<OwnPoint>> AuditContext::ownPhotos(size_t count) {
  std::vector<std::vector<OwnPoint>> own;
  for (const std::vector<ModelPoint> &photo : everyNth(photos(), count)) {
    own.emplace_back();
    for (const ModelPoint &point : photo)
      own.back().push_back({point.position_m - input_.place->centre_m, point.descriptor});
  }
  return own;
}

const PhotoMarks &AuditContext::photoMarks() {
  if (photo_marks_) return *photo_marks_;
  const auto photos = ownPhotos(kPhotos);
  photo_marks_ = {markedBy(map_, photos, Photo::kAsItIs), markedBy(map_, photos, Photo::kMirrored)};
  return *photo_marks_;
}

const RealOrFakeStudy &AuditContext::realOrFake() {
  if (!real_or_fake_)
    real_or_fake_ =
        studyOf(map_, real_, liesInStacks(input_) ? layers() : std::vector<uint32_t>(), input_.networks);
  return *real_or_fake_;
}

const PaperControl &AuditContext::paper() {
  if (paper_) return *paper_;
  std::vector<SpherePoint> points;
  for (size_t i = 0; i < unprotected().directions.size(); ++i)
    points.push_back({unprotected().directions[i], unprotected().descriptors[i]});
  SecretRandom random(kControlKey);
  shuffle(&points, &random);
  // As build rounds; the share of one point may come out a little too small.
  const size_t real_count = std::max(size_t{1}, static_cast<size_t>(eta_ * static_cast<double>(points.size())));
  paper_ = PaperControl{knownCloud(gaussianFakes()->assignments(points, real_count, &random)), {}};
  paper_->study = studyOf(paper_->cloud.published, paper_->cloud.real, {}, input_.networks);
  return *paper_;
}

}  // namespace sphc::host
