#include "host/publish/ledger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/made_up_model.h"
#include "tests/support/random_numbers.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// As it was before there was a checksum.
const std::string kWithoutChecksum = "DROP TABLE checksum; PRAGMA user_version = 3;";

class LedgerTest : public testing::Test {
 protected:
  LedgerTest() : path_(testing::TempDir() + "sphc_ledger_" + std::to_string(getpid()) + "_" + name()) {}
  ~LedgerTest() override { unlink(path_.c_str()); }

  static std::string name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
  // The message with which the ledger is refused.
  std::string refusal(const SecretKey *key = nullptr) const {
    try {
      Ledger::openOrMake(path_, key).places();
      return "accepted";
    } catch (const std::runtime_error &error) {
      EXPECT_THAT(error.what(), HasSubstr(path_));
      return error.what();
    }
  }
  void change(const std::string &statements) const {
    sqlite3 *database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }

  const std::string path_;
};

Place makePlace(uint32_t number, size_t points) {
  Random random(number);
  Place place;
  place.number = number;
  place.centre_m = {1.0 / 3, -2e-9, 1e5};
  place.eta = 1.0 / 3;
  place.strategy = "gaussian";
  place.fake_option = 0.2;
  for (const ModelPoint &point : test::madeUpRoom(static_cast<uint32_t>(points), number).points) {
    const uint16_t u = static_cast<uint16_t>(1 + random.below(65535)), v = 65535;
    place.points.push_back({point, {u, v}, test::randomDescriptor(&random), random.below(2) == 1, 1});
  }
  place.releases.push_back({{1, 2, 3}, 0xFFFFFFFFu, static_cast<uint32_t>(points), 1234567890123});
  return place;
}

void expectSame(const Place &a, const Place &b) {
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.centre_m, b.centre_m);  // to the bit
  EXPECT_EQ(a.eta, b.eta);
  EXPECT_EQ(a.strategy, b.strategy);
  EXPECT_EQ(a.band, b.band);
  EXPECT_EQ(a.fake_option, b.fake_option);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    const PlacePoint &p = a.points[i], &q = b.points[i];
    EXPECT_EQ(p.seen.position_m, q.seen.position_m);
    EXPECT_EQ(p.seen.sigma_m, q.seen.sigma_m);
    EXPECT_EQ(p.seen.observations, q.seen.observations);
    EXPECT_EQ(std::memcmp(&p.seen.descriptor, &q.seen.descriptor, sizeof(Descriptor)), 0);
    EXPECT_EQ(std::memcmp(&p.direction, &q.direction, sizeof(PackedDirection)), 0);
    EXPECT_EQ(std::memcmp(&p.descriptor, &q.descriptor, sizeof(Descriptor)), 0);
    EXPECT_EQ(p.real, q.real);
    EXPECT_EQ(p.release, q.release);
  }
  ASSERT_EQ(a.releases.size(), b.releases.size());
  for (size_t i = 0; i < a.releases.size(); ++i) {
    EXPECT_EQ(a.releases[i].map_id, b.releases[i].map_id);
    EXPECT_EQ(a.releases[i].crc32, b.releases[i].crc32);
    EXPECT_EQ(a.releases[i].points, b.releases[i].points);
    EXPECT_EQ(a.releases[i].time_s, b.releases[i].time_s);
  }
}

TEST_F(LedgerTest, RoundTripAndGrowth) {
  const SecretKey key = {7};
  Place first = makePlace(1, 100);
  Place second = makePlace(2, 30);
  second.band = SPHC_BAND_INFRARED;
  {
    Ledger ledger = Ledger::openOrMake(path_, &key);
    ledger.record(first);
    ledger.record(second);
  }
  Place grown = makePlace(1, 140);
  std::copy(first.points.begin(), first.points.end(), grown.points.begin());
  for (size_t i = 100; i < 140; ++i) grown.points[i].release = 2;
  grown.releases = {first.releases[0], {{9}, 5, 140, -1}};
  {
    Ledger ledger = Ledger::openOrMake(path_, nullptr);
    EXPECT_EQ(ledger.key(), key);
    expectSame(ledger.places().at(0), first);
    ledger.record(grown);
    ledger.record(grown);  // the same release over again
  }
  const std::vector<Place> places = Ledger::openToRead(path_).places();
  ASSERT_EQ(places.size(), 2u);
  expectSame(places[0], grown);
  expectSame(places[1], second);
}

TEST_F(LedgerTest, APlaceWithoutACentreIsNotHalfRecorded) {
  Place place = makePlace(1, 10);
  Ledger ledger = Ledger::openOrMake(path_, nullptr);
  for (const double bad : {std::nan(""), 1e7, -HUGE_VAL}) {
    place.centre_m.y() = bad;
    EXPECT_THROW(ledger.record(place), std::runtime_error);
  }
  EXPECT_TRUE(ledger.places().empty());
  ledger.record(makePlace(1, 10));
  EXPECT_EQ(ledger.places().size(), 1u);
}

TEST_F(LedgerTest, WhatItWouldNotReadItDoesNotKeep) {
  const auto refused = [this](double x_m, double sigma_m) {
    Place place = makePlace(1, 10);
    place.points[3].seen.position_m.x() = x_m;
    place.points[3].seen.sigma_m = sigma_m;
    EXPECT_THROW(Ledger::openOrMake(path_, nullptr).record(place), std::runtime_error) << x_m << " " << sigma_m;
  };
  Ledger::openOrMake(path_, nullptr).record(makePlace(1, 3));
  for (const double bad : {1e6, -1e6, std::nan(""), HUGE_VAL}) refused(bad, 0.01);
  for (const double bad : {1e6, -0.01, std::nan(""), HUGE_VAL}) refused(0, bad);
  EXPECT_EQ(Ledger::openToRead(path_).places().at(0).points.size(), 3u);
}

// As one was written before places had a band, and what shaped their fakes.
TEST_F(LedgerTest, AnOlderOneIsOfVisiblePlaces) {
  Place place = makePlace(1, 20);
  Ledger::openOrMake(path_, nullptr).record(place);
  place.fake_option = 0;
  change(kWithoutChecksum +
         "ALTER TABLE place DROP COLUMN band; ALTER TABLE place DROP COLUMN fake_option; PRAGMA user_version = 1");
  expectSame(Ledger::openToRead(path_).places().at(0), place);
  Place infrared = makePlace(2, 20);
  infrared.band = SPHC_BAND_INFRARED;
  Ledger::openOrMake(path_, nullptr).record(infrared);
  const std::vector<Place> places = Ledger::openToRead(path_).places();
  ASSERT_EQ(places.size(), 2u);
  expectSame(places[0], place);
  expectSame(places[1], infrared);
}

// SQLite would keep it nowhere.
TEST_F(LedgerTest, OneNamedAsADatabaseInMemoryIsAFile) {
  const std::filesystem::path before = std::filesystem::current_path();
  const test::TempFolder folder;
  std::filesystem::current_path(folder.path());
  const Place place = makePlace(1, 20);
  Ledger::openOrMake(":memory:", nullptr).record(place);
  const std::vector<Place> places = Ledger::openToRead(":memory:").places();
  EXPECT_TRUE(std::filesystem::exists(folder / ":memory:"));
  std::filesystem::current_path(before);
  ASSERT_EQ(places.size(), 1u);
  expectSame(places[0], place);
}

TEST_F(LedgerTest, ItsOwnerAloneMayReadIt) {
  Ledger::openOrMake(path_, nullptr).record(makePlace(1, 20));
  struct stat status;
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  chmod(path_.c_str(), 0640);
  EXPECT_THAT(refusal(), HasSubstr("chmod 600"));
  EXPECT_THROW(Ledger::openToRead(path_), std::runtime_error);
}

// As touch makes it.
TEST_F(LedgerTest, NoKeyIsWrittenIntoAnEmptyFileThatOthersMayRead) {
  std::ofstream(path_).flush();
  chmod(path_.c_str(), 0644);
  EXPECT_THAT(refusal(), HasSubstr("chmod 600"));
  chmod(path_.c_str(), 0600);
  EXPECT_EQ(refusal(), "accepted");
}

// A build that was killed while it recorded leaves a journal, which whoever comes next plays back.
TEST_F(LedgerTest, WhatAKilledBuildHalfRecordedIsUndone) {
  const std::string killed = path_ + "_killed", journal = "-journal";
  const auto copy = [](const std::string &from, const std::string &to) {
    std::ofstream(to, std::ios::binary) << std::ifstream(from, std::ios::binary).rdbuf();
    chmod(to.c_str(), 0600);
  };
  Ledger::openOrMake(killed, nullptr).record(makePlace(1, 200));
  sqlite3 *database = nullptr;
  ASSERT_EQ(sqlite3_open(killed.c_str(), &database), SQLITE_OK);
  // Little memory makes it write before it commits.
  ASSERT_EQ(sqlite3_exec(database, "PRAGMA cache_size = 2; BEGIN; UPDATE point SET real = 0, shown = zeroblob(128)",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  copy(killed, path_);
  copy(killed + journal, path_ + journal);
  sqlite3_close(database);
  expectSame(Ledger::openToRead(path_).places().front(), makePlace(1, 200));
  unlink(killed.c_str());
}

TEST_F(LedgerTest, DrawsAKeyAndKeepsIt) {
  SecretKey drawn = {};
  {
    Ledger ledger = Ledger::openOrMake(path_, nullptr);
    drawn = ledger.key();
    ledger.record(makePlace(1, 20));
  }
  const SecretKey other = {1};
  EXPECT_NE(drawn, SecretKey{});
  EXPECT_EQ(Ledger::openOrMake(path_, nullptr).key(), drawn);
  EXPECT_EQ(Ledger::openOrMake(path_, &drawn).key(), drawn);
  EXPECT_THAT(refusal(&other), HasSubstr("another key"));
}

// A build that failed must not leave a key behind that the next one has to take.
TEST_F(LedgerTest, ANewOneThatRecordedNothingIsRemoved) {
  const SecretKey first = {1}, second = {2};
  { const Ledger ledger = Ledger::openOrMake(path_, &first); }
  EXPECT_NE(access(path_.c_str(), F_OK), 0);
  EXPECT_NE(access((path_ + "-journal").c_str(), F_OK), 0);
  Ledger::openOrMake(path_, &second).record(makePlace(1, 20));
  { const Ledger ledger = Ledger::openOrMake(path_, nullptr); }
  EXPECT_EQ(Ledger::openToRead(path_).key(), second) << "one with places stays";
}

TEST_F(LedgerTest, OneThatAKilledBuildLeftTakesTheNextKey) {
  const SecretKey first = {1}, second = {2};
  const std::string killed = path_ + "_killed";
  {
    const Ledger ledger = Ledger::openOrMake(killed, &first);
    std::ofstream(path_, std::ios::binary) << std::ifstream(killed, std::ios::binary).rdbuf();
    chmod(path_.c_str(), 0600);
  }
  Ledger::openOrMake(path_, &second).record(makePlace(1, 20));
  EXPECT_EQ(Ledger::openToRead(path_).key(), second);
  EXPECT_THAT(refusal(&first), HasSubstr("another key"));
}

TEST_F(LedgerTest, AFolderIsNamedAsSuch) {
  EXPECT_THROW(Ledger::openToRead(testing::TempDir()), std::runtime_error);
  EXPECT_THAT(test::refusal([] { Ledger::openOrMake(testing::TempDir(), nullptr); }),
              testing::AllOf(HasSubstr("this is a folder"), testing::Not(HasSubstr("chmod"))));
}

TEST_F(LedgerTest, IsKnownByItsBytes) {
  EXPECT_FALSE(isLedger(path_));
  change("CREATE TABLE cats (name TEXT)");
  EXPECT_FALSE(isLedger(path_));
  unlink(path_.c_str());
  Ledger::openOrMake(path_, nullptr).record(makePlace(1, 20));
  EXPECT_TRUE(isLedger(path_));
}

TEST(ReleaseOf, IsByTheBytesOfTheFile) {
  Place place = makePlace(1, 20);
  place.releases.push_back({{4}, 0x352441C2u, 20, 1});  // the CRC-32 of "abc"
  EXPECT_EQ(releaseOf(place, {'a', 'b', 'c'}), &place.releases[1]);
  EXPECT_EQ(releaseOf(place, {'a', 'b', 'd'}), nullptr);
}

TEST_F(LedgerTest, OneProgramAtATime) {
  const Ledger ledger = Ledger::openOrMake(path_, nullptr);
  EXPECT_THAT(refusal(), HasSubstr("another program"));
}

// SQLite makes a journal beside the file.  A folder in its place stands for a folder where nothing may be made.
TEST_F(LedgerTest, OneThatCannotBeWrittenIsRefusedWithItsCure) {
  const std::string journal = path_ + "-journal";
  ASSERT_EQ(mkdir(journal.c_str(), 0700), 0);
  EXPECT_THAT(refusal(), HasSubstr("unable to open database file; allow yourself to write the ledger"));
  EXPECT_EQ(rmdir(journal.c_str()), 0);
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(LedgerTest, WhatIsNoLedgerIsRefused) {
  EXPECT_THROW(Ledger::openToRead(path_), std::runtime_error);
  EXPECT_NE(access(path_.c_str(), F_OK), 0) << "reading made a file";
  std::ofstream(path_) << "no database, and long enough that nobody takes it for the beginning of one "
                       << std::string(200, 'x');
  chmod(path_.c_str(), 0600);
  EXPECT_THAT(refusal(), HasSubstr("not a database; give a ledger that spherecloud build made"));
  EXPECT_THROW(Ledger::openOrMake("/nonexistent-folder/ledger", nullptr), std::runtime_error);
}

TEST_F(LedgerTest, ADatabaseOfSomebodyElseIsRefused) {
  change("CREATE TABLE cats (name TEXT)");
  chmod(path_.c_str(), 0600);
  EXPECT_THAT(refusal(), HasSubstr("not a ledger"));
}

// By its values, as it is in a ledger without a checksum.
TEST_F(LedgerTest, DamageIsSeen) {
  for (const char *damage :
       {"UPDATE point SET descriptor = x'00' WHERE number = 3", "UPDATE point SET u = 0 WHERE number = 3",
        "UPDATE point SET v = 65536 WHERE number = 3", "UPDATE point SET x = 9e999 WHERE number = 3",
        "UPDATE point SET sigma = -1 WHERE number = 3", "UPDATE place SET eta = 0", "UPDATE place SET number = 2",
        "UPDATE place SET centre_x = 1e7", "UPDATE release SET points = 100", "UPDATE release SET map_id = x''",
        "UPDATE place SET band = 2", "UPDATE place SET band = -1", "UPDATE place SET fake_option = -1",
        "DELETE FROM owner", "PRAGMA user_version = 4", "PRAGMA user_version = 5", "CREATE VIEW v AS SELECT 1"}) {
    unlink(path_.c_str());
    Ledger::openOrMake(path_, nullptr).record(makePlace(1, 20));
    EXPECT_EQ(refusal(), "accepted");
    change(kWithoutChecksum + damage);
    EXPECT_NE(refusal(), "accepted") << damage;
  }
}

// Of values that would do for a ledger.
TEST_F(LedgerTest, TheChecksumIsOverAllThatItHolds) {
  for (const char *damage : {"UPDATE owner SET secret_key = zeroblob(length(secret_key))",
                             "UPDATE place SET centre_x = centre_x + 1e-9",
                             "UPDATE place SET eta = 0.5",
                             "UPDATE place SET strategy = 'patchwork'",
                             "UPDATE place SET band = 1",
                             "UPDATE place SET fake_option = 0.3",
                             "UPDATE release SET time_s = time_s + 1",
                             "UPDATE release SET crc32 = 1",
                             "UPDATE point SET x = x + 1e-12 WHERE number = 3",
                             "UPDATE point SET sigma = 2 * sigma WHERE number = 3",
                             "UPDATE point SET observations = observations + 1 WHERE number = 3",
                             "UPDATE point SET descriptor = shown WHERE number = 3",
                             "UPDATE point SET u = u % 65535 + 1 WHERE number = 3",
                             "UPDATE point SET real = 1 - real WHERE number = 3",
                             "UPDATE point SET release = 2 WHERE number = 3",
                             "UPDATE point SET number = 21 WHERE number = 3",
                             "DELETE FROM point; DELETE FROM release; DELETE FROM place",
                             "UPDATE checksum SET crc32 = crc32 + 1",
                             "DELETE FROM checksum",
                             "PRAGMA user_version = 3"}) {
    unlink(path_.c_str());
    Ledger::openOrMake(path_, nullptr).record(makePlace(1, 20));
    EXPECT_EQ(refusal(), "accepted");
    change(damage);
    EXPECT_THAT(refusal(), AllOf(HasSubstr("it is damaged"), HasSubstr("take the backup"))) << damage;
    EXPECT_THROW(Ledger::openToRead(path_), std::runtime_error) << damage;
  }
}

TEST_F(LedgerTest, AnOlderOneGetsAChecksumWithTheNextBuild) {
  const Place place = makePlace(1, 20);
  Ledger::openOrMake(path_, nullptr).record(place);
  change(kWithoutChecksum);
  expectSame(Ledger::openToRead(path_).places().at(0), place);
  { const Ledger ledger = Ledger::openOrMake(path_, nullptr); }
  expectSame(Ledger::openToRead(path_).places().at(0), place);
  change("UPDATE point SET real = 1 - real");
  EXPECT_THAT(refusal(), HasSubstr("does not fit its checksum; take the backup"));
}

// Whatever the bytes are, there is an answer: what was recorded, or a message with the name and a cure.
TEST_F(LedgerTest, DamagedBytesAreNoDanger) {
  const Place place = makePlace(1, 20);
  Ledger::openOrMake(path_, nullptr).record(place);
  std::stringstream text;
  text << std::ifstream(path_, std::ios::binary).rdbuf();
  const std::string good = text.str();
  Random random(6);
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k)
      bad[random.below(static_cast<uint32_t>(bad.size()))] = static_cast<char>(random.below(256));
    if (round % 4 == 0) bad.resize(random.below(static_cast<uint32_t>(bad.size())));
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bad;
    try {
      const std::vector<Place> places = Ledger::openToRead(path_).places();
      ASSERT_EQ(places.size(), 1u);
      expectSame(places[0], place);
    } catch (const std::runtime_error &error) {
      EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("ledger " + path_ + ": "), HasSubstr("; ")));
      const std::string words = error.what();
      EXPECT_TRUE(std::none_of(words.begin(), words.end(), [](unsigned char c) { return c < ' '; })) << words;
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace sphc::host
