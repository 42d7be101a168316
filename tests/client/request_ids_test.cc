// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/request_ids.h"

#include <gtest/gtest.h>

#include <set>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace request_ids_test {

const absl::Status kLost = absl::UnavailableError("the link broke");

TEST(RequestIdsTest, EveryRequestHasANameOfItsOwn) {
  RequestIds ids;
  std::set<std::string> names;
  for (int i = 0; i < 100; ++i) {
    const std::string name = ids.NameOf("plan");
    EXPECT_EQ(name.size(), 32U);
    names.insert(name);
    ids.NoteEnd("plan", name, absl::OkStatus());
  }
  EXPECT_EQ(names.size(), 100U);
}

TEST(RequestIdsTest, ARequestWhoseFateIsUnknownKeepsItsName) {
  RequestIds ids;
  const std::string name = ids.NameOf("register");
  ids.NoteEnd("register", name, kLost);
  EXPECT_NE(ids.NameOf("create"), name);
  EXPECT_EQ(ids.NameOf("register"), name);
  ids.NoteEnd("register", name, kLost);
  EXPECT_EQ(ids.NameOf("register"), name);
  ids.NoteEnd("register", name, absl::OkStatus());
  EXPECT_NE(ids.NameOf("register"), name);
}

TEST(RequestIdsTest, ARefusalIsAnAnswer) {
  RequestIds ids;
  const std::string name = ids.NameOf("register");
  ids.NoteEnd("register", name, absl::FailedPreconditionError("LEASE_HELD: ..."));
  EXPECT_NE(ids.NameOf("register"), name);
}

TEST(RequestIdsTest, OnlySoManyAreKept) {
  RequestIds ids;
  const std::string first = ids.NameOf("0");
  ids.NoteEnd("0", first, kLost);
  std::string last;
  for (int i = 1; i <= 64; ++i) {
    last = ids.NameOf(absl::StrCat(i));
    ids.NoteEnd(absl::StrCat(i), last, kLost);
  }
  EXPECT_NE(ids.NameOf("0"), first);
  EXPECT_EQ(ids.NameOf("64"), last);
}

}  // namespace request_ids_test
}  // namespace plumescout::client
