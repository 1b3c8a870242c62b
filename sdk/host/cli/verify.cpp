// spherecloud verify: would a device accept this map?
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/trust_options.h"
#include "host/evaluate/map_file.h"

namespace sphc::host {
namespace {

struct VerifyOptions {
  std::string map, signature, name;
  CLI::Option *has_name = nullptr;
  TrustOptions trust;
};

// A map that nobody signed has none beside it; one that is named must be there.
void checkNamedSignature(const std::string &path) {
  std::error_code error;
  if (path.empty() || std::filesystem::status(path, error).type() != std::filesystem::file_type::not_found) return;
  throw std::runtime_error("--signature: " + path +
                           " is missing; give the file that spherecloud sign wrote, or leave --signature out where "
                           "it lies beside the map");
}

int verify(const VerifyOptions &options, const Console &console) {
  checkNamedSignature(options.signature);
  Trust trust = trustOf(options.trust);
  if (options.has_name->count() > 0) {
    checkMapName(options.name);
    trust.name = options.name;
  }
  trust.signature = options.signature;
  const sphc_signature_statement said = openMapFile(options.map, trust).statement;
  const std::string id = keyIdText(trust.keys[said.key_index]), name = said.name;
  console.say(options.map + ": release " + std::to_string(said.release) +
              (name.empty() ? ", without a name" : " of " + name) + ", signed by the trusted key " + id);
  console.give(
      {{"map", options.map}, {"accepted", true}, {"release", said.release}, {"name", name}, {"key_id", id}});
  return kExitDone;
}

}  // namespace

Command verifyCommand(CLI::App *root) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App *app = root->add_subcommand("verify");
  app->description(
      "Verify the signature of a map.\n\nJudges a map and its signature as a device does that trusts these keys.  "
      "Exit "
      "status 1: it is refused,\nand the message says why.");
  app->footer(
      "Example:\n  spherecloud verify room.sphc --trusted-key maps.key.pub --least-release 7 --name kitchen");
  app->add_option("map", options->map, "Map file")->required()->type_name("FILE");
  app->add_option("--signature", options->signature, "Its signature [MAP.sig]")->type_name("FILE");
  options->has_name = app->add_option("--name", options->name,
                                      "The name that it must have been signed under; '': without one [any]")
                          ->type_name("NAME");
  addTrustOptions(app, &options->trust);
  app->get_option("--trusted-key")->required();
  return {app, [options](const Console &console) { return verify(*options, console); }};
}

}  // namespace sphc::host
