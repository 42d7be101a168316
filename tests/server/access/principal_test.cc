// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/principal.h"

#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace principal_test {

TEST(PrincipalTest, WordsMakeAPrincipal) {
  EXPECT_EQ(*MakePrincipal("alice", "operator", "acme"),
            (Principal{"alice", "acme", Role::kOperator, false}));
  EXPECT_EQ(*MakePrincipal("Mr.X@host", "viewer", ""),
            (Principal{"Mr.X@host", "", Role::kViewer, false}));
  EXPECT_EQ(MakePrincipal("root", "admin", "")->role, Role::kAdmin);
}

TEST(PrincipalTest, RobotsActForThemselvesAlone) {
  EXPECT_EQ(*MakePrincipal("scout-1", "robot", "acme"),
            (Principal{"scout-1", "acme", Role::kRobot, true}));
  EXPECT_TRUE(absl::IsInvalidArgument(MakePrincipal("Scout", "robot", "acme").status()));
}

TEST(PrincipalTest, EveryRoleHasAName) {
  for (const Role role : {Role::kRobot, Role::kViewer, Role::kOperator, Role::kAdmin}) {
    EXPECT_EQ(MakePrincipal("a", RoleName(role), "")->role, role);
  }
}

TEST(PrincipalTest, WordsOfAnotherKindAreRefused) {
  for (const std::string& word : {std::string(), std::string("a b"), std::string("a\n"),
                                  std::string("\xc3\xa4"), std::string(65, 'a')}) {
    EXPECT_TRUE(absl::IsInvalidArgument(MakePrincipal(word, "viewer", "").status())) << word;
    EXPECT_TRUE(absl::IsInvalidArgument(MakePrincipal("a", word, "").status())) << word;
    if (word.empty()) continue;
    EXPECT_TRUE(absl::IsInvalidArgument(MakePrincipal("a", "viewer", word).status())) << word;
  }
  for (const char* const tenant : {"b/c", ".", ".."}) {
    EXPECT_TRUE(absl::IsInvalidArgument(MakePrincipal("a", "viewer", tenant).status())) << tenant;
  }
  EXPECT_EQ(MakePrincipal("a", "Admin", "").status().message(),
            "role \"Admin\" must be robot, viewer, operator or admin");
}

}  // namespace principal_test
}  // namespace plumescout::server
