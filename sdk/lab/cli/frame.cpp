// spherecloud-lab frame: whole frames, ours beside package peers.
#include <filesystem>
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/evaluate/localize_run.h"
#include "host/evaluate/map_file.h"
#include "host/evaluate/played_odometry.h"
#include "host/report/file.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/common/recording_name.h"
#include "lab/frame/ours.h"
#include "lab/frame/peer.h"
#include "lab/frame/plots.h"

namespace sphc::host {
namespace {

struct FrameOptions {
  RecordingOptions recording;
  RecordingOptions mapping;  // folder and calibration are those of `recording`
  std::vector<std::string> maps, only;
  uint32_t repeats = 3;
  std::string name, python = "python3", out, results;
  bool no_peers = false, force = false;
};

// A map with what only its owner knows.
struct OwnedMap {
  MapFile file;
  Vector3 centre_in_world_m;
};

OwnedMap openOwnedMap(const std::string &path) {
  OwnedMap map = {openMapFile(path), Vector3::Zero()};
  map.centre_in_world_m = centreByNote({path + ".owner.json"}, map.file, path);
  return map;
}

class FrameCommand {
 public:
  FrameCommand(const FrameOptions &options, const Console &console)
      : options_(options), console_(console), reader_(openRecording(options.recording)) {
    config_ = spherecloud::defaultConfig();
    setCameras(reader_->calibration(), &config_);
    if (!options.no_peers) preparePeers();
  }

  std::vector<FrameTable> measure() {
    std::vector<FrameTable> tables;
    Unreadable unreadable = saidBy(console_);
    for (const std::string &path : options_.maps) {
      tables.push_back(measureMap(path, unreadable));
      unreadable = [](const std::string &) {};  // the same frames in every map
      console_.say("\n" + frameTableText(tables.back()));
    }
    return tables;
  }

 private:
  // Absent peers are told; those wanted and present map the place.
  void preparePeers() {
    if (options_.mapping.last == UINT32_MAX) {
      console_.warn("note: no peers: tell which frames they shall map with --mapping-last");
      return;
    }
    auto peers = std::make_unique<FramePeers>(options_.python);
    std::vector<std::string> chosen;
    for (const FrameVariant &peer : peers->variants()) {
      if (!isChosen(options_.only, peer.name)) continue;
      if (!peer.run) console_.warn("note: " + peer.name + " is absent, " + peer.absent);
      if (peer.run) chosen.push_back(peer.name);
    }
    if (chosen.empty()) return;
    console_.say("Peers: " + peers->packages() + ".");
    peers->begin(config_, chosen);
    peers_ = std::move(peers);
    mapPeers();
  }

  void mapPeers() {
    RecordingOptions mapping = options_.mapping;
    mapping.folder = options_.recording.folder;
    mapping.calibration = options_.recording.calibration;
    const auto reader = openRecording(mapping);
    const uint32_t count = reader->frameCount();
    const Unreadable unreadable = saidBy(console_);
    ProgressBar bar("peers map ");
    for (uint32_t i = 0; i < count; ++i) {
      FrameCase frame;
      if (readFrame(reader.get(), i, unreadable, &frame))
        peers_->addMappingFrame(frame.image, frame.truth_camera_from_world.inverse());
      bar.show(i + 1, count);
    }
  }

  // False when the frame has no pose or cannot be read, which is said.
  static bool readFrame(RecordingReader *reader, uint32_t index, const Unreadable &unreadable, FrameCase *frame) {
    const std::optional<sphc_rigid> world_from_camera = reader->worldFromCamera(index);
    if (!world_from_camera) return false;
    std::string why;
    const std::optional<sphc_localizer_frame> image = reader->tryRead(index, &why);
    if (!image) {
      unreadable(why);
      return false;
    }
    frame->image = *image;
    frame->index = index;
    frame->truth_camera_from_world = rigidFromC(*world_from_camera).inverse();
    return true;
  }

  std::vector<FrameVariant> variantsFor(const OwnedMap &map) {
    const OurFrames ours = {config_, &map.file.map, map.centre_in_world_m, options_.repeats};
    std::vector<FrameVariant> all = ourFrameVariants(ours);
    if (peers_) {
      const uint32_t points = map.file.map.info().point_count, own = peers_->index(points);
      console_.say("Peers' map: " + std::to_string(own) + " points of the place, " + std::to_string(points - own) +
                   " foreign.");
      all.insert(all.end(), peers_->variants().begin(), peers_->variants().end());
    }
    return chosenByName(options_.only, std::move(all));
  }

  FrameTable measureMap(const std::string &path, const Unreadable &unreadable) {
    const OwnedMap map = openOwnedMap(path);
    const std::vector<FrameVariant> variants = variantsFor(map);
    RecordingReader *reader = reader_.get();
    PlayedOdometry odometry(reader);
    const FrameBenchInput input = {reader->frameCount(), options_.repeats,
                                   [reader, &odometry, &unreadable](uint32_t i, FrameCase *frame) {
                                     frame->odometry = odometry.at(i);
                                     return readFrame(reader, i, unreadable, frame);
                                   }};
    ProgressBar bar("measuring ");
    FrameTable table = {
        options_.name, std::filesystem::path(path).filename().string(), map.file.map.info().point_count, 0, {}, {}};
    table.runs = runFrameBench(input, variants, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
    if (table.runs.empty() || table.runs[0].poses.samples.empty())
      throw std::runtime_error(
          "nothing was measured: no variant is there, or no frame has a pose (groundtruth.txt, *.pose.txt)");
    table.frames = table.runs[0].poses.samples.size();
    table.summaries = summarizeFrameBench(table.runs);
    return table;
  }

  const FrameOptions &options_;
  const Console &console_;
  std::unique_ptr<RecordingReader> reader_;
  sphc_localizer_config config_;
  std::unique_ptr<FramePeers> peers_;
};

void writeResult(const FrameOptions &options, const std::vector<FrameTable> &tables, const Console &console) {
  if (!options.results.empty()) writeFile(options.results, frameResults(tables));
  if (options.out.empty()) return;
  makeFolder(options.out);
  writeFile(options.out + "/frame.csv", frameCsv(tables));
  sayWritten(options.out, writeDrawings(options.out, frameDrawings(tables)), console);
}

int run(FrameOptions options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.recording);
  for (const std::string &map : options.maps) files.reads("--map", map);
  files.writes("--results", options.results, holds(frameResults({})));
  files.writesFolder("--out", options.out, holds(kPlotHead));
  files.check();
  const int core = pinToOneCore();
  if (options.name.empty()) options.name = recordingName(options.recording.folder).string();
  console.say(pinnedText(core, "CPU time"));
  FrameCommand command(options, console);
  const std::vector<FrameTable> tables = command.measure();
  if (tables.size() > 1) console.say(frameScalingText(tables));
  writeResult(options, tables, console);
  console.give({{"core", core}, {"repeats", options.repeats}, {"tables", frameJson(tables)}});
  return kExitDone;
}

const char kFrameHelp[] =
    "Localizes every frame of a recording by every variant in turn, on one core: the library, cold and\n"
    "tracking, and package peers (OpenCV, faiss, hnswlib) on an open point map of the same place and size.\n"
    "Several maps show how time grows with the map.  docs/bench.md says what each column means and how peers\n"
    "are installed.";
const char kFrameExample[] =
    "Example:\n"
    "  spherecloud-lab frame --recording kitchen --first 620 --map maps/map_50000.sphc --no-peers\n"
    "  spherecloud-lab frame --recording kitchen --first 620 --map maps/map_50000.sphc \\\n"
    "      --mapping-last 597 --mapping-step 3 --out bench\n"
    "What comes out: a table a map; with --out frame.csv and drawings.  The owner's note must lie beside a map;\n"
    "spherecloud-lab map makes maps of wanted sizes.";

void addOptions(CLI::App *app, FrameOptions *options) {
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->maps, "Map file; repeat for more")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--name", options->name, "Name of the recording in tables [last part of DIR]")->type_name("NAME");
  app->add_option("--repeat", options->repeats, "Runs of a frame of which the median time counts")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100u))
      ->type_name("N");
  addOnlyOption(app, &options->only, "variant");
  const char *group = "Peers";
  app->add_option("--mapping-first", options->mapping.first, "First frame that peers map [0]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--mapping-last", options->mapping.last, "Last one; needed for peers")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--mapping-step", options->mapping.step, "Every N-th of them [1]")
      ->type_name("N")
      ->transform(wholeFrom(1, UINT32_MAX))
      ->group(group);
  app->add_flag("--no-peers", options->no_peers, "The library alone")->group(group);
  app->add_option("--python", options->python, "Python that has the packages")
      ->capture_default_str()
      ->type_name("PATH")
      ->group(group);
  app->add_option("-o,--out", options->out, "Folder for frame.csv and drawings")->type_name("DIR");
  app->add_option("--results", options->results, "Write accuracy, ratios and bytes, no milliseconds")
      ->type_name("FILE");
}

}  // namespace

Command frameCommand(CLI::App *root) {
  auto options = std::make_shared<FrameOptions>();
  CLI::App *app = root->add_subcommand("frame");
  app->description("Whole frames, ours beside package peers.\n\n" + std::string(kFrameHelp));
  app->footer(kFrameExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
