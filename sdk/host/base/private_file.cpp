#include "host/base/private_file.h"

#include <sys/stat.h>

#include <stdexcept>

namespace sphc::host {

void checkPrivate(const std::string &path, const std::string &why) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) return;
  if (S_ISDIR(facts.st_mode)) throw std::runtime_error("key file " + path + " is a folder; give the file itself");
  if (facts.st_mode & (S_IRWXG | S_IRWXO))
    throw std::runtime_error("key file " + path + ": others may read it, and " + why + "; run: chmod 600 " + path);
}

}  // namespace sphc::host
