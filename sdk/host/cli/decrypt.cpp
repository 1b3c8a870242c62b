// spherecloud decrypt: a map as it was before it was encrypted.
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/encryption/encrypted_map.h"
#include "host/report/file.h"

namespace sphc::host {
namespace {

struct DecryptOptions {
  std::string encrypted, key, out;
  bool force = false;
};

int decrypt(const DecryptOptions &options, const Console &console) {
  FileUse files(options.force);
  files.reads("the encrypted map", options.encrypted);
  files.reads("--key", options.key);
  files.writes("--out", options.out, never());
  files.check();
  const EncryptionKey key = EncryptionKey::read(options.key);
  writeFile(options.out, decryptMap(options.encrypted, readBytes(options.encrypted), key));
  console.say("Wrote " + options.out + ": the map of " + options.encrypted + ".");
  console.give({{"encrypted", options.encrypted}, {"map", options.out}, {"key_id", key.idText()}});
  return kExitDone;
}

}  // namespace

Command decryptCommand(CLI::App *root) {
  auto options = std::make_shared<DecryptOptions>();
  CLI::App *app = root->add_subcommand("decrypt");
  app->description(
      "Decrypt a map.\n\nWrites the map as it was before spherecloud encrypt, to inspect it or to encrypt it with "
      "the "
      "next key.\nExit status 1: the file was changed or is of another key, and the message says which.");
  app->footer("Example:\n  spherecloud decrypt room.sphc.enc --key rooms.key --out room.sphc");
  app->add_option("encrypted", options->encrypted, "Encrypted map")->required()->type_name("FILE");
  app->add_option("--key", options->key, "Secret key with which it was encrypted")->required()->type_name("FILE");
  app->add_option("--out", options->out, "Where the map goes")->required()->type_name("FILE");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return decrypt(*options, console); }};
}

}  // namespace sphc::host
