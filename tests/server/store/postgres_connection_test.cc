// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/types/error_reason.h"
#include "server/base/tcp_listener.h"
#include "tests/support/postgres_server.h"

namespace plumescout::server {
namespace postgres_connection_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr absl::Duration kPatience = absl::Seconds(30);

class PostgresConnectionTest : public ::testing::Test {
 protected:
  PostgresConnection& connection() { return *connection_; }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  std::unique_ptr<PostgresConnection> connection_ =
      PostgresConnection::Open(url_, kPatience).value();
};

TEST_F(PostgresConnectionTest, ValuesComeBackAsTheyWere) {
  const std::string bytes("\0\xff'\\", 4);
  PostgresStatement statement("SELECT $1, $2, $3, $4, $5, NULL::bigint, true");
  const std::int64_t numbers[] = {-7, 1LL << 40};
  const std::vector<std::string> parts = {bytes, ""};
  statement.Bind(-1'234'567'890'123).BindText("gas").BindBytes(bytes);
  statement.BindNumbers(numbers).BindAllBytes(parts);
  const auto rows = connection().Run(statement, kPatience);
  ASSERT_TRUE(rows.ok()) << rows.status();
  ASSERT_EQ(rows->count(), 1);
  EXPECT_EQ(rows->Int(0, 0), -1'234'567'890'123);
  EXPECT_EQ(rows->Bytes(0, 1), "gas");
  EXPECT_EQ(rows->Bytes(0, 2), bytes);
  EXPECT_TRUE(rows->is_null(0, 5));
  EXPECT_EQ(rows->Int(0, 5), 0);
  EXPECT_EQ(rows->Int(0, 6), 1);

  PostgresStatement unnest("SELECT n, b FROM unnest($1::bigint[], $2::bytea[]) AS a(n, b)");
  unnest.BindNumbers(numbers).BindAllBytes(parts);
  const auto parted = connection().Run(unnest, kPatience);
  ASSERT_TRUE(parted.ok()) << parted.status();
  ASSERT_EQ(parted->count(), 2);
  EXPECT_EQ(parted->Int(0, 0), -7);
  EXPECT_EQ(parted->Int(1, 0), 1LL << 40);
  EXPECT_EQ(parted->Bytes(0, 1), bytes);
  EXPECT_EQ(parted->Bytes(1, 1), "");
}

// Takes connections and never says anything.
class DarkHost {
 public:
  DarkHost() { fd_ = ListenOnTcp("127.0.0.1:0").value(); }
  ~DarkHost() { close(fd_); }
  int port() const { return ListenerPort(fd_); }

 private:
  int fd_ = -1;
};

TEST_F(PostgresConnectionTest, AHostThatIsDarkDoesNotKeepFromTheNext) {
  const DarkHost dark;
  const std::string url =
      absl::StrReplaceAll(url_, {{"host=", "host=127.0.0.1,"}}) +
      absl::StrCat("&port=", dark.port(), ",5432&target_session_attrs=read-write");
  const auto opened = PostgresConnection::Open(url, absl::Seconds(4));
  ASSERT_TRUE(opened.ok()) << opened.status();
  EXPECT_TRUE((*opened)->Run(PostgresStatement("SELECT 1"), kPatience).ok());
  const std::string nowhere =
      absl::StrCat("postgresql://u@127.0.0.1:", dark.port(), ",127.0.0.1:", dark.port(), "/d");
  const absl::Status away = PostgresConnection::Open(nowhere, absl::Milliseconds(50)).status();
  EXPECT_EQ(ErrorReason(away), reason::kStoreUnavailable) << away;
}

TEST_F(PostgresConnectionTest, AllStatementsAreDoneOrNone) {
  std::vector<PostgresStatement> statements;
  statements.emplace_back("CREATE TABLE kept(number bigint PRIMARY KEY)");
  statements.emplace_back("INSERT INTO kept VALUES(1)");
  ASSERT_TRUE(connection().RunAll(statements, kPatience).ok());

  statements.clear();
  statements.emplace_back("INSERT INTO kept VALUES(2)");
  statements.emplace_back("INSERT INTO kept VALUES(1)");
  statements.emplace_back("INSERT INTO kept VALUES(3)");
  const absl::Status refused = connection().RunAll(statements, kPatience).status();
  EXPECT_TRUE(absl::IsInternal(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("duplicate key"));
  EXPECT_TRUE(connection().is_broken());
  EXPECT_FALSE(connection().Run(PostgresStatement("SELECT 1"), kPatience).ok());
  EXPECT_EQ(PostgresServer::Shared().Ask(url_, "SELECT * FROM kept"), "1");
}

TEST_F(PostgresConnectionTest, KeptStatementsAreNamedOnceAndAnsweredLikeOthers) {
  for (std::int64_t run = 0; run < 3; ++run) {
    std::vector<PostgresStatement> statements;
    statements.emplace_back("SELECT 7");
    statements.emplace_back("SELECT $1 + 10").Bind(run).Keep();
    statements.emplace_back("SELECT $1 + 10").Bind(run + 1).Keep();
    statements.emplace_back("SELECT $1 + 20").Bind(run).Keep();
    const auto answers = connection().RunAll(statements, kPatience);
    ASSERT_TRUE(answers.ok()) << answers.status();
    const std::int64_t expected[] = {7, run + 10, run + 11, run + 20};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ((*answers)[i].Int(0, 0), expected[i]);
  }
  const auto kept = connection().Run(
      PostgresStatement("SELECT count(*), sum(generic_plans + custom_plans)::bigint "
                        "FROM pg_prepared_statements WHERE name <> ''"),
      kPatience);
  ASSERT_TRUE(kept.ok()) << kept.status();
  EXPECT_EQ(kept->Int(0, 0), 2);
  EXPECT_EQ(kept->Int(0, 1), 9);
}

TEST_F(PostgresConnectionTest, MuchGoesBothWaysAtOnce) {
  std::vector<PostgresStatement> statements;
  const std::string large(400'000, 'x');
  for (int i = 0; i < 20; ++i) statements.emplace_back("SELECT $1").BindBytes(large);
  const auto answers = connection().RunAll(statements, kPatience);
  ASSERT_TRUE(answers.ok()) << answers.status();
  for (const PostgresRows& rows : *answers) EXPECT_EQ(rows.Bytes(0, 0), large);
}

TEST_F(PostgresConnectionTest, WaitsHaveAnEnd) {
  const absl::Status late =
      connection().Run(PostgresStatement("SELECT pg_sleep(60)"), absl::Milliseconds(50)).status();
  EXPECT_TRUE(absl::IsUnavailable(late)) << late;
  EXPECT_EQ(ErrorReason(late), reason::kStoreUnavailable);
}

TEST_F(PostgresConnectionTest, ATableThatIsNotThereIsDamage) {
  const absl::Status damaged =
      connection().Run(PostgresStatement("SELECT * FROM nothing"), kPatience).status();
  EXPECT_EQ(ErrorReason(damaged), reason::kStoreDamaged);
  EXPECT_THAT(std::string(damaged.message()), HasSubstr("nothing"));
}

TEST_F(PostgresConnectionTest, WhoIsCutOffHearsSo) {
  const std::string victim = std::to_string(
      connection().Run(PostgresStatement("SELECT pg_backend_pid()"), kPatience)->Int(0, 0));
  PostgresServer::Shared().Ask(url_, "SELECT pg_terminate_backend(" + victim + ", 10000)");
  const absl::Status cut = connection().Run(PostgresStatement("SELECT 1"), kPatience).status();
  EXPECT_EQ(ErrorReason(cut), reason::kStoreUnavailable) << cut;
}

TEST_F(PostgresConnectionTest, CommitsReachTheDiskWhateverTheDatabaseIsSetTo) {
  const auto opened = PostgresConnection::Open(url_ + "%20-csynchronous_commit%3Doff", kPatience);
  ASSERT_TRUE(opened.ok()) << opened.status();
  const auto rows =
      (*opened)->Run(PostgresStatement("SELECT current_setting('synchronous_commit')"), kPatience);
  EXPECT_EQ(rows->Bytes(0, 0), "on");
}

TEST(PostgresConnectionOpen, ErrorsNameTheDatabaseButNoPassword) {
  const auto open = [](const std::string& url) {
    return PostgresConnection::Open(url, kPatience).status();
  };
  const absl::Status away = open("postgresql://robot:secret@127.0.0.1:1/plumes");
  EXPECT_EQ(ErrorReason(away), reason::kStoreUnavailable) << away;
  EXPECT_THAT(std::string(away.message()), HasSubstr("127.0.0.1:1/plumes"));
  EXPECT_THAT(std::string(away.message()), Not(HasSubstr("secret")));

  const absl::Status unreadable = open("postgresql://robot:secret@[::1/plumes");
  EXPECT_TRUE(absl::IsInvalidArgument(unreadable)) << unreadable;
  EXPECT_THAT(std::string(unreadable.message()), Not(HasSubstr("secret")));

  std::string stranger = PostgresServer::Shared().NewUrl();
  stranger.replace(stranger.find("user=plumescout"), 15, "user=stranger");
  EXPECT_TRUE(absl::IsPermissionDenied(open(stranger))) << open(stranger);
}

TEST(PostgresConnectionName, IsHostPortAndDatabase) {
  EXPECT_EQ(*PostgresName("postgresql://robot:secret@db1:5433/plumes"), "db1:5433/plumes");
  EXPECT_EQ(*PostgresName("postgresql:///plumes"), "local socket/plumes");
}

}  // namespace postgres_connection_test
}  // namespace plumescout::server
