// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_split.h"
#include "google/protobuf/descriptor.h"
#include "google/protobuf/util/message_differencer.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace options_test {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::util::MessageDifferencer;

PlanningOptions UnlikePlanning() {
  PlanningOptions planning;
  planning.strategy = "xit_f";
  planning.goal_policy = GoalPolicy::kOccupancyOnly;
  planning.cost = CostKind::kEuclidean;
  planning.paths = PathKind::kBitStar;
  planning.goal_vertices = false;
  planning.informed_heuristic = true;
  planning.straighten = false;
  planning.reading_rate_hz = 4.0;
  planning.commitment_margin_share = 0.25;
  planning.yield_to_robots = false;
  planning.robot_clearance_m = 0.5;
  planning.anticipate_robots = false;
  planning.balanced_areas = true;
  planning.team_replan_period_s = 2.5;
  planning.selection_rule = SelectionRule::kMeanUcb;
  planning.sampling = SamplingKind::kIid;
  planning.sample_count = 77;
  planning.grid_guard = false;
  planning.max_acceleration_mps2 = 0.5;
  planning.max_turn_rate_rad_per_s = 1.5;
  planning.travel_budget_m = 250.0;
  planning.return_margin_share = 0.25;
  planning.return_home = true;
  planning.planning_latency_s = 0.75;
  planning.max_connection_radius_m = 7.5;
  planning.unseen_information_nats = 12.0;
  planning.sites = {Rectangle{{-1.0, 2.0}, {3.0, 8.0}},
                    2.0,
                    SamplingReward::kConcentrationPerTime,
                    false,
                    3,
                    12,
                    7,
                    30.0,
                    4,
                    5};
  return planning;
}

MissionOptions Unlike() {
  MissionOptions options;
  options.occupancy = {0.2, 0.3, 0.2, 0.7, 1.0, -0.5, 4.0, 50.0, 10'000, 0.02};
  options.gas = {1.0, 2.0, 0.01, 3.0, 60.0, 2, false, 5.0, 0.1};
  options.frontier = {9, 6, 0.5, 0.25, 20.0, 3.0, 4.0, WgfdScope::kLocal};
  options.planning = UnlikePlanning();
  options.max_robot_count = 3;
  options.objective = {ObjectiveKind::kFindSources, 12.5, 0.99, 0.5, 900.0, 2.5};
  options.robot_silence_s = 12.5;
  options.return_home_below_battery_share = 0.25;
  options.memory_budget_bytes = 100'000'000;
  options.gas.field_reach_m = 12.0;
  options.stamp_by_arrival = true;
  options.keep_scans = false;
  options.misleading_move_m = 0.25;
  options.max_robot_speed_mps = 7.5;
  options.gas.audit_period_epochs = 7;
  options.gas.scale = GasScale::kSquareRoot;
  options.gas.estimate_noise = false;
  options.gas.noise_by_level = false;
  options.gas.unread_discount_ratio = 0.25;
  options.gas.gust_ratio = 0.5;
  options.keep_out = {{{{1, 2}, {3, 4}, {5, 7}}, "spill"}, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
  options.gas_species = {{"methane", {}, {}, {}, {}}, {"ozone", 30.0, {}, 0.5, 0.25}};
  options.home = Point2{-1.0, 2.0};
  options.prior_map =
      std::make_shared<const Grid<CellState>>(GridGeometry{-0.4, 0.2, 0.2, 7, 5}, CellState::kFree);
  options.seed = 0xffff'ffff'ffff'fffeULL;
  return options;
}

TEST(OptionsTest, OptionsSurviveTheRoundTrip) {
  const v1::MissionOptions proto = ToProto(Unlike());
  const auto back = FromProto(proto, MissionOptions{}, "options");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_TRUE(MessageDifferencer::Equals(ToProto(*back), proto));
  EXPECT_EQ(back->seed, Unlike().seed);
  EXPECT_EQ(back->objective.kind, ObjectiveKind::kFindSources);
  EXPECT_EQ(back->objective.deadline_s, 900.0);
  EXPECT_EQ(back->objective.hold_s, 2.5);
  EXPECT_EQ(back->occupancy.surface_depth_m, 0.02);
  EXPECT_EQ(back->robot_silence_s, 12.5);
  EXPECT_EQ(back->return_home_below_battery_share, 0.25);
  EXPECT_EQ(back->memory_budget_bytes, 100'000'000);
  EXPECT_EQ(back->gas.field_reach_m, 12.0);
  EXPECT_TRUE(back->stamp_by_arrival);
  EXPECT_FALSE(back->keep_scans);
  EXPECT_EQ(back->misleading_move_m, 0.25);
  EXPECT_EQ(back->max_robot_speed_mps, 7.5);
  EXPECT_EQ(back->gas.audit_period_epochs, 7);
  EXPECT_EQ(back->gas.scale, GasScale::kSquareRoot);
  EXPECT_FALSE(back->gas.estimate_noise);
  EXPECT_FALSE(back->gas.noise_by_level);
  EXPECT_EQ(back->gas.unread_discount_ratio, 0.25);
  EXPECT_EQ(back->gas.gust_ratio, 0.5);
  EXPECT_FALSE(back->gas.background_by_area);
  EXPECT_EQ(back->frontier.fixed_gas_threshold_ppm, 4.0);
  EXPECT_EQ(back->keep_out, Unlike().keep_out);
  EXPECT_EQ(back->gas_species, Unlike().gas_species);
  EXPECT_EQ(back->home, Unlike().home);
  EXPECT_EQ(back->planning.sites.region, Unlike().planning.sites.region);
  EXPECT_EQ(back->planning.sites.reward, SamplingReward::kConcentrationPerTime);
}

TEST(OptionsTest, AMissionsOwnGasesTakeThePlaceOfTheDefaults) {
  v1::MissionOptions proto;
  EXPECT_EQ(FromProto(proto, Unlike(), "options")->gas_species.size(), 2u);
  proto.add_gas_species()->set_name("ammonia");
  const auto own = FromProto(proto, Unlike(), "options");
  ASSERT_TRUE(own.ok()) << own.status();
  EXPECT_EQ(own->gas_species, (std::vector<GasSpecies>{{"ammonia", {}, {}, {}, {}}}));
  proto.add_gas_species()->set_name("ammonia");
  const absl::Status twice = FromProto(proto, MissionOptions(), "options").status();
  EXPECT_EQ(FieldViolations(twice).at(0).field, "options.gas_species[1].name");
}

TEST(OptionsTest, ChangesAreAllThatDiffersFromTheDefaults) {
  MissionOptions options;
  EXPECT_EQ(ChangesToProto(options).ByteSizeLong(), 0U);
  options.planning.strategy = "xit_f";
  options.planning.fallback_to_unobserved = false;
  options.planning.sites.region = Rectangle{{0.0, 0.0}, {2.0, 3.0}};
  options.frontier.fixed_gas_threshold_ppm = 600.0;
  options.home = Point2{1.0, 2.0};
  options.keep_out = {{{{1, 2}, {3, 4}, {5, 7}}}};
  v1::MissionOptions expected;
  expected.mutable_planning()->mutable_sites()->mutable_region()->mutable_min()->set_x_m(0.0);
  expected.mutable_planning()->mutable_sites()->mutable_region()->mutable_min()->set_y_m(0.0);
  expected.mutable_planning()->mutable_sites()->mutable_region()->mutable_max()->set_x_m(2.0);
  expected.mutable_planning()->mutable_sites()->mutable_region()->mutable_max()->set_y_m(3.0);
  expected.mutable_frontier()->set_fixed_gas_threshold_ppm(600.0);
  expected.mutable_planning()->set_strategy("xit_f");
  expected.mutable_planning()->set_fallback_to_unobserved(false);
  *expected.mutable_home() = ToProto(options).home();
  *expected.mutable_keep_out() = ToProto(options).keep_out();
  EXPECT_TRUE(MessageDifferencer::Equals(ChangesToProto(options), expected));
}

TEST(OptionsTest, AreasOfAMissionTakeThePlaceOfTheDefaults) {
  MissionOptions own;
  own.keep_out = {{{{0, 0}, {9, 0}, {0, 9}}}};
  EXPECT_EQ(FromProto(ChangesToProto(own), Unlike(), "options")->keep_out, own.keep_out);
}

TEST(OptionsTest, RefusalNamesTheVertex) {
  v1::MissionOptions proto = ToProto(Unlike());
  proto.mutable_keep_out(1)->mutable_vertices(2)->set_x_m(std::numeric_limits<double>::quiet_NaN());
  const auto options = FromProto(proto, MissionOptions{}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field, "options.keep_out[1].vertices[2].x_m");
  proto.mutable_keep_out(1)->clear_vertices();
  EXPECT_EQ(FieldViolations(FromProto(proto, MissionOptions{}, "options").status()).at(0).field,
            "options.keep_out[1].vertices");
}

// Sets every field of the message tree that has no value yet from the other, by reflection: so a
// field that conversion forgot shows up as unset.
void ExpectEveryFieldSet(const Message& message, const std::string& path) {
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message.GetDescriptor()->field(i);
    if (field->name() == "files") continue;  // of a prior map: written as cells
    if (field->is_repeated()) {
      EXPECT_GT(message.GetReflection()->FieldSize(message, field), 0) << path << field->name();
      continue;
    }
    EXPECT_TRUE(message.GetReflection()->HasField(message, field)) << path << field->name();
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      ExpectEveryFieldSet(message.GetReflection()->GetMessage(message, field),
                          path + field->name() + ".");
    }
  }
}

TEST(OptionsTest, EveryFieldOfTheWireIsWritten) { ExpectEveryFieldSet(ToProto(Unlike()), ""); }

TEST(OptionsTest, UnsetFieldsTakeTheDefaultsGiven) {
  const auto options = FromProto(v1::MissionOptions(), Unlike(), "options");
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_TRUE(MessageDifferencer::Equals(ToProto(*options), ToProto(Unlike())));
}

TEST(OptionsTest, OneFieldIsSetWithoutTheOthers) {
  v1::MissionOptions proto;
  proto.mutable_gas()->set_refresh_period_s(9.0);
  const auto options = FromProto(proto, Unlike(), "options");
  EXPECT_EQ(options->gas.refresh_period_s, 9.0);
  EXPECT_EQ(options->gas.ageing_half_life_s, Unlike().gas.ageing_half_life_s);
}

TEST(OptionsTest, RefusalNamesTheFieldOfTheWire) {
  v1::MissionOptions proto;
  proto.mutable_gas()->set_prior_precision_per_ppm2(-1.0);
  const auto options = FromProto(proto, MissionOptions{}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field, "options.gas.prior_precision_per_ppm2");
}

// The message at the path "planning.sites"; below the whole, messages beside those on the way are
// there as well: one corner of a region alone would be refused for want of the other.
Message& MutablePart(Message& whole, const std::string& path) {
  Message* part = &whole;
  const std::vector<std::string> names = absl::StrSplit(path, '.', absl::SkipEmpty());
  for (const std::string& name : names) {
    for (int i = 0; i < part->GetDescriptor()->field_count(); ++i) {
      const FieldDescriptor* field = part->GetDescriptor()->field(i);
      const bool is_part = part != &whole && !field->is_repeated() &&
                           field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
      if (is_part) part->GetReflection()->MutableMessage(part, field);
    }
    part =
        part->GetReflection()->MutableMessage(part, part->GetDescriptor()->FindFieldByName(name));
  }
  return *part;
}

// The words Validate uses are mapped to the wire by a table: a row that is missing would name a
// field that no client knows.
void ExpectBadNumbersNamed(const Message& part, const std::string& path) {
  for (int i = 0; i < part.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = part.GetDescriptor()->field(i);
    // Named by element, or in a message further down; in tests of their own.
    if (field->is_repeated() || field->name() == "prior_map") continue;
    const std::string name = path.empty() ? field->name() : path + "." + field->name();
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      ExpectBadNumbersNamed(part.GetReflection()->GetMessage(part, field), name);
    }
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
    v1::MissionOptions proto;
    Message* spoilt = &MutablePart(proto, path);
    spoilt->GetReflection()->SetDouble(spoilt, field, std::numeric_limits<double>::quiet_NaN());
    const auto violations = FieldViolations(FromProto(proto, MissionOptions{}, "options").status());
    ASSERT_EQ(violations.size(), 1u) << name;
    EXPECT_EQ(violations[0].field, "options." + name);
  }
}

TEST(OptionsTest, NanIsRefusedInEveryFieldByItsName) {
  ExpectBadNumbersNamed(v1::MissionOptions::default_instance(), "");
}

TEST(OptionsTest, UnknownEnumIsNoSilentDefault) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_cost(static_cast<v1::CostKind>(99));
  const auto options = FromProto(proto, MissionOptions{}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field, "options.planning.cost");
}

TEST(OptionsTest, OverlongStrategyNameIsRefused) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy(std::string(100'000, 'x'));
  const absl::Status status = FromProto(proto, MissionOptions{}, "options").status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_LT(status.message().size(), 300u);
}

TEST(OptionsTest, ARegionWantsBothOfItsCorners) {
  v1::MissionOptions proto;
  v1::Rectangle& region = *proto.mutable_planning()->mutable_sites()->mutable_region();
  const auto blamed = [&] {
    return FieldViolations(FromProto(proto, MissionOptions{}, "options").status()).at(0).field;
  };
  EXPECT_EQ(blamed(), "options.planning.sites.region.min");
  region.mutable_min()->set_x_m(1.0);
  EXPECT_EQ(blamed(), "options.planning.sites.region.max");
  region.mutable_max()->set_x_m(0.0);
  EXPECT_EQ(blamed(), "options.planning.sites.region.max.x_m") << "left of the other corner";
}

TEST(OptionsTest, MoreSamplesThanCandidatesAreNamedAsOnTheWire) {
  v1::MissionOptions proto;
  proto.mutable_planning()->mutable_sites()->set_candidate_count(5);
  proto.mutable_planning()->mutable_sites()->set_cycle_sample_count(6);
  const auto options = FromProto(proto, MissionOptions{}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field,
            "options.planning.sites.cycle_sample_count");
}

// Else scans of old journals would be doubted, which events that follow know nothing of.
TEST(OptionsTest, JournalsThatDoNotNameKeptScansKeptNone) {
  EXPECT_FALSE(FromProto(v1::MissionOptions(), RecordedDefaults(), "options")->keep_scans);
  EXPECT_TRUE(FromProto(ToProto(MissionOptions()), RecordedDefaults(), "options")->keep_scans);
}

// Else robots would be doubted while maps were rebuilt, which events that follow know nothing of.
TEST(OptionsTest, JournalsThatDoNotNameMisleadingMovesWereMisledByAny) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->misleading_move_m;
  };
  EXPECT_EQ(of(v1::MissionOptions()), 0.0);
  EXPECT_EQ(of(ToProto(MissionOptions())), MissionOptions().misleading_move_m);
}

TEST(OptionsTest, JournalsThatDoNotNameASpeedTookPosesFromAnywhere) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->max_robot_speed_mps;
  };
  EXPECT_EQ(of(v1::MissionOptions()), 0.0);
  EXPECT_EQ(of(ToProto(MissionOptions())), MissionOptions().max_robot_speed_mps);
}

TEST(OptionsTest, JournalsThatDoNotNameTheNoiseOfMapsDidNotEstimateIt) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->gas.estimate_noise;
  };
  EXPECT_FALSE(of(v1::MissionOptions()));
  EXPECT_TRUE(of(ToProto(MissionOptions())));
}

TEST(OptionsTest, JournalsThatDoNotNameTheDepthOfSurfacesTookReturnsWhereTheyEnd) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->occupancy.surface_depth_m;
  };
  EXPECT_EQ(of(v1::MissionOptions()), 0.0);
  EXPECT_EQ(of(ToProto(MissionOptions())), MissionOptions().occupancy.surface_depth_m);
}

TEST(OptionsTest, JournalsThatDoNotNameTheDiscountOfTheUnreadToldTheFieldAsItIs) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->gas.unread_discount_ratio;
  };
  EXPECT_EQ(of(v1::MissionOptions()), 0.0);
  EXPECT_EQ(of(ToProto(MissionOptions())), MissionOptions().gas.unread_discount_ratio);
}

TEST(OptionsTest, JournalsThatDoNotNameGustsHadVariancesByThoseOfTheField) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->gas.gust_ratio;
  };
  EXPECT_EQ(of(v1::MissionOptions()), 0.0);
  EXPECT_EQ(of(ToProto(MissionOptions())), MissionOptions().gas.gust_ratio);
}

TEST(OptionsTest, JournalsThatDoNotNameAreasHadTheBackgroundOfAGasCell) {
  const auto of = [](const v1::MissionOptions& proto) {
    return FromProto(proto, RecordedDefaults(), "options")->gas.background_by_area;
  };
  EXPECT_FALSE(of(v1::MissionOptions()));
  EXPECT_TRUE(of(ToProto(MissionOptions())));
}

TEST(OptionsTest, JournalsThatDoNotNameNoiseByLevelHadOneScale) {
  v1::MissionOptions proto;
  proto.mutable_gas()->set_estimate_noise(true);
  EXPECT_FALSE(FromProto(proto, RecordedDefaults(), "options")->gas.noise_by_level);
  EXPECT_TRUE(FromProto(proto, MissionOptions(), "options")->gas.noise_by_level);
}

}  // namespace options_test
}  // namespace plumescout
