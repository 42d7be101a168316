// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/types/error_reason.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace postgres_reader_test {

using ::testing::HasSubstr;

class PostgresReaderTest : public ::testing::Test {
 protected:
  void Fill(int count, std::size_t size = 40) {
    ASSERT_EQ(*store_->Create("house", ""), 1);
    ASSERT_TRUE(AppendNow(*store_, "house", 1, 1, Records("house", 1, count, size)).ok());
  }
  void Damage(const std::string& sql) { PostgresServer::Shared().Ask(url_, sql); }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  const std::unique_ptr<PostgresStore> store_ = OpenShared(url_);
};

TEST_F(PostgresReaderTest, LargeRecordsComeInPagesToo) {
  constexpr std::size_t kSize = 700'000;
  Fill(5, kSize);
  EXPECT_EQ(*ReadAll(*store_, "house"), Numbered("house", 1, 5, kSize));
}

TEST_F(PostgresReaderTest, ReadsUpToWhatIsDamagedAndNamesIt) {
  Fill(400);
  for (const char* sql : {"UPDATE plumescout_record SET bytes = 'x' WHERE number = 300",
                          "DELETE FROM plumescout_record WHERE number = 300"}) {
    Damage(sql);
    const auto reader = store_->Read("house", 1).value();
    for (int number = 1; number < 300; ++number) {
      EXPECT_EQ((*reader->Next())->number, number);
    }
    const absl::Status found = reader->Next().status();
    EXPECT_EQ(ErrorReason(found), reason::kStoreDamaged) << found;
    EXPECT_THAT(std::string(found.message()), HasSubstr("record 300"));
  }
  EXPECT_EQ(ErrorReason(store_->Read("house", 301).status()), reason::kStoreDamaged);
}

TEST_F(PostgresReaderTest, ARemovedMissionIsGoneForItsReaders) {
  Fill(1000);
  const auto reader = store_->Read("house", 1).value();
  EXPECT_TRUE(reader->Next().ok());
  ASSERT_TRUE(RemoveNow(*store_, "house", 1).ok());
  ASSERT_EQ(*store_->Create("house", ""), 1);
  absl::Status end;
  for (int i = 0; i < 1000 && end.ok(); ++i) {
    // Chores take turns with commits.
    ASSERT_TRUE(PutStandingNow(*store_, "house", 1, "").ok());
    end = reader->Next().status();
  }
  EXPECT_TRUE(absl::IsNotFound(end)) << end;
}

TEST_F(PostgresReaderTest, ManyReadersNeedFewConnections) {
  Fill(300);
  std::vector<std::unique_ptr<JournalReader>> readers;
  for (int i = 0; i < 40; ++i) readers.push_back(store_->Read("house", 1).value());
  for (const auto& reader : readers) EXPECT_EQ((*reader->Next())->number, 1);
}

}  // namespace postgres_reader_test
}  // namespace plumescout::server
