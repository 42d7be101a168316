// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission conduct: epochs that come out of turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "tests/support/ingest_batch.h"

namespace plumescout {
namespace epoch_habit_test {

constexpr std::int64_t kLease = 7;

class Told final : public ConductObserver {
 public:
  std::vector<Event> events;

 private:
  void OnEvent(const Event& event, const Applied&) override { events.push_back(event); }
};

// Events of a run in a room, the robot's log in two halves, between which the mission is taken
// from one conduct to another if `interrupted`.
std::vector<Event> EventsOfRun(std::int64_t events_per_epoch, bool interrupted) {
  Told told;
  auto conduct = std::make_unique<MissionConduct>(std::make_unique<Mission>(MissionOptions{}),
                                                  &told, EpochHabit{events_per_epoch});
  EXPECT_TRUE(conduct->Register(RobotRegistered{"r1", 0.2, kLease}).ok());
  std::vector<IncomingObservation> log = support::RoomRunBatch();
  const auto half = log.begin() + static_cast<std::ptrdiff_t>(log.size() / 2);
  EXPECT_TRUE(conduct->Ingest("r1", kLease, {log.begin(), half}).status.ok());
  if (interrupted) {
    auto replayed = std::make_unique<Mission>(MissionOptions{});
    EpochHabit habit{events_per_epoch};
    for (const Event& event : told.events) {
      EXPECT_TRUE(replayed->Apply(event.body).ok());
      if (std::holds_alternative<EpochAdopted>(event.body)) habit.last_revision = event.number;
    }
    conduct = std::make_unique<MissionConduct>(std::move(replayed), &told, habit);
  }
  EXPECT_TRUE(conduct->Ingest("r1", kLease, {half, log.end()}).status.ok());
  return told.events;
}

template <typename Body>
std::int64_t CountOf(const std::vector<Event>& events) {
  return std::count_if(events.begin(), events.end(),
                       [](const Event& event) { return std::holds_alternative<Body>(event.body); });
}

TEST(EpochHabitTest, EpochsComeAfterSoManyEventsWhoeverRunsTheMission) {
  const std::vector<Event> without = EventsOfRun(0, false);
  const std::vector<Event> with = EventsOfRun(100, false);
  EXPECT_GT(CountOf<EpochAdopted>(with), CountOf<EpochAdopted>(without) + 1);
  EXPECT_LE(CountOf<EpochAdopted>(with), std::ssize(with) / 100);
  EXPECT_EQ(EventsOfRun(100, true), with);
}

}  // namespace epoch_habit_test
}  // namespace plumescout
