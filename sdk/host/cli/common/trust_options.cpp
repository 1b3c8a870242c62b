#include "host/cli/common/trust_options.h"

#include "host/base/usage_error.h"
#include "host/cli/common/number_checks.h"

namespace sphc::host {

void addTrustOptions(CLI::App *app, TrustOptions *options) {
  const char *group = "Trust";
  CLI::Option *keys =
      app->add_option("--trusted-key", options->keys,
                      "Public key; only a map that it signed is used, and no unsigned one; repeat for more keys")
          ->expected(1)
          ->take_all()
          ->type_name("FILE")
          ->group(group);
  app->add_option("--least-release", options->least_release, "A map that was signed as an older release is refused")
      ->transform(wholeFrom(0))
      ->needs(keys)
      ->type_name("N")
      ->group(group);
}

void readsTrust(const TrustOptions &options, FileUse *files) {
  for (const std::string &key : options.keys) files->reads("--trusted-key", key);
}

Trust trustOf(const TrustOptions &options) {
  if (options.keys.size() > SPHC_SIGNATURE_KEYS_MAX)
    throw UsageError("--trusted-key: at most " + std::to_string(SPHC_SIGNATURE_KEYS_MAX) + " keys");
  Trust trust;
  for (const std::string &key : options.keys) trust.keys.push_back(readPublicKey(key));
  trust.least_release = options.least_release;
  return trust;
}

}  // namespace sphc::host
