// spherecloud doctor: what is wrong with these cameras?
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/rig_options.h"
#include "host/live/consistency_check.h"
#include "host/live/found.h"
#include "host/live/geometry_check.h"
#include "host/live/interrupt.h"
#include "host/live/status_line.h"
#include "host/live/stream_check.h"

namespace sphc::host {
namespace {

using Grade = Finding::Grade;
constexpr uint32_t kEveryPair = 5;  // of the pairs, those whose geometry is looked at

struct DoctorOptions {
  RigOptions rig;
  uint32_t frames = 60;
};

const char *gradeText(Grade grade) {
  if (grade == Grade::kFine) return "fine";
  return grade == Grade::kWrong ? "WRONG" : "look";
}

Findings lookAround() {
  Findings findings;
  const Found found = findCameras();
  for (const FoundCamera &camera : found.cameras)
    findings.push_back(camera.problem.empty()
                           ? Finding{Grade::kFine, camera.spec, camera.name + ", " + camera.offers}
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

Findings lookAt(const DoctorOptions &options, const Console &console) {
  StatusLine line;
  Troubles of_captures;
  Rig rig(options.rig, [&of_captures](const std::string &trouble) { of_captures.add(trouble); });
  for (const std::string &camera : rig.descriptions()) console.say("Camera: " + camera);
  const sphc_rig calibration = calibrationOf(options.rig, rig);
  const bool is_recording = options.rig.both.rfind("replay:", 0) == 0;  // which does not come late
  StreamCheck color(SPHC_STREAM_COLOR, calibration, is_recording);
  StreamCheck depth(SPHC_STREAM_DEPTH, calibration, is_recording);
  GeometryCheck geometry(calibration);
  ConsistencyCheck consistency(calibration);
  rig.watch([&](const sphc_capture &c) { (c.stream == SPHC_STREAM_COLOR ? color : depth).look(c); });
  std::vector<double> apart_ms;
  const Interrupt interrupt;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  bool geometry_fits = true;
  const auto is_over = [&] { return !is_recording && std::chrono::steady_clock::now() >= until; };
  while (apart_ms.size() < options.frames && !interrupt.came() && !is_over()) {
    CapturePair pair;
    const Rig::Got got = rig.next(std::chrono::milliseconds(200), &pair);
    if (got == Rig::Got::kEnd) break;
    if (got == Rig::Got::kNothing) continue;
    geometry_fits =
        fits(pair.color.image, calibration.color_camera) && fits(pair.depth.image, calibration.depth_camera);
    if (geometry_fits && apart_ms.size() % kEveryPair == 0) geometry.look(pair.color.image, pair.depth.image);
    const int64_t color_ns = sphc_capture_middle_ns(&pair.color), depth_ns = sphc_capture_middle_ns(&pair.depth);
    if (geometry_fits) consistency.look(pair.color.image, color_ns, pair.depth.image, depth_ns);
    apart_ms.push_back(1e-6 * static_cast<double>(color_ns - depth_ns));
    rig.release(pair);
    line.show("looking: " + std::to_string(apart_ms.size()) + " of " + std::to_string(options.frames));
  }
  Findings findings = of_captures.findings();
  for (const StreamCheck *stream : {&color, &depth})
    for (Finding &finding : stream->findings()) findings.push_back(std::move(finding));
  const std::string troubles = rig.troubles();
  if (!troubles.empty()) findings.push_back({Grade::kDoubtful, "cameras", troubles});
  const sphc_pairer_counts counts = rig.counts();
  findings.push_back(pairsFinding(apart_ms, counts.too_far + counts.overtaken + counts.full));
  if (apart_ms.empty() || !geometry_fits) return findings;
  for (Finding &finding : consistency.findings()) findings.push_back(std::move(finding));
  findings.push_back(geometry.finding());
  return findings;
}

int run(const DoctorOptions &options, const Console &console) {
  const bool has_cameras = !options.rig.both.empty() || !options.rig.color.empty() || !options.rig.depth.empty();
  if (has_cameras) checkRigOptions(options.rig);
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
    "Show the cameras a room with things in it.  Exit status 1: something is wrong.";

}  // namespace

Command doctorCommand(CLI::App *root) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App *app = root->add_subcommand("doctor");
  app->description(
      "Say what is wrong with cameras, and the cure.\n\nWithout cameras: what is plugged in, and may be opened.  "
      "With cameras: rates, losses, clocks,\nsizes, light, depth, whether frames contradict themselves, and "
      "whether "
      "depth lies on the image\nas the calibration says, or would do so if it were mirrored, turned or registered "
      "already.");
  app->footer(kDoctorExample);
  addRigOptions(app, &options->rig);
  app->add_option("--frames", options->frames, "Pairs to check")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
