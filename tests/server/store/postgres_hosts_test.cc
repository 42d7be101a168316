// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_hosts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout::server {
namespace postgres_hosts_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PostgresHostsTest, EachPlaceOfAListIsAHost) {
  EXPECT_THAT(*PostgresHosts("postgresql://db1:5433,db2:5434/missions"),
              ElementsAre(PostgresHost{"db1", "", "5433"}, PostgresHost{"db2", "", "5434"}));
  EXPECT_THAT(*PostgresHosts("postgresql:///missions?host=db1,db2&port=5433"),
              ElementsAre(PostgresHost{"db1", "", "5433"}, PostgresHost{"db2", "", "5433"}));
  EXPECT_THAT(*PostgresHosts("hostaddr=10.0.0.1,10.0.0.2 host=a,b"),
              ElementsAre(PostgresHost{"a", "10.0.0.1", ""}, PostgresHost{"b", "10.0.0.2", ""}));
}

TEST(PostgresHostsTest, WhatIsNotSaidIsLeftToTheLibrary) {
  EXPECT_THAT(*PostgresHosts("postgresql:///missions"), ElementsAre(PostgresHost{}));
}

TEST(PostgresHostsTest, ListsThatDoNotFitAreRefusedAndNothingIsRepeated) {
  for (const char* url : {"host=a,b,c port=1,2 password=secret", "postgresql://u:secret@[::1/x"}) {
    const absl::Status refused = PostgresHosts(url).status();
    EXPECT_TRUE(absl::IsInvalidArgument(refused)) << refused;
    EXPECT_THAT(std::string(refused.message()), Not(HasSubstr("secret")));
  }
  EXPECT_THAT(std::string(PostgresHosts("host=a,b,c port=1,2").status().message()),
              HasSubstr("3 hosts, 1 addresses and 2 ports"));
}

}  // namespace postgres_hosts_test
}  // namespace plumescout::server
