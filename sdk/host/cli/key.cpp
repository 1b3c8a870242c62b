// spherecloud key: keys with which maps are signed, or encrypted.
#include <cstdio>
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/encryption/encrypted_map.h"
#include "host/signing/key_file.h"

namespace sphc::host {
namespace {

constexpr char kSignatures[] = "signatures", kEncryption[] = "encryption";

// As sphc_signature_key is initialised in C.
std::string inC(const sphc_signature_key &key) {
  std::string text = "{{";
  for (const uint8_t byte : key.bytes) {
    char digits[8];
    std::snprintf(digits, sizeof digits, "0x%02x,", byte);
    text += digits;
  }
  text.back() = '}';
  return text + "}";
}

int makeSigningKey(const std::string &path, const Console &console) {
  const std::string public_path = path + ".pub";
  FileUse files(false);  // a key that is lost is lost for ever: nothing is replaced
  files.writesNew("--out", path);
  files.writesNew("--out", public_path);
  files.check();
  const SigningKey key = SigningKey::draw();
  key.write(path, public_path);
  const std::string id = keyIdText(key.publicKey());
  console.say("Wrote " + path + ": the secret key. Keep it off every device, back it up, show it to nobody.");
  console.say("Wrote " + public_path + ": the public key, id " + id + ". For firmware:");
  console.say("static const sphc_signature_key key = " + inC(key.publicKey()) + ";");
  console.give({{"secret_key", path}, {"public_key", public_path}, {"key_id", id}});
  return kExitDone;
}

int makeEncryptionKey(const std::string &path, const Console &console) {
  FileUse files(false);  // as above
  files.writesNew("--out", path);
  files.check();
  const EncryptionKey key = EncryptionKey::draw();
  key.write(path);
  console.say("Wrote " + path + ": the secret key, id " + key.idText() +
              ". Bring it into the devices' protected storage, back it up, show it to nobody.");
  console.give({{"secret_key", path}, {"key_id", key.idText()}});
  return kExitDone;
}

}  // namespace

Command keyCommand(CLI::App *root) {
  auto path = std::make_shared<std::string>(), purpose = std::make_shared<std::string>(kSignatures);
  CLI::App *app = root->add_subcommand("key");
  app->description(
      "Make keys that sign maps, or encrypt them.\n\nFor signatures, a pair of Ed25519: whoever has the secret "
      "file "
      "signs maps that your devices accept; the\npublic one goes into the devices.  For encryption, one secret "
      "key, "
      "which your devices need too.  Files that\nare there are never replaced.");
  app->footer(
      "Example:\n  spherecloud key --out maps.key\nWhat comes out:\n"
      "  maps.key        the secret key, readable by you alone: keep it, back it up, never ship it\n"
      "  maps.key.pub    the public key: for --trusted-key, and as a line of C for firmware\n"
      "With --for encryption: the secret key alone, for spherecloud encrypt and decrypt.");
  app->add_option("--out", *path, "File for the secret key; the public one is FILE.pub")
      ->required()
      ->type_name("FILE");
  app->add_option("--for", *purpose, "What the key is for: signatures or encryption [signatures]")
      ->check(CLI::IsMember({kSignatures, kEncryption}))
      ->type_name("USE");
  return {app, [path, purpose](const Console &console) {
            return *purpose == kEncryption ? makeEncryptionKey(*path, console) : makeSigningKey(*path, console);
          }};
}

}  // namespace sphc::host
