// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/enums.h"

#include <gtest/gtest.h>

#include <string>

#include "google/protobuf/descriptor.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace enums_test {

// Every value of the wire but "unspecified" must stand for one of the core and come back.
template <typename Proto, typename Read>
void ExpectEveryValueReturns(Read read) {
  const auto& values = *google::protobuf::GetEnumDescriptor<Proto>();
  for (int i = 0; i < values.value_count(); ++i) {
    const auto proto = static_cast<Proto>(values.value(i)->number());
    const auto core = read(proto, "field");
    if (values.value(i)->number() == 0) {
      EXPECT_EQ(core.status().message(), "field must be set");
      continue;
    }
    ASSERT_TRUE(core.ok()) << values.value(i)->name();
    EXPECT_EQ(ToProto(*core), proto) << values.value(i)->name();
  }
  const auto unknown = read(static_cast<Proto>(99), "field");
  EXPECT_EQ(unknown.status().message(), "field = 99 is not a value of this field");
}

template <typename Proto>
void ExpectTableIsComplete() {
  ExpectEveryValueReturns<Proto>(
      [](Proto proto, const char* field) { return FromProto(proto, field); });
}

TEST(EnumsTest, EveryTableIsCompleteAndRefusesTheRest) {
  ExpectTableIsComplete<v1::MissionPhase>();
  ExpectTableIsComplete<v1::GoalKind>();
  ExpectTableIsComplete<v1::Candidate::PathSource>();
  ExpectTableIsComplete<v1::RejectedGoal::Reason>();
  ExpectTableIsComplete<v1::PlanInvalidated::Reason>();
  ExpectTableIsComplete<v1::Plan::End>();
  ExpectTableIsComplete<v1::ReportProgressRequest::Outcome>();
  ExpectTableIsComplete<v1::GasScale>();
  ExpectTableIsComplete<v1::GasPrecisions>();
  ExpectTableIsComplete<v1::ObjectiveKind>();
  ExpectTableIsComplete<v1::ObjectiveStatus::State>();
  ExpectTableIsComplete<v1::WgfdScope>();
  ExpectTableIsComplete<v1::GoalPolicy>();
  ExpectTableIsComplete<v1::CostKind>();
  ExpectTableIsComplete<v1::SamplingKind>();
  ExpectTableIsComplete<v1::SelectionRule>();
  ExpectTableIsComplete<v1::SamplingReward>();
  ExpectTableIsComplete<v1::PathKind>();
}

TEST(EnumsTest, FrontiersAreOfTwoKindsOnly) {
  EXPECT_EQ(FrontierKindFromProto(ToProto(FrontierKind::kGas), "kind").value(), FrontierKind::kGas);
  EXPECT_EQ(FrontierKindFromProto(ToProto(FrontierKind::kOccupancy), "kind").value(),
            FrontierKind::kOccupancy);
  EXPECT_FALSE(FrontierKindFromProto(v1::GOAL_KIND_RANDOM_FREE_SPACE, "kind").ok());
}

}  // namespace enums_test
}  // namespace plumescout
