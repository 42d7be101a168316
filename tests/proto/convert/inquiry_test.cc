// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/inquiry.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "proto/convert/enums.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace inquiry_test {

constexpr double kLimit_m = 100.0;

google::protobuf::RepeatedPtrField<v1::Point2D> Points(int count, double x_m = 1.0) {
  google::protobuf::RepeatedPtrField<v1::Point2D> points;
  for (int i = 0; i < count; ++i) {
    v1::Point2D& point = *points.Add();
    point.set_x_m(x_m);
    point.set_y_m(i * 1e-3);
  }
  return points;
}

TEST(InquiryTest, PointsKeepTheirOrder) {
  const auto points = PointsFromProto(Points(kMaxPoints), kLimit_m, "points");
  ASSERT_TRUE(points.ok()) << points.status();
  ASSERT_EQ(points->size(), static_cast<std::size_t>(kMaxPoints));
  EXPECT_EQ(points->front(), (Point2{1.0, 0.0}));
  EXPECT_EQ(points->back(), (Point2{1.0, (kMaxPoints - 1) * 1e-3}));
}

TEST(InquiryTest, NoPointsAndTooManyAreRefused) {
  for (const int count : {0, kMaxPoints + 1}) {
    const auto points = PointsFromProto(Points(count), kLimit_m, "points");
    EXPECT_EQ(FieldViolations(points.status()).at(0).field, "points");
  }
}

TEST(InquiryTest, PointsAreWithinTheLimit) {
  EXPECT_TRUE(PointsFromProto(Points(1, -kLimit_m), kLimit_m, "points").ok());
  for (const double bad : {101.0, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    const auto points = PointsFromProto(Points(1, bad), kLimit_m, "path.vertices");
    EXPECT_EQ(FieldViolations(points.status()).at(0).field, "path.vertices[0].x_m");
  }
}

TEST(InquiryTest, AFreePathHasAPriceAndNoObjections) {
  TrajectoryVerdict check;
  check.rest = Candidate{};
  check.rest->length_m = 2.5;
  const v1::CheckTrajectoryResponse proto = ToProto(check);
  EXPECT_EQ(proto.rest().length_m(), 2.5);
  EXPECT_FALSE(proto.has_blockage() || proto.has_rejected_goal());
}

TEST(InquiryTest, ABlockedPathSaysWhereAndWhy) {
  TrajectoryVerdict check;
  check.blockage = Blockage{{3, 4}, {0.3, 0.45}, 1.25, CellState::kOccupied};
  check.rejection = RejectedGoal{{}, RejectionReason::kGone, "no frontier"};
  const v1::CheckTrajectoryResponse proto = ToProto(check);
  EXPECT_EQ(proto.blockage().cell().row(), 4);
  EXPECT_EQ(proto.blockage().position().x_m(), 0.3);
  EXPECT_EQ(proto.blockage().distance_m(), 1.25);
  EXPECT_EQ(proto.blockage().state(), v1::CELL_STATE_OCCUPIED);
  EXPECT_EQ(proto.rejected_goal().reason(), v1::RejectedGoal::REASON_GONE);
  EXPECT_FALSE(proto.has_rest());
}

TEST(InquiryTest, FrontiersSayHowFarTheyAreAndWhyNot) {
  JudgedFrontier frontier;
  frontier.goal.frontier_cells = 7;
  frontier.travel_m = 3.5;
  v1::FrontierGoal proto = ToProto(frontier);
  EXPECT_EQ(proto.goal().frontier_cell_count(), 7);
  EXPECT_EQ(proto.travel_m(), 3.5);
  EXPECT_EQ(proto.reason(), v1::RejectedGoal::REASON_UNSPECIFIED);
  frontier.travel_m.reset();
  frontier.rejection = RejectedGoal{{}, RejectionReason::kClaimed, "by robot r2"};
  proto = ToProto(frontier);
  EXPECT_FALSE(proto.has_travel_m());
  EXPECT_EQ(proto.reason(), v1::RejectedGoal::REASON_CLAIMED);
  EXPECT_EQ(proto.detail(), "by robot r2");
}

TEST(InquiryTest, GasIsAbsentWhereThereIsNone) {
  const v1::GasAtPoint measured = ToProto(GasAtPlace{CellState::kFree, 0.0, 0.5, true});
  EXPECT_TRUE(measured.has_mean_ppm() && measured.observed());
  EXPECT_EQ(measured.variance_ppm2(), 0.5);
  const v1::GasAtPoint outside = ToProto(GasAtPlace{});
  EXPECT_EQ(outside.state(), v1::CELL_STATE_OFF_MAP);
  EXPECT_FALSE(outside.has_mean_ppm() || outside.has_variance_ppm2() || outside.observed());
  EXPECT_FALSE(outside.has_nearest_reading_m() || outside.has_nearest_reading_time_ns());
  GasAtPlace old;
  old.nearest_reading = NearestReading{1.5, std::nullopt};
  EXPECT_EQ(ToProto(old).nearest_reading_m(), 1.5);
  EXPECT_FALSE(ToProto(old).has_nearest_reading_time_ns());
}

TEST(InquiryTest, EveryStateOfACellHasAName) {
  EXPECT_EQ(ToProto(std::optional(CellState::kUnknown)), v1::CELL_STATE_UNKNOWN);
  EXPECT_EQ(ToProto(std::optional(CellState::kFree)), v1::CELL_STATE_FREE);
}

TEST(InquiryTest, AnswersComeBackAsTheyWere) {
  TrajectoryVerdict verdict;
  verdict.blockage = Blockage{{3, 4}, {0.3, 0.45}, 1.25, std::nullopt};
  verdict.rejection = RejectedGoal{{}, RejectionReason::kGone, "no frontier"};
  const auto blocked = FromProto(ToProto(verdict));
  ASSERT_TRUE(blocked.ok()) << blocked.status();
  EXPECT_EQ(blocked->blockage->cell, (Cell{3, 4}));
  EXPECT_EQ(blocked->blockage->position, (Point2{0.3, 0.45}));
  EXPECT_EQ(blocked->blockage->distance_m, 1.25);
  EXPECT_EQ(blocked->blockage->state, std::nullopt);
  EXPECT_EQ(blocked->rejection, verdict.rejection);
  EXPECT_EQ(blocked->rest, std::nullopt);

  JudgedFrontier judged;
  judged.goal.frontier_cells = 7;
  judged.travel_m = 3.5;
  judged.rejection = RejectedGoal{judged.goal, RejectionReason::kClaimed, "by r2"};
  const auto frontier = FromProto(ToProto(judged), "frontiers[0]");
  ASSERT_TRUE(frontier.ok()) << frontier.status();
  EXPECT_EQ(frontier->goal, judged.goal);
  EXPECT_EQ(frontier->travel_m, 3.5);
  EXPECT_EQ(frontier->rejection, judged.rejection);

  const auto gas = FromProto(
      ToProto(GasAtPlace{CellState::kFree, 2.0, 0.5, true, NearestReading{1.5, 7}}), "gas[0]");
  ASSERT_TRUE(gas.ok()) << gas.status();
  EXPECT_EQ(gas->state, CellState::kFree);
  EXPECT_EQ(gas->mean_ppm, 2.0);
  EXPECT_EQ(gas->variance_ppm2, 0.5);
  EXPECT_TRUE(gas->observed);
  EXPECT_EQ(gas->nearest_reading, (NearestReading{1.5, 7}));
  EXPECT_EQ(FromProto(ToProto(GasAtPlace{}), "gas[0]")->nearest_reading, std::nullopt);
  EXPECT_EQ(FromProto(ToProto(GasAtPlace{}), "gas[0]")->verdict, std::nullopt);
  for (const ObjectiveVerdict verdict :
       {ObjectiveVerdict::kDoesNotCount, ObjectiveVerdict::kNotMeasured,
        ObjectiveVerdict::kUndecided, ObjectiveVerdict::kDecided, ObjectiveVerdict::kRefuted}) {
    GasAtPlace judged_place;
    judged_place.verdict = verdict;
    EXPECT_EQ(FromProto(ToProto(judged_place), "gas[0]")->verdict, verdict);
  }
}

TEST(InquiryTest, AnswersThatCannotBeReadAreBlamedOnTheirField) {
  v1::CheckTrajectoryResponse check;
  check.mutable_blockage()->set_distance_m(-1.0);
  EXPECT_EQ(FieldViolations(FromProto(check).status()).at(0).field, "blockage.distance_m");
  EXPECT_EQ(FieldViolations(FromProto(v1::GasAtPoint(), "gas[2]").status()).at(0).field,
            "gas[2].state");
}

}  // namespace inquiry_test
}  // namespace plumescout
