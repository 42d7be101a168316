// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Bits that change on the disk: what is read is what was written, or an error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "server/store/sqlite_store.h"
#include "server/store/verify.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/rounds.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace sqlite_damage_test {

constexpr int kFlips = support::Rounds(600);
constexpr int kRecords = 120;
constexpr std::size_t kRecordBytes = 400;
constexpr std::uint64_t kMaxBytes = 1 << 26;
const std::vector<std::string> kKeys = {"barn", "house", "mill"};

StoredSnapshot SnapshotOf(const std::string& key, std::int64_t revision) {
  return {revision, static_cast<std::uint64_t>(revision) << 40U,
          RecordBytes(key, revision, 20'000)};
}

// What a server leaves that is killed when part of its work is in the database, part in the log.
void MakeKilled(const std::string& folder, const std::string& killed) {
  const auto store = SqliteStore::Open(InFolder(folder)).value();
  constexpr int kHalf = kRecords / 2;
  for (const std::string& key : kKeys) ASSERT_TRUE(store->Create(key, "header of " + key).ok());
  for (const int first : {1, kHalf + 1}) {
    for (const std::string& key : kKeys) {
      ASSERT_TRUE(AppendNow(*store, key, 1, first, Records(key, first, kHalf, kRecordBytes)).ok());
      ASSERT_TRUE(PutSnapshotNow(*store, key, 1, SnapshotOf(key, first)).ok());
      ASSERT_TRUE(PutStandingNow(*store, key, 1, "standing of " + key).ok());
    }
    if (first > 1) continue;
    ASSERT_TRUE(store->Compact().ok());
  }
  CopyStore(folder, killed);
}

// Whether everything could be read. What could be is as it was written, or the test has failed.
bool ReadsWhole(const std::string& folder) {
  const auto store = SqliteStore::Open(InFolder(folder));
  if (!store.ok()) return false;
  bool is_whole = true;
  const auto listed = (*store)->List();
  if (listed.ok()) {
    // Nobody is forgotten.
    for (const std::string& key : kKeys) {
      EXPECT_TRUE(std::any_of(listed->begin(), listed->end(),
                              [&](const StoredMission& mission) { return mission.key == key; }));
    }
  }
  for (const std::string& key : kKeys) {
    const auto records = ReadAll(**store, key);
    if (records.ok()) {
      EXPECT_TRUE(*records == Numbered(key, 1, kRecords, kRecordBytes)) << records->size();
    }
    const auto mission = (*store)->Acquire(key);
    EXPECT_FALSE(absl::IsNotFound(mission.status())) << mission.status();
    is_whole = is_whole && listed.ok() && records.ok() && mission.ok();
    if (!mission.ok()) continue;
    EXPECT_EQ(mission->epoch, 2);
    EXPECT_EQ(mission->head, kRecords);
    EXPECT_EQ(mission->header, "header of " + key);
    EXPECT_EQ(mission->standing, "standing of " + key);
    is_whole = is_whole && mission->snapshots.size() == 2;
    for (const StoredSnapshot& snapshot : mission->snapshots) {
      EXPECT_TRUE(snapshot == SnapshotOf(key, snapshot.revision)) << snapshot.revision;
    }
  }
  return is_whole;
}

TEST(SqliteDamage, AFlippedBitIsFoundOrHarmless) {
  const TempFolder folder;
  const std::string killed = folder.File("killed");
  const std::string tried = folder.File("tried");
  FaultyDisk disk;
  MakeKilled(folder.File("store"), killed);
  CopyStore(killed, tried);
  ASSERT_TRUE(ReadsWhole(tried));
  std::mt19937_64 random(7);
  std::map<std::string, int> found;
  for (int flip = 0; flip < kFlips; ++flip) {
    const char* const name = flip % 8 == 0 ? "heads" : flip % 2 == 0 ? "store.db" : "store.db-wal";
    CopyStore(killed, tried);
    std::string bytes = *ReadFile(absl::StrCat(tried, "/", name), kMaxBytes);
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
    ASSERT_TRUE(WriteFile(absl::StrCat(tried, "/", name), bytes).ok());
    SCOPED_TRACE(absl::StrCat("flip ", flip, " in ", name, " at ", at));
    found[name] += ReadsWhole(tried) ? 0 : 1;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(found["store.db"], support::Rounds(10));
  EXPECT_GT(found["store.db-wal"], support::Rounds(10));
  EXPECT_EQ(found["heads"], 0);
}

TEST(SqliteDamage, AFileThatIsCutAnywhereIsFoundOut) {
  const TempFolder folder;
  const std::string killed = folder.File("killed");
  const std::string tried = folder.File("tried");
  FaultyDisk disk;
  MakeKilled(folder.File("store"), killed);
  constexpr int kCuts = 20;
  for (const char* name : {"store.db", "store.db-wal"}) {
    const std::string whole = *ReadFile(absl::StrCat(killed, "/", name), kMaxBytes);
    for (int cut = 0; cut < kCuts; ++cut) {
      CopyStore(killed, tried);
      const std::size_t size = whole.size() * static_cast<std::size_t>(cut) / kCuts;
      ASSERT_TRUE(WriteFile(absl::StrCat(tried, "/", name), whole.substr(0, size)).ok());
      SCOPED_TRACE(absl::StrCat(name, " cut to ", size));
      EXPECT_FALSE(ReadsWhole(tried));
      if (testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace sqlite_damage_test
}  // namespace plumescout::server
