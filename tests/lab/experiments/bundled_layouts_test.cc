// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/experiments/bundled_layouts.h"

#include <gtest/gtest.h>

#include "lab/sim/layout_yaml.h"

namespace plumescout::lab {
namespace {

TEST(BundledLayouts, AreThoseOfTheirFiles) {
  const auto bundled = BundledLayout("industrial_16x20");
  ASSERT_TRUE(bundled.ok()) << bundled.status();
  const auto file = ReadLayout("lab/scenes/industrial_16x20.yaml");
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_EQ(bundled->name, file->name);
  EXPECT_EQ(bundled->sources, file->sources);
  EXPECT_EQ(bundled->walls.size(), file->walls.size());
}

TEST(BundledLayouts, OthersAreNotFound) {
  const absl::Status status = BundledLayout("no_such_hall").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_NE(status.message().find("no_such_hall"), std::string::npos);
}

}  // namespace
}  // namespace plumescout::lab
