// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "core/types/error_reason.h"
#include "tests/support/postgres_server.h"

namespace plumescout::server {
namespace postgres_schema_test {

using ::testing::HasSubstr;

class PostgresSchemaTest : public ::testing::Test {
 protected:
  std::unique_ptr<PostgresConnection> Connect(const std::string& more = "") {
    return PostgresConnection::Open(url_ + more, absl::Seconds(30)).value();
  }
  absl::StatusOr<std::int64_t> Open(const std::string& cluster = "tests") {
    return OpenSharedSchema(*Connect(), cluster);
  }
  std::string Ask(const std::string& sql) { return PostgresServer::Shared().Ask(url_, sql); }
  std::string Tables() {
    return Ask(
        "SELECT count(*) FROM information_schema.tables WHERE table_schema = current_schema()");
  }

  const std::string url_ = PostgresServer::Shared().NewUrl();
};

TEST_F(PostgresSchemaTest, ManyMakeItAtOnceAndMeetTheSame) {
  std::vector<absl::StatusOr<std::int64_t>> stores(6, absl::UnknownError(""));
  std::vector<std::thread> threads;
  for (auto& store : stores) threads.emplace_back([&] { store = Open(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& store : stores) {
    ASSERT_TRUE(store.ok()) << store.status();
    EXPECT_EQ(*store, *stores.front());
    EXPECT_TRUE(CheckSameStore(*Connect(), *store).ok());
  }
  EXPECT_EQ(Tables(), "12");
}

TEST_F(PostgresSchemaTest, AStoreOfAnEarlierProgramGetsTheTablesThatItLacks) {
  const std::int64_t store = Open().value();
  Ask("DROP TABLE plumescout_idle, plumescout_stray, plumescout_damage");
  std::vector<absl::StatusOr<std::int64_t>> stores(3, absl::UnknownError(""));
  std::vector<std::thread> threads;
  for (auto& opened : stores) threads.emplace_back([&] { opened = Open(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& opened : stores) EXPECT_EQ(opened.value_or(0), store) << opened.status();
  EXPECT_EQ(Tables(), "12");

  Ask("DROP TABLE plumescout_damage");
  Ask("UPDATE plumescout_store SET format = 2");
  EXPECT_TRUE(absl::IsFailedPrecondition(Open().status()));
  EXPECT_EQ(Tables(), "11") << "it is left alone";
}

TEST_F(PostgresSchemaTest, AnotherFormatIsRefused) {
  ASSERT_TRUE(Open().ok());
  for (const char* format : {"0", "2"}) {
    Ask(std::string("UPDATE plumescout_store SET format = ") + format);
    const absl::Status refused = Open().status();
    EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
    EXPECT_THAT(std::string(refused.message()), HasSubstr(std::string("has format ") + format));
  }
}

TEST_F(PostgresSchemaTest, AnotherClusterIsRefusedAndNamed) {
  ASSERT_TRUE(Open("harbour").ok());
  const absl::Status refused = Open("refinery").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("cluster harbour"));
  EXPECT_TRUE(Open("harbour").ok());
}

TEST_F(PostgresSchemaTest, ATableOfAnotherShapeIsDamage) {
  ASSERT_TRUE(Open().ok());
  Ask("ALTER TABLE plumescout_record RENAME COLUMN crc TO checksum");
  const absl::Status damaged = Open().status();
  EXPECT_EQ(ErrorReason(damaged), reason::kStoreDamaged) << damaged;
  EXPECT_THAT(std::string(damaged.message()), HasSubstr("plumescout_record"));
}

TEST_F(PostgresSchemaTest, NothingIsWrittenToOneThatIsReadOnly) {
  const std::string read_only = "%20-cdefault_transaction_read_only%3Don";
  const absl::Status refused = OpenSharedSchema(*Connect(read_only), "tests").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("read-only"));
  EXPECT_EQ(Tables(), "0");

  const std::int64_t store = Open().value();
  EXPECT_EQ(ErrorReason(CheckSameStore(*Connect(read_only), store)), reason::kStoreUnavailable);
}

TEST_F(PostgresSchemaTest, AStoreThatTookThePlaceOfAnotherIsNotTakenForIt) {
  const std::int64_t store = Open().value();
  Ask("DELETE FROM plumescout_store");
  ASSERT_NE(CheckSameStore(*Connect(), store), absl::OkStatus());
  Ask("INSERT INTO plumescout_store VALUES(1, 5, 'tests')");
  const absl::Status other = CheckSameStore(*Connect(), store);
  EXPECT_TRUE(absl::IsUnavailable(other)) << other;
  EXPECT_THAT(std::string(other.message()), HasSubstr("another store"));
}

}  // namespace postgres_schema_test
}  // namespace plumescout::server
