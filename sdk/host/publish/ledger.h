// The owner's private record of everything that was released: one SQLite file, readable by its owner alone.
// docs/release.md.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/publish/place.h"
#include "host/publish/secret_random.h"

struct sqlite3;

namespace sphc::host {

class Ledger {
 public:
  // Opens the ledger, or makes one with this key; only one program at a time has it open.  Throws
  // std::runtime_error with cause and cure, also when places were released with another key or others may read the
  // file.  One that was made, and in which nothing was recorded, is removed with this object.
  static Ledger openOrMake(const std::string &path, const SecretKey *key);
  // Reads what somebody else released; throws when there is none.
  static Ledger openToRead(const std::string &path);

  const SecretKey &key() const { return key_; }
  // In the order of their numbers, which begin with 1 and have no gap.
  std::vector<Place> places() const;
  // A new place, or a known one with further points and releases.  Whole or not at all, and on the disk when it
  // returns.
  void record(const Place &place);

 private:
  struct Closer {
    std::string unrecorded;  // the file to remove; "": none
    void operator()(sqlite3 *database) const;
  };
  Ledger(const std::string &path, int flags);
  void run(const char *statement);
  void lock(bool is_new);  // for this program alone, until the ledger is closed
  void make(const SecretKey &key);
  void change(const std::function<void()> &statements);
  bool isEmpty() const;
  void read(const SecretKey *expected);
  void takeKey(const SecretKey &key);

  std::string path_;
  std::unique_ptr<sqlite3, Closer> database_;
  SecretKey key_ = {};
};

// By its first bytes, whatever its mode.
bool isLedger(const std::string &path);
// The release of the place that this map file is; null where it is none.
const Release *releaseOf(const Place &place, const std::vector<uint8_t> &file);

}  // namespace sphc::host
