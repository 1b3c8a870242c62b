// spherecloud encrypt: a map that says nothing to whoever has the storage and not the key.
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/encryption/encrypted_map.h"
#include "host/evaluate/map_file.h"

namespace sphc::host {
namespace {

struct EncryptOptions {
  std::string map, key, out;
  bool force = false;
};

int encrypt(const EncryptOptions &options, const Console &console) {
  const std::string out = options.out.empty() ? encryptedPath(options.map) : options.out;
  FileUse files(options.force);
  files.reads("the map", options.map);
  files.reads("--key", options.key);
  files.writes("--out", out, holds(kEncryptionHead));
  files.check();
  const EncryptionKey key = EncryptionKey::read(options.key);
  const MapFile map = openMapFile(options.map);  // nothing but a map is ever encrypted
  writeFile(out, encryptMap(map.bytes.data(), map.bytes.size(), key));
  console.say("Wrote " + out + ": " + options.map + ", encrypted with the key " + key.idText() + ".");
  console.give({{"map", options.map}, {"encrypted", out}, {"key_id", key.idText()}});
  return kExitDone;
}

}  // namespace

Command encryptCommand(CLI::App *root) {
  auto options = std::make_shared<EncryptOptions>();
  CLI::App *app = root->add_subcommand("encrypt");
  app->description(
      "Encrypt a map.\n\nWrites a file that a device with the key decrypts into memory, and that says nothing to "
      "whoever has its\nstorage alone.  Sign the map first, if it is signed: the signature is of the map as it "
      "is.");
  app->footer(
      "Example:\n  spherecloud key --for encryption --out rooms.key\n  spherecloud encrypt room.sphc --key "
      "rooms.key\n"
      "What comes out: room.sphc.enc; ship it in the map's place.");
  app->add_option("map", options->map, "Map file")->required()->type_name("FILE");
  app->add_option("--key", options->key, "Secret key, of spherecloud key --for encryption")
      ->required()
      ->type_name("FILE");
  app->add_option("--out", options->out, "Where the encrypted map goes [MAP.enc]")->type_name("FILE");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return encrypt(*options, console); }};
}

}  // namespace sphc::host
