// What is wrong with a recording, and with no camera: images of the other kind, a calibration of another size,
// poses that contradict the depths.
#pragma once
#include "host/import/rgbd_import.h"
#include "host/live/finding.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {

// Why not one image of a stream can be used as it is calibrated, although it can be read.  Empty where that is not
// so.
Findings findingsOfImages(const recording::RecordingReader &reader);

// Whether there are poses, and whether they and depths agree, as `build` would say of some of the frames with its
// options `import`.
Findings findingsOfPoses(recording::RecordingReader *reader, const RgbdImportOptions &import,
                         const Progress &progress);

}  // namespace sphc::host
