// spherecloud doctor: what is wrong with these cameras?
#include <chrono>
#include <memory>
#include <optional>
#include <spherecloud/spherecloud.hpp>
#include <string>
#include <utility>
#include <vector>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/calibration/nearest_camera.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/point_source.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_check.h"
#include "host/cli/common/rig_options.h"
#include "host/live/consistency_check.h"
#include "host/live/found.h"
#include "host/live/geometry_check.h"
#include "host/live/interrupt.h"
#include "host/live/rig.h"
#include "host/live/status_line.h"
#include "host/live/stream_check.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {
namespace {

using Grade = Finding::Grade;
constexpr uint32_t kEveryPair = 5;      // of the pairs, those whose geometry is looked at
constexpr uint32_t kMostCaptures = 20;  // of a recording, for each pair that is wanted
constexpr std::chrono::seconds kPatience(30);

struct DoctorOptions {
  RigOptions rig;
  uint32_t frames = 60;
  double depth_min_m = spherecloud::defaultConfig().depth_min_m;
  double depth_max_m = spherecloud::defaultConfig().depth_max_m;
};

const char *gradeText(Grade grade) {
  if (grade == Grade::kFine) return "fine";
  return grade == Grade::kWrong ? "WRONG" : "look";
}

Findings lookAround() {
  Findings findings;
  const Found found = findCameras();
  for (const FoundCamera &camera : found.cameras)
    findings.push_back(camera.problem.empty() ? Finding{Grade::kFine, camera.spec, nameAndOffers(camera)}
                                              : Finding{Grade::kWrong, camera.spec, camera.problem});
  for (const std::string &note : found.notes) findings.push_back({Grade::kDoubtful, "driver", note});
  if (found.cameras.empty())
    findings.push_back({Grade::kWrong, "cameras",
                        "none was found; is it plugged in, does `dmesg` see it, may this user read /dev/video*?"});
  return findings;
}

bool fits(const sphc_image &image, const sphc_camera &camera) {
  return image.width == camera.width && image.height == camera.height;
}

// Of captures: the first ones by name, and how many more there were.
class Troubles {
 public:
  void add(const std::string &trouble) {
    if (++count_ <= kMost) first_.push_back({Grade::kDoubtful, "capture", trouble});
  }
  Findings findings() const {
    Findings all = first_;
    if (count_ > kMost)
      all.push_back(
          {Grade::kDoubtful, "capture", std::to_string(count_ - kMost) + " more captures had such troubles"});
    return all;
  }

 private:
  static constexpr size_t kMost = 10;
  Findings first_;
  size_t count_ = 0;
};

void append(Findings more, Findings *findings) {
  for (Finding &finding : more) findings->push_back(std::move(finding));
}

// A calibration that does not reach the corners, say.
Findings findingsOfField(const sphc_rig &calibration) {
  Findings findings;
  for (const auto &[what, camera] :
       {std::pair("colour camera", calibration.color_camera), std::pair("depth camera", calibration.depth_camera)})
    if (const std::string doubt = doubtOfField(camera); !doubt.empty())
      findings.push_back({Grade::kDoubtful, what, "by the calibration it has " + doubt});
  return findings;
}

std::vector<int64_t> timesOf(const std::vector<recording::RecordedImage> &images) {
  std::vector<int64_t> times_ns;
  for (const recording::RecordedImage &image : images) times_ns.push_back(image.time_ns);
  return times_ns;
}

// What comes of the cameras, and the pairs of it, each looked at as it comes.
class CaptureChecks {
 public:
  CaptureChecks(const sphc_rig &calibration, const DoctorOptions &options, bool is_recording)
      : calibration_(calibration),
        color_(SPHC_STREAM_COLOR, calibration, is_recording),
        depth_(SPHC_STREAM_DEPTH, calibration, is_recording),
        geometry_(calibration),
        consistency_(calibration, options.depth_min_m, options.depth_max_m) {}

  void look(const sphc_capture &capture) {
    ++captures_;
    (capture.stream == SPHC_STREAM_COLOR ? color_ : depth_).look(capture);
  }
  void look(const CapturePair &pair) {
    fit_ = fits(pair.color.image, calibration_.color_camera) && fits(pair.depth.image, calibration_.depth_camera);
    if (fit_ && apart_ms_.size() % kEveryPair == 0) geometry_.look(pair.color.image, pair.depth.image);
    const int64_t color_ns = sphc_capture_middle_ns(&pair.color), depth_ns = sphc_capture_middle_ns(&pair.depth);
    if (fit_) consistency_.look(pair.color.image, color_ns, pair.depth.image, depth_ns);
    apart_ms_.push_back(1e-6 * static_cast<double>(color_ns - depth_ns));
  }

  size_t captures() const { return captures_; }
  size_t pairs() const { return apart_ms_.size(); }
  // Whether there are pairs, of the calibration's sizes.
  bool fit() const { return fit_; }

  // Of a recording: the images that there are, whether they can be read or not.
  void expect(const recording::Recording &recording) {
    color_.expect(timesOf(recording.color));
    depth_.expect(timesOf(recording.depth));
  }

  Findings ofStreams() const {
    Findings findings = color_.findings();
    append(depth_.findings(), &findings);
    return findings;
  }
  Findings ofPairs(uint64_t without_partner) const {
    Findings findings = {pairsFinding(apart_ms_, {color_.count(), depth_.count(), without_partner})};
    if (!fit_) return findings;
    append(consistency_.findings(), &findings);
    findings.push_back(geometry_.finding());
    return findings;
  }

 private:
  sphc_rig calibration_;
  StreamCheck color_, depth_;
  GeometryCheck geometry_;
  ConsistencyCheck consistency_;
  std::vector<double> apart_ms_;
  size_t captures_ = 0;
  bool fit_ = false;
};

enum class Seen { kAll, kUntilInterrupted, kUntilLate };

Seen watch(const DoctorOptions &options, bool is_recording, const Interrupt &interrupt, Rig *rig,
           CaptureChecks *checks) {
  StatusLine line;
  const auto until = std::chrono::steady_clock::now() + kPatience;
  const auto is_over = [&] {
    return is_recording ? checks->captures() > kMostCaptures * options.frames
                        : std::chrono::steady_clock::now() >= until;
  };
  rig->watch([checks](const sphc_capture &c) { checks->look(c); });
  while (checks->pairs() < options.frames && !interrupt.came() && !is_over()) {
    CapturePair pair;
    const Rig::Got got = rig->next(kPairWait, &pair);
    if (got == Rig::Got::kEnd) break;
    if (got == Rig::Got::kNothing) continue;
    checks->look(pair);
    rig->release(pair);
    line.show("looking: " + std::to_string(checks->pairs()) + " of " + std::to_string(options.frames));
  }
  if (checks->pairs() >= options.frames) return Seen::kAll;
  if (interrupt.came()) return Seen::kUntilInterrupted;
  return !is_recording && is_over() ? Seen::kUntilLate : Seen::kAll;
}

// Where fewer pairs were seen than were asked for, the others may be worse.
std::optional<Finding> findingOfHowMany(Seen seen, size_t pairs, uint32_t wanted) {
  const std::string of_all = std::to_string(pairs) + " of " + counted(wanted, "pair");
  if (seen == Seen::kUntilInterrupted)
    return Finding{Grade::kWrong, "looking",
                   "interrupted after " + of_all + "; let it end, or ask for fewer (--frames)"};
  if (seen == Seen::kUntilLate && pairs > 0)
    return Finding{Grade::kDoubtful, "looking",
                   of_all + " came in " + std::to_string(kPatience.count()) + " s, and the findings are of these"};
  return std::nullopt;
}

// They take longer than the pairs do.
Findings comparedPoses(const DoctorOptions &options, const Interrupt &interrupt,
                       recording::RecordingReader *recording) {
  RgbdImportOptions import;
  import.depth_min_m = options.depth_min_m;
  import.depth_max_m = options.depth_max_m;
  ProgressBar bar("comparing poses");
  const Findings findings = findingsOfPoses(recording, import, [&](uint32_t done, uint32_t total) {
    interrupt.throwIfCame();
    bar.show(done, total);
  });
  if (interrupt.came())
    return {{Grade::kWrong, "poses", "interrupted before they were compared with depths; let it end"}};
  return findings;
}

Findings lookAt(DoctorOptions options, const Console &console) {
  Troubles of_captures;
  options.rig.wish.at_once = true;
  Rig rig(options.rig, [&of_captures](const std::string &trouble) { of_captures.add(trouble); });
  for (const std::string &camera : rig.descriptions()) console.say("Camera: " + camera);
  const sphc_rig calibration = calibrationOf(options.rig, rig);
  recording::RecordingReader *const recording = rig.replayed();
  if (recording)
    if (Findings useless = findingsOfImages(*recording); !useless.empty()) return useless;
  CaptureChecks checks(calibration, options, recording != nullptr);
  if (recording) checks.expect(recording->recording());
  const Interrupt interrupt;
  const Seen seen = watch(options, recording != nullptr, interrupt, &rig, &checks);
  const std::optional<Finding> how_many = findingOfHowMany(seen, checks.pairs(), options.frames);
  if (how_many && checks.captures() == 0) return {*how_many};
  Findings findings = findingsOfField(calibration);
  if (how_many) findings.push_back(*how_many);
  append(of_captures.findings(), &findings);
  append(checks.ofStreams(), &findings);
  const std::string troubles = rig.troubles();
  if (!troubles.empty()) findings.push_back({Grade::kDoubtful, "cameras", troubles});
  if (recording)
    for (const std::string &fault : recording->recording().order_faults)
      findings.push_back({Grade::kDoubtful, "times", fault});
  const sphc_pairer_counts counts = rig.counts();
  append(checks.ofPairs(counts.too_far + counts.overtaken + counts.full), &findings);
  if (recording && checks.fit() && seen != Seen::kUntilInterrupted)
    append(comparedPoses(options, interrupt, recording), &findings);
  return findings;
}

int run(const DoctorOptions &options, const Console &console) {
  checkDepthRange(options.depth_min_m, options.depth_max_m);
  const bool has_cameras = !options.rig.both.empty() || !options.rig.color.empty() || !options.rig.depth.empty();
  if (has_cameras) checkRigOptions(options.rig);
  if (!has_cameras && !options.rig.wish.calibration.empty())
    throw UsageError("--calibration is of cameras; give --device, or --color and --depth, too");
  const Findings findings = has_cameras ? lookAt(options, console) : lookAround();
  bool wrong = false;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Finding &finding : findings) {
    wrong = wrong || finding.grade == Grade::kWrong;
    std::string grade = gradeText(finding.grade), what = finding.what;
    grade.resize(6, ' ');
    what.resize(std::max<size_t>(what.size(), 14), ' ');
    console.say(grade + " " + what + " " + finding.text);
    all.push_back({{"grade", gradeText(finding.grade)}, {"what", finding.what}, {"text", finding.text}});
  }
  console.give({{"findings", all}, {"wrong", wrong}});
  return wrong ? kExitFailure : kExitDone;
}

const char kDoctorExample[] =
    "Example:\n"
    "  spherecloud doctor                                              this machine\n"
    "  spherecloud doctor --color v4l2:/dev/video0 --depth v4l2:/dev/video2 -c headset.json\n"
    "  spherecloud doctor --device replay:walk.mcap                    a recording\n"
    "Show the cameras a room with things in it.  Exit status 1: something is wrong, or it was interrupted.";

}  // namespace

Command doctorCommand(CLI::App *root) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App *app = root->add_subcommand("doctor");
  app->description(
      "Say what is wrong with cameras, and the cure.\n\nWithout cameras: what is plugged in, and may be opened.  "
      "With cameras: rates, losses, clocks,\nsizes, light, depth, whether frames contradict themselves, and "
      "whether depth lies on the image\nas the calibration says, or would do so if it were mirrored, turned or "
      "registered already.  With a\nrecording: whether its poses contradict its depths, too.");
  app->footer(kDoctorExample);
  addRigOptions(app, &options->rig);
  app->add_option("--frames", options->frames, "Pairs to check")
      ->capture_default_str()
      ->transform(wholeFrom(1, 10000));
  for (CLI::Option *option : addDepthRangeOptions(app, &options->depth_min_m, &options->depth_max_m))
    option->group("Options");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
