#include "host/cli/common/import_recording.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "host/base/shell_word.h"
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

// Of so many frames from one on, the first with images and a pose.
std::optional<uint32_t> usableFrom(recording::RecordingReader *reader, uint32_t first, uint32_t count) {
  for (uint32_t i = first; i < std::min(first + count, reader->frameCount()); ++i) {
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
  const uint32_t available = reader->frameCount();
  const uint32_t apart = std::max(1u, available / count);
  std::vector<PointModel> models;
  ProgressBar bar(what);
  for (uint32_t k = 0; k < count && k < available; ++k) {
    const std::optional<uint32_t> chosen = usableFrom(reader.get(), k * apart, apart);
    RgbdImportSummary summary;
    if (chosen)
      models.push_back(
          importRgbd({{reader.get(), [&chosen](uint32_t i) { return i == *chosen; }}}, {}, {}, &summary));
    bar.show(k + 1, count);
  }
  if (models.empty())
    throw std::runtime_error(
        "no frame of " + recording.folder +
        " has both images and a pose; audit is of a recording with poses. Where spherecloud map found them, "
        "put its --trajectory into a copy: spherecloud convert " +
        shellWord(recording.folder) +
        " posed, then cp walk.tum posed/groundtruth.txt, and give posed as the recording");
  return models;
}

}  // namespace sphc::host
