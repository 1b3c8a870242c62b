#include "host/advise/advice.h"

#include <algorithm>

#include "host/base/counted.h"
#include "host/evaluate/localize_run.h"
#include "host/publish/release.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr size_t kMostHoles = 6;
constexpr SecretKey kKey = {};  // these maps never leave this process; the same advice each time

// Indices of frames; numbers of the recording may come twice.
struct Block {
  uint32_t first, last;

  bool holds(uint32_t index) const { return index >= first && index <= last; }
};

std::vector<uint32_t> framesWithPose(const RecordingReader &reader) {
  std::vector<uint32_t> posed;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    if (reader.worldFromCamera(i)) posed.push_back(i);
  return posed;
}

// Before minutes of mapping; of no pose at all the import tells more.
void checkFolds(size_t posed, uint32_t folds) {
  if (posed > 0 && posed < size_t{2} * folds)
    throw std::runtime_error("the recording has " + counted(posed, "frame") + " with a pose, too few for " +
                             std::to_string(folds) + " folds of two; record more, or give fewer --folds");
}

// Of the frames that have a pose: a block that had all of them would leave none for the map.
std::vector<Block> blocksOf(const std::vector<uint32_t> &posed, uint32_t folds) {
  std::vector<Block> blocks;
  for (size_t k = 0; k < folds; ++k)
    blocks.push_back({posed[k * posed.size() / folds], posed[(k + 1) * posed.size() / folds - 1]});
  return blocks;
}

std::string whyFailed(const FrameRecord &frame) {
  const std::string counts = std::to_string(frame.keypoints) + " keypoints, " + std::to_string(frame.lifted) +
                             " with depth, " + std::to_string(frame.matches) + " matches";
  if (frame.localized) return "localized " + fixed(100 * frame.translation_error_m, 0) + " cm off (" + counts + ")";
  return std::string(outcomeName(frame.outcome)) + " (" + counts + ")";
}

// The map of the others, as it would be released.  Whoever hears that there are too few points must know in which.
NewRelease releaseWithout(const Block &block, const RecordingReader &reader, const PointModel &others, double eta) {
  ReleaseRequest request;
  request.key = kKey;
  request.eta = eta;
  try {
    return makeRelease(others, request);
  } catch (const std::runtime_error &error) {
    const auto number = [&](uint32_t index) { return std::to_string(reader.colorOf(index).sequence); };
    throw std::runtime_error("the map without frames " + number(block.first) + " to " + number(block.last) +
                             ", a fold that is held out: " + error.what() +
                             ", or give more --folds, so that each holds out less");
  }
}

// One block against the map of the others, eta by eta.
class Trial {
 public:
  Trial(const AdviceOptions &options, RecordingReader *reader, const Block &held_out) {
    input_.reader = reader;
    input_.takes_part = [held_out](uint32_t index) { return held_out.holds(index); };
    input_.config = spherecloud::defaultConfig();
    input_.config.mode = SPHC_MODE_SINGLE;
    input_.config.depth_min_m = options.import.depth_min_m;
    input_.config.depth_max_m = options.import.depth_max_m;
    setCameras(reader->calibration(), &input_.config);
  }

  // Those that cannot be read are not among them; the import of all frames has told of these.
  std::vector<FrameRecord> frames(const NewRelease &made) {
    input_.maps.clear();
    input_.maps.push_back(openMapBytes(made.file));
    const Vector3 &centre_m = made.place.centre_m;
    input_.centres_in_world_m = {{centre_m.x(), centre_m.y(), centre_m.z()}};
    Run run;
    localizeFrames(
        input_, [](uint32_t, uint32_t) {}, [](const std::string &) {}, &run);
    return run.frames;
  }

 private:
  LocalizeInput input_;
};

std::vector<std::array<double, 3>> directionsOf(const PointModel &model) {
  const Vector3 centre = centreOf(model.points);
  std::vector<std::array<double, 3>> directions;
  for (const ModelPoint &point : model.points) {
    const Vector3 d = seenFrom(centre, point).direction;
    directions.push_back({d.x(), d.y(), d.z()});
  }
  return directions;
}

void count(const std::vector<FrameRecord> &frames, Recall *recall, std::vector<double> *errors_m) {
  for (const FrameRecord &frame : frames) {
    recall->frames += frame.has_truth;
    recall->good += frame.has_truth && isGood(frame);
    if (frame.has_truth && frame.localized) errors_m->push_back(frame.translation_error_m);
  }
}

// The camera's z axis.
std::array<double, 3> viewOf(const sphc_rigid &base_from_camera) {
  const double w = base_from_camera.q_wxyz[0], x = base_from_camera.q_wxyz[1], y = base_from_camera.q_wxyz[2],
               z = base_from_camera.q_wxyz[3];
  return {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

void addFailures(const std::vector<FrameRecord> &frames, std::vector<Failure> *failures) {
  for (const FrameRecord &frame : frames) {
    if (!frame.has_truth || isGood(frame)) continue;
    failures->push_back({frame.sequence, whyFailed(frame), viewOf(frame.truth_base_from_camera)});
  }
}

}  // namespace

Advice advise(RecordingReader *reader, const AdviceOptions &options,
              const std::function<void(const RgbdImportSummary &all)> &mapped,
              const std::function<void(uint32_t done, uint32_t total)> &progress) {
  const std::vector<uint32_t> posed = framesWithPose(*reader);
  checkFolds(posed.size(), options.folds);
  Advice advice;
  RgbdImportSummary summary;
  const PointModel whole = importRgbd({{reader}}, options.import, nullptr, &summary);
  mapped(summary);
  const std::vector<Block> blocks = blocksOf(posed, options.folds);
  advice.left_out = framesLeftOut(summary);
  advice.points = whole.points.size();
  advice.directions = directionsOf(whole);
  advice.coverage = coverageOf(advice.directions, kMostHoles);
  std::vector<std::vector<double>> errors_m(options.etas.size());
  for (double eta : options.etas) advice.recalls.push_back({eta, 0, 0, 0});
  for (uint32_t k = 0; k < blocks.size(); ++k) {
    const Block &block = blocks[k];
    progress(k + 1, options.folds + 1);
    const RgbdSource others = {reader, [&block](uint32_t index) { return !block.holds(index); }};
    RgbdImportSummary unused;
    const PointModel model = importRgbd({others}, options.import, nullptr, &unused);
    Trial trial(options, reader, block);
    for (size_t i = 0; i < options.etas.size(); ++i) {
      const std::vector<FrameRecord> frames = trial.frames(releaseWithout(block, *reader, model, options.etas[i]));
      count(frames, &advice.recalls[i], &errors_m[i]);
      if (options.etas[i] == options.judged_eta) addFailures(frames, &advice.failures);
    }
  }
  for (size_t i = 0; i < errors_m.size(); ++i) advice.recalls[i].median_m = percentile(errors_m[i], 0.5);
  return advice;
}

}  // namespace sphc::host
