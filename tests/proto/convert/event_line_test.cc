// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/event_line.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

namespace plumescout {
namespace event_line_test {

EventBody Seen(decltype(Observation::payload) payload) {
  ObservationReceived received{"r1", {12, 5'000'000, {2.0, 1.5, 0.0}, {}}};
  received.observation.payload = std::move(payload);
  return received;
}

TEST(EventLineTest, EveryKindHasItsWords) {
  Scan scan;
  scan.ranges_m.resize(360);
  const std::pair<EventBody, std::string> cases[] = {
      {RobotRegistered{"r1", 0.25, 1, 0}, "joins with a radius of 0.25 m"},
      {Seen(scan), "scan 12, 360 beams at (2.00, 1.50)"},
      {Seen(GasReading{7.25, 0.0}), "gas reading 12, 7.25 ppm at (2.00, 1.50)"},
      {Seen(SequenceGap{12, 20}), "observations 12 to 20 are lost"},
      {PosteriorRefreshed{1}, "gas field refreshed"},
      {ProgressReported{"r1", 3, ProgressOutcome::kBlocked}, "plan 3 blocked"},
      {EpochBegun{1}, "gas field is made anew"},
      {EpochAdopted{}, "gas field made anew is adopted"},
      {RobotRemoved{"r1"}, "leaves"},
      {Seen(RobotStatus{0.5}), "battery at 50 %"},
      {ClockOffsetNoted{"r1", -1'500'000'000}, "the mission's time is its clock and -1.500 s"},
      {HomeOrdered{"r1", true}, "is sent home"},
      {KeepOutChanged{{"ramp"}, {{{}, "spill"}, {{}, "pit"}}},
       "keep-out areas: ramp opened; spill, pit closed"}};
  std::set<int> kinds;
  for (const auto& [body, line] : cases) {
    EXPECT_EQ(LineOf(body), line);
    kinds.insert(KindOf(body));
  }
  kinds.insert(KindOf(PlanIssued{}));
  EXPECT_EQ(kinds.size(), 14u);
  EXPECT_EQ(kinds.count(v1::MISSION_EVENT_KIND_UNSPECIFIED), 0u);
}

TEST(EventLineTest, AnOrderThatIsTakenBackSaysSo) {
  EXPECT_EQ(LineOf(HomeOrdered{"r1", false}), "need not go home any more");
}

TEST(EventLineTest, PlansTellWhereTheyLead) {
  PlanIssued issued;
  issued.plan.end = PlanEnd::kNoGoals;
  EXPECT_EQ(LineOf(issued), "plan to stay: there are no goals");
  Candidate candidate;
  candidate.goal.kind = GoalKind::kGasFrontier;
  candidate.goal.position = {4.0, 1.0};
  issued.plan.candidates = {candidate};
  issued.plan.chosen = 0;
  issued.plan.trajectory.waypoints = {{{0.0, 0.0, 0.0}}, {{4.0, 1.0, 0.0}}};
  issued.plan.trajectory.length_m = 4.25;
  issued.plan.trajectory.duration_s = 9.0;
  EXPECT_EQ(LineOf(issued), "plan to a gas frontier at (4.00, 1.00), 4.2 m in 9.0 s");
  issued.assigned = true;
  EXPECT_EQ(LineOf(issued), "assigned plan to a gas frontier at (4.00, 1.00), 4.2 m in 9.0 s");
  issued.assigned = false;
  issued.plan.candidates.clear();  // a journal need not keep them
  EXPECT_EQ(LineOf(issued), "plan to (4.00, 1.00), 4.2 m in 9.0 s");
}

TEST(EventLineTest, EventsNameRobotAndTimeWhereTheyHaveThem) {
  const v1::MissionEvent seen = ToProto({7, Seen(GasReading{1.0, 0.0})}, "hall");
  EXPECT_EQ(seen.number(), 7);
  EXPECT_EQ(seen.robot(), "missions/hall/robots/r1");
  EXPECT_EQ(seen.sample_time_ns(), 5'000'000);
  const v1::MissionEvent adopted = ToProto({8, EpochAdopted{}}, "hall");
  EXPECT_EQ(adopted.robot(), "");
  EXPECT_FALSE(adopted.has_sample_time_ns());
}

}  // namespace event_line_test
}  // namespace plumescout
