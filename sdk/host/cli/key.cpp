// spherecloud key: keys with which maps are signed, or encrypted.
#include <cstdio>
#include <memory>
#include <string>

#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/encryption/encrypted_map.h"
#include "host/signing/key_file.h"

namespace sphc::host {
namespace {

constexpr char kSignatures[] = "signatures", kEncryption[] = "encryption";

struct KeyOptions {
  std::string out, secret, purpose = kSignatures;
};

std::string publicPath(const std::string &secret_path) { return secret_path + ".pub"; }

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

// Of a key whose files are there.
void sayPublicKey(const SigningKey &key, const std::string &public_path, const Console &console) {
  console.say("Wrote " + public_path + ": the public key, id " + keyIdText(key.publicKey()) + ". For firmware:");
  console.say("static const sphc_signature_key key = " + inC(key.publicKey()) + ";");
}

int makeSigningKey(const std::string &path, const Console &console) {
  const std::string public_path = publicPath(path);
  FileUse files(false);  // a key that is lost is lost for ever: nothing is replaced
  files.writesNew("--out", path);
  files.writesNew("--out", public_path);
  files.check();
  const SigningKey key = SigningKey::draw();
  key.write(path, public_path);
  console.say("Wrote " + path + ": the secret key. Keep it off every device, back it up, show it to nobody.");
  sayPublicKey(key, public_path, console);
  console.give({{"secret_key", path}, {"public_key", public_path}, {"key_id", keyIdText(key.publicKey())}});
  return kExitDone;
}

int writePublicKey(const std::string &secret_path, const Console &console) {
  const std::string public_path = publicPath(secret_path);
  FileUse files(false);
  files.reads("--public-of", secret_path);
  files.writesNew("--public-of", public_path);
  files.check();
  const SigningKey key = SigningKey::read(secret_path);
  key.writePublic(public_path);
  sayPublicKey(key, public_path, console);
  console.give({{"public_key", public_path}, {"key_id", keyIdText(key.publicKey())}});
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

int run(const KeyOptions &options, const Console &console) {
  if (!options.secret.empty()) return writePublicKey(options.secret, console);
  if (options.out.empty()) throw UsageError("--out or --public-of is required");
  return options.purpose == kEncryption ? makeEncryptionKey(options.out, console)
                                        : makeSigningKey(options.out, console);
}

}  // namespace

Command keyCommand(CLI::App *root) {
  auto options = std::make_shared<KeyOptions>();
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
      "With --for encryption: the secret key alone, for spherecloud encrypt and decrypt.\n"
      "Where the public file was lost: spherecloud key --public-of maps.key");
  CLI::Option *out = app->add_option("--out", options->out, "File for the secret key; the public one is FILE.pub")
                         ->type_name("FILE");
  CLI::Option *use =
      app->add_option("--for", options->purpose, "What the key is for: signatures or encryption [signatures]")
          ->check(CLI::IsMember({kSignatures, kEncryption}))
          ->type_name("USE");
  app->add_option("--public-of", options->secret, "Write FILE.pub anew, of a secret key that signs maps")
      ->excludes(out)
      ->excludes(use)
      ->type_name("FILE");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
