#include "plugin_loader.h"

#include <dlfcn.h>

#include "drivers/pixels/explain.h"

namespace sphc::libcamera {

const sphc_libcamera_plugin *loadPlugin(const char *path, sphc_message *message) {
  const char *name = path ? path : "libspherecloud_libcamera.so";
  void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) {
    const char *why = dlerror();
    pixels::explain(
        message, SPHC_E_UNSUPPORTED,
        "%.150s; install it (Debian: spherecloud-libcamera), or build spherecloud_libcamera with libcamera-dev",
        why ? why : name);
    return nullptr;
  }
  const auto entry = reinterpret_cast<sphc_libcamera_plugin_fn>(dlsym(library, SPHC_LIBCAMERA_PLUGIN_ENTRY));
  const sphc_libcamera_plugin *plugin = entry ? entry(SPHC_LIBCAMERA_PLUGIN_VERSION) : nullptr;
  if (!plugin || plugin->version != SPHC_LIBCAMERA_PLUGIN_VERSION) {
    dlclose(library);
    pixels::explain(
        message, SPHC_E_UNSUPPORTED, "%.150s: %s; this driver takes version %u: build both from one source", name,
        entry ? "a plug-in of another version" : "no plug-in of this driver", SPHC_LIBCAMERA_PLUGIN_VERSION);
    return nullptr;
  }
  return plugin;
}

}  // namespace sphc::libcamera
