// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/option_binding.h"

#include <gtest/gtest.h>

#include <limits>

#include "plumescout/v1/options.pb.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace option_binding_test {

struct Members {
  double pose_limit_m = 0.0;
  int max_beam_count = 0;
  std::uint64_t seed = 0;
};

void Visit(OneOf<Members> auto& members, auto& field) {
  field("pose_limit_m", members.pose_limit_m);
  field("max_beam_count", members.max_beam_count);
  field("seed", members.seed);
}

TEST(OptionBindingTest, OneVisitServesBothWays) {
  const Members members = {2.5, 7, std::numeric_limits<std::uint64_t>::max()};
  v1::MissionOptions proto;
  OptionWriter writer(proto);
  Visit(members, writer);
  EXPECT_EQ(proto.pose_limit_m(), 2.5);
  EXPECT_EQ(proto.max_beam_count(), 7);
  EXPECT_EQ(proto.seed(), -1);

  Members read;
  OptionReader reader(proto, "options");
  Visit(read, reader);
  EXPECT_TRUE(reader.status().ok());
  EXPECT_EQ(read.pose_limit_m, members.pose_limit_m);
  EXPECT_EQ(read.max_beam_count, members.max_beam_count);
  EXPECT_EQ(read.seed, members.seed);
}

TEST(OptionBindingTest, FieldsThatAreNotSetLeaveTheirMembers) {
  v1::MissionOptions proto;
  proto.set_max_beam_count(0);  // set, to the value that an unset field would read as
  Members read = {1.5, 3, 4};
  OptionReader reader(proto, "options");
  Visit(read, reader);
  EXPECT_EQ(read.pose_limit_m, 1.5);
  EXPECT_EQ(read.max_beam_count, 0);
  EXPECT_EQ(read.seed, 4u);
}

TEST(OptionBindingTest, OptionalMembersWithoutAValueSetNothing) {
  v1::FrontierOptions proto;
  OptionWriter writer(proto);
  writer("observed_variance_ppm2", std::optional<double>());
  writer("fixed_gas_threshold_ppm", std::optional<double>(4.0));
  EXPECT_FALSE(proto.has_observed_variance_ppm2());
  EXPECT_EQ(proto.fixed_gas_threshold_ppm(), 4.0);
  std::optional<double> read;
  OptionReader(proto, "")("observed_variance_ppm2", read);
  EXPECT_FALSE(read.has_value());
  OptionReader(proto, "")("fixed_gas_threshold_ppm", read);
  EXPECT_EQ(read, 4.0);
}

TEST(OptionBindingTest, WordsAndSwitchesAreRead) {
  v1::PlanningOptions proto;
  OptionWriter writer(proto);
  writer("strategy", std::string("xit_f"));
  writer("grid_guard", false);
  writer("cost", CostKind::kEuclidean);
  EXPECT_TRUE(proto.has_grid_guard());
  EXPECT_EQ(proto.cost(), v1::COST_KIND_EUCLIDEAN);
  std::string strategy;
  bool grid_guard = true;
  CostKind cost = CostKind::kUcb;
  OptionReader reader(proto, "planning");
  reader("strategy", strategy);
  reader("grid_guard", grid_guard);
  reader("cost", cost);
  EXPECT_EQ(strategy, "xit_f");
  EXPECT_FALSE(grid_guard);
  EXPECT_EQ(cost, CostKind::kEuclidean);
}

TEST(OptionBindingTest, TheFirstEnumThatIsUnknownIsRefusedByItsPath) {
  v1::PlanningOptions proto;
  proto.set_cost(static_cast<v1::CostKind>(99));
  proto.set_sampling(static_cast<v1::SamplingKind>(99));
  CostKind cost = CostKind::kVertices;
  SamplingKind sampling = SamplingKind::kIid;
  SelectionRule rule = SelectionRule::kMeanUcb;
  OptionReader reader(proto, "options.planning");
  reader("selection_rule", rule);  // unspecified: unset
  EXPECT_TRUE(reader.status().ok());
  reader("cost", cost);
  reader("sampling", sampling);
  EXPECT_EQ(FieldViolations(reader.status()).at(0).field, "options.planning.cost");
  EXPECT_EQ(cost, CostKind::kVertices);
  EXPECT_EQ(rule, SelectionRule::kMeanUcb);
}

}  // namespace option_binding_test
}  // namespace plumescout
