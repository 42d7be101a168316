// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/subject.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace subject_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SubjectTest, PartsAreTakenApart) {
  EXPECT_THAT(*ParseSubject("CN=scout,OU=robot+L=Bonn,O=acme"),
              ElementsAre(SubjectPart{"CN", "scout"}, SubjectPart{"OU", "robot"},
                          SubjectPart{"L", "Bonn"}, SubjectPart{"O", "acme"}));
  EXPECT_THAT(*ParseSubject(""), IsEmpty());
  EXPECT_THAT(*ParseSubject("1.2.3=#0403414243,CN=a"),
              ElementsAre(SubjectPart{"1.2.3", "#0403414243"}, SubjectPart{"CN", "a"}));
}

TEST(SubjectTest, EscapesAreUndone) {
  EXPECT_THAT(*ParseSubject(R"(CN=a\,OU\=admin,O=\C3\A4\\b\ )"),
              ElementsAre(SubjectPart{"CN", "a,OU=admin"}, SubjectPart{"O", "\xc3\xa4\\b "}));
  EXPECT_THAT(*ParseSubject(R"(CN=\#1)"), ElementsAre(SubjectPart{"CN", "#1"}));
}

TEST(SubjectTest, WhatIsNotWrittenSoIsRefused) {
  for (const char* subject : {"CN", "=a", "CN=a,", "CN=a+", R"(CN=a\)", "/CN=a/OU=admin;x",
                              "CN=\"a\"", "CN=#0403414243", "CN=a<b"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(ParseSubject(subject).status())) << subject;
  }
  EXPECT_FALSE(ParseSubject("CN=" + std::string(2000, 'a')).ok());
}

TEST(SubjectTest, SubjectNamesAPrincipal) {
  EXPECT_EQ(*PrincipalOfSubject("CN=scout,OU=robot,O=acme"),
            (Principal{"scout", "acme", Role::kRobot, true}));
  EXPECT_EQ(*PrincipalOfSubject("OU=operator,C=DE,CN=alice"),
            (Principal{"alice", "", Role::kOperator, false}));
}

// Two answers to who calls are none.
TEST(SubjectTest, AmbiguousSubjectsAreRefused) {
  for (const char* subject : {"CN=a", "OU=viewer", "CN=a,CN=b,OU=viewer", "CN=a,OU=viewer,OU=admin",
                              "CN=a,OU=viewer+OU=admin", "CN=a,OU=viewer,O=acme,O=other",
                              "CN=a,OU=viewer,O=", "CN=,OU=viewer", "CN=a,OU=gardener",
                              R"(CN=a\00b,OU=viewer)", "/CN=a/OU=viewer"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(PrincipalOfSubject(subject).status())) << subject;
  }
}

// A name cannot bring a role of its own along.
TEST(SubjectTest, EscapedPartsAreNoParts) {
  EXPECT_EQ(*PrincipalOfSubject(R"(CN=a\,OU=admin,OU=viewer)"),
            (Principal{"a,OU=admin", "", Role::kViewer, false}));
}

TEST(SubjectTest, CommonNameIsOne) {
  EXPECT_EQ(*CommonNameOf("CN=front,O=acme"), "front");
  EXPECT_FALSE(CommonNameOf("O=acme").ok());
  EXPECT_FALSE(CommonNameOf("CN=front,CN=front").ok());
}

}  // namespace subject_test
}  // namespace plumescout::server
