/* The public headers are C. */
#include "drivers/replay/calibration.h"
#include "drivers/replay/recorder.h"
#include "drivers/replay/recording_writer.h"
#include "drivers/replay/replay.h"
#include "drivers/sample/sample.h"

typedef int c_headers_compile;
