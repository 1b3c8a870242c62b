#include "host/cli/common/import_recording.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "host/cli/common/progress.h"
#include "host/import/rgbd_import.h"

namespace sphc::host {

PointModel importRecording(const RecordingOptions &recording, const char *what) {
  const auto reader = openRecording(recording);
  ProgressBar bar(what);
  RgbdImportSummary summary;
  return importRgbd(
      {{reader.get()}}, {}, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }, &summary);
}

namespace {

// Of a stretch of frames, the first with images and a pose.
std::optional<uint32_t> usableIn(recording::RecordingReader *reader, uint32_t begin, uint32_t end) {
  for (uint32_t i = begin; i < end; ++i) {
    std::string unused;
    if (reader->worldFromCamera(i) && reader->tryRead(i, &unused)) return i;
  }
  return std::nullopt;
}

}  // namespace

std::vector<PointModel> importFrames(const RecordingOptions &recording, uint32_t count, const char *what,
                                     const Console &console) {
  const auto reader = openRecording(recording);
  noteDamage(*reader, console);
  const uint64_t available = reader->frameCount(), stretches = std::min<uint64_t>(count, available);
  const auto begin = [&](uint64_t k) { return static_cast<uint32_t>(k * available / stretches); };
  std::vector<PointModel> models;
  ProgressBar bar(what);
  for (uint32_t k = 0; k < stretches; ++k) {
    const std::optional<uint32_t> chosen = usableIn(reader.get(), begin(k), begin(k + 1));
    RgbdImportSummary summary;
    if (chosen)
      models.push_back(
          importRgbd({{reader.get(), [&chosen](uint32_t i) { return i == *chosen; }}}, {}, {}, &summary));
    bar.show(k + 1, static_cast<uint32_t>(stretches));
  }
  if (models.empty())
    throw std::runtime_error(
        "no frame of " + recording.folder +
        " has both images and a pose; audit is of recordings with poses. Where spherecloud map found them, "
        "give its --trajectory by --poses-from, or that of --photos as groundtruth.txt in their folder");
  return models;
}

}  // namespace sphc::host
