/* The public headers are C. */
#include "drivers/libcamera/libcamera.h"
#include "drivers/libcamera/plugin.h"
#include "drivers/openni2/openni2.h"
#include "drivers/replay/calibration.h"
#include "drivers/replay/recorder.h"
#include "drivers/replay/recording_writer.h"
#include "drivers/replay/replay.h"
#include "drivers/sample/sample.h"
#include "drivers/v4l2/v4l2.h"

typedef int c_headers_compile;
