// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Engines that are told to stop.
#include <gtest/gtest.h>

#include "core/gas/field/field_engine.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace field_engine_abandon_test {

using ::plumescout::testing::DefaultField;
using ::plumescout::testing::EngineOf;
using ::plumescout::testing::FieldCase;
using ::plumescout::testing::RandomChanges;
using ::plumescout::testing::RandomFieldCase;
using ::plumescout::testing::SameFields;

TEST(FieldEngineAbandonTest, AnAbandonedEngineOnlySaysSo) {
  Rng rng(21);
  const FieldCase c = RandomFieldCase(40, 40, 0.1, rng);
  bool stop = false;
  FieldOptions options = DefaultField();
  options.stop = [&] { return stop; };
  FieldEngine engine = EngineOf(c, options);
  EXPECT_TRUE(SameFields(c, engine, EngineOf(c)));
  EXPECT_TRUE(engine.Apply(RandomChanges(c, 5, 0.1, rng)).ok());
  stop = true;
  EXPECT_FALSE(engine.abandoned());
  EXPECT_TRUE(absl::IsCancelled(engine.Apply(RandomChanges(c, 5, 0.1, rng))));
  EXPECT_TRUE(engine.abandoned());
  EXPECT_TRUE(absl::IsCancelled(engine.Apply({})));
  EXPECT_TRUE(EngineOf(c, options).abandoned());
}

}  // namespace field_engine_abandon_test
}  // namespace plumescout
