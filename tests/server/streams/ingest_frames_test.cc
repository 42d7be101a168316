// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/ingest_frames.h"

#include <gtest/gtest.h>

#include <limits>

#include "proto/convert/status.h"
#include "server/base/errors.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace ingest_frames_test {

TEST(IngestFramesTest, StateOffersAWindowAndWithoutAStoreNoDurability) {
  const v1::IngestState state = ToIngestState({40, 55}, "r1", MissionJournal(), 128);
  EXPECT_EQ(state.applied_sequence(), 40);
  EXPECT_EQ(state.credit_sequence(), 168);
  EXPECT_EQ(state.durable_sequence(), 0);
  EXPECT_EQ(state.revision(), 55);
}

TEST(IngestFramesTest, EntryThatCannotBeReadDoesNotSpoilTheOthers) {
  v1::ObservationBatch batch = GasReadings(1, 3);
  batch.mutable_observations(1)->mutable_pose()->set_x_m(std::numeric_limits<double>::infinity());
  const auto incoming = ReadBatch(batch, 10);
  ASSERT_TRUE(incoming.ok());
  EXPECT_TRUE((*incoming)[0].unreadable.ok());
  EXPECT_EQ((*incoming)[1].unreadable.message(), "observation.pose.x_m = inf must be finite");
  EXPECT_EQ((*incoming)[1].observation.sequence, 2);
  EXPECT_TRUE((*incoming)[2].unreadable.ok());
}

TEST(IngestFramesTest, EntryWithoutANumberSpoilsTheBatch) {
  v1::ObservationBatch batch = GasReadings(1, 3);
  batch.mutable_observations(1)->clear_sequence();
  EXPECT_EQ(FieldViolations(ReadBatch(batch, 10).status()).at(0).field,
            "batch.observations[1].sequence");
}

TEST(IngestFramesTest, BatchIsNeitherEmptyNorTooLong) {
  EXPECT_TRUE(absl::IsInvalidArgument(ReadBatch({}, 10).status()));
  EXPECT_TRUE(ReadBatch(GasReadings(1, 10), 10).ok());
  EXPECT_EQ(FieldViolations(ReadBatch(GasReadings(1, 11), 10).status()).at(0).field,
            "batch.observations");
}

TEST(IngestFramesTest, RefusalNamesTheFieldOfTheObservation) {
  const v1::ObservationRejected rejected =
      ToRejected({9, absl::InvalidArgumentError("scan.ranges has 0 beams")});
  EXPECT_EQ(rejected.sequence(), 9);
  const absl::Status status = FromProto(rejected.status());
  EXPECT_EQ(FieldViolations(status).at(0).field, "observation.scan.ranges_u16");
  EXPECT_EQ(Reason(status), "INVALID_ARGUMENT");
}

}  // namespace ingest_frames_test
}  // namespace plumescout::server
