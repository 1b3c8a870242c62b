#include "host/cli/common/import_recording.h"

#include <algorithm>

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

std::vector<PointModel> importFrames(const RecordingOptions &recording, uint32_t count, const char *what,
                                     const Console &console) {
  const auto reader = openRecording(recording);
  noteDamage(*reader, console);
  const uint32_t available = reader->frameCount();
  std::vector<PointModel> models;
  ProgressBar bar(what);
  for (uint32_t k = 0; k < count && k < available; ++k) {
    RecordingOptions one = recording;
    one.first += k * std::max(1u, available / count) * recording.step;
    one.last = one.first + recording.step - 1;
    RgbdImportSummary summary;
    models.push_back(importRgbd({{openRecording(one).get()}}, {}, {}, &summary));
    bar.show(k + 1, count);
  }
  return models;
}

}  // namespace sphc::host
