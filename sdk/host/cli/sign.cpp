// spherecloud sign: a signature beside a map, which devices ask for.
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/evaluate/map_file.h"
#include "host/signing/signed_map.h"

namespace sphc::host {
namespace {

struct SignOptions {
  std::string map, key, name, out;
  uint64_t release = 0;
  bool force = false;
};

std::string outPath(const SignOptions &options) {
  return options.out.empty() ? signaturePath(options.map) : options.out;
}

std::string called(const std::string &name) { return name.empty() ? "a map without a name" : "the map " + name; }

// A device that has seen a release refuses the ones before it, and one that asks for a name every other name.  Of
// two maps with one number it would take either.
void checkGoesOn(const SignOptions &options, const MapFile &map, const SigningKey &key) {
  const std::string out = outPath(options);
  const std::optional<Stated> before = statedBy(key.publicKey(), out);
  if (!before || options.force) return;
  if (options.name != before->name)
    throw std::runtime_error("--name: " + out + " is of " + called(before->name) + ", and this would be of " +
                             called(options.name) + "; give the same name, another --out, or --force");
  if (options.release < before->release)
    throw std::runtime_error("--release " + std::to_string(options.release) + ": " + out + " states release " +
                             std::to_string(before->release) +
                             " already, and devices refuse what is older; give a greater number, or --force");
  if (options.release == before->release && !before->isOf(map.bytes.data(), map.bytes.size()))
    throw std::runtime_error("--release " + std::to_string(options.release) + ": " + out +
                             " states this release of another map, and a device takes either for the last; give a "
                             "greater number, or --force");
}

int sign(const SignOptions &options, const Console &console) {
  const std::string out = outPath(options);
  FileUse files(options.force);
  files.reads("the map", options.map);
  files.reads("--key", options.key);
  files.writes("--out", out, holds(kSignatureHead));
  files.check();
  const SigningKey key = SigningKey::read(options.key);
  const MapFile map = openMapFile(options.map);  // nothing but a map is ever signed
  checkGoesOn(options, map, key);
  const Signature signature = signMap(map.bytes.data(), map.bytes.size(), key, options.release, options.name);
  writeFile(out, signature.data(), signature.size());
  const std::string id = keyIdText(key.publicKey());
  console.say("Wrote " + out + ": " + options.map + " as release " + std::to_string(options.release) +
              (options.name.empty() ? ", without a name" : " of " + options.name) + ", signed by the key " + id +
              ".");
  console.give({{"map", options.map},
                {"signature", out},
                {"release", options.release},
                {"name", options.name},
                {"key_id", id}});
  return kExitDone;
}

}  // namespace

Command signCommand(CLI::App *root) {
  auto options = std::make_shared<SignOptions>();
  CLI::App *app = root->add_subcommand("sign");
  app->description(
      "Sign a map.\n\nWrites a file beside the map by which a device knows that the map is yours, whole, of this "
      "name "
      "and\nof this release.  The map stays as it is.");
  app->footer(
      "Example:\n  spherecloud sign room.sphc --key maps.key --release 7 --name kitchen\nWhat comes out: "
      "room.sphc.sig; ship it with the map.");
  app->add_option("map", options->map, "Map file")->required()->type_name("FILE");
  app->add_option("--key", options->key, "Secret key, of spherecloud key")->required()->type_name("FILE");
  app->add_option("--release", options->release,
                  "Number of the release, greater than that of all maps of this name before it")
      ->required()
      ->transform(wholeFrom(0))
      ->type_name("N");
  app->add_option("--name", options->name, "Which map it is, so that no other of yours takes its place [none]")
      ->type_name("NAME");
  app->add_option("--out", options->out, "Where the signature goes [MAP.sig]")->type_name("FILE");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return sign(*options, console); }};
}

}  // namespace sphc::host
