/* The public headers are C. */
#include "drivers/libcamera/libcamera.h"
#include "drivers/libcamera/plugin.h"
#include "drivers/openni2/openni2.h"
#include "drivers/raw/raw.h"
#include "drivers/replay/replay.h"
#include "drivers/sample/sample.h"
#include "drivers/v4l2/v4l2.h"
#include "host/recording/calibration.h"
#include "host/recording/recorder.h"
#include "host/recording/recording_writer.h"

typedef int c_headers_compile;
