#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "uvc_camera.h"

namespace sphc::guest {

namespace {

[[noreturn]] void usage(const char *program, const char *where_option, const char *wrong) {
  std::fprintf(stderr,
               "%s: %s\nusage: %s %s WHERE --name NAME --format YUYV|Z16|GREY --size WxH --rate HZ --frames FILE\n"
               "       [--unplug-after N] [--stall-after N] [--cut-frame N] [--exposure-modes BITS]\n",
               program, wrong, program, where_option);
  std::exit(2);
}

}  // namespace

CameraOptions parseOptions(int argc, char **argv, const char *where_option) {
  CameraOptions options;
  if (argc % 2 == 0) usage(argv[0], where_option, "every option takes a value");
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    const char *value = argv[i + 1];
    if (option == where_option) {
      options.where = value;
    } else if (option == "--name") {
      options.name = value;
    } else if (option == "--format") {
      options.fourcc = value;
    } else if (option == "--size") {
      std::sscanf(value, "%ux%u", &options.width, &options.height);
    } else if (option == "--rate") {
      options.rate_hz = static_cast<uint32_t>(std::atoi(value));
    } else if (option == "--frames") {
      options.frames_file = value;
    } else if (option == "--unplug-after") {
      options.unplug_after = std::atoi(value);
    } else if (option == "--stall-after") {
      options.stall_after = std::atoi(value);
    } else if (option == "--exposure-modes") {
      options.exposure_modes = static_cast<uint32_t>(std::atoi(value));
    } else if (option == "--cut-frame") {
      options.cut_frame = std::atoi(value);
    } else {
      usage(argv[0], where_option, argv[i]);
    }
  }
  if (options.where.empty() || options.name.empty() || options.name.size() > 100)
    usage(argv[0], where_option, "WHERE or NAME");
  if (options.width < 16 || options.height < 16 || options.width > 4096 || options.height > 4096)
    usage(argv[0], where_option, "--size");
  if (options.rate_hz < 1 || options.rate_hz > 240) usage(argv[0], where_option, "--rate");
  return options;
}

}  // namespace sphc::guest
