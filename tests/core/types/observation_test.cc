// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/observation.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace observation_test {

TEST(LastSequence, OfAReadingIsItsOwn) {
  Observation observation;
  observation.sequence = 7;
  observation.payload = GasReading{};
  EXPECT_EQ(LastSequence(observation), 7);
}

TEST(LastSequence, OfAGapIsItsEnd) {
  Observation observation;
  observation.sequence = 7;
  observation.payload = SequenceGap{7, 12};
  EXPECT_EQ(LastSequence(observation), 12);
}

}  // namespace observation_test
}  // namespace plumescout
