// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/mission/conduct/mission_conduct.h"
#include "formats/journal/event_codec.h"
#include "server/missions/mission_recovery.h"
#include "tests/support/ingest_batch.h"
#include "tests/support/same_bytes.h"

namespace plumescout::server {

// Hears of all events.
class EventList final : public ConductObserver {
 public:
  std::vector<Event> events;

 private:
  void OnEvent(const Event& event, const Applied&) override { events.push_back(event); }
};

// The events of a robot's run in a room, with epochs begun and adopted.
inline std::vector<Event> RoomRunEvents(const MissionOptions& options) {
  EventList list;
  MissionConduct conduct(std::make_unique<Mission>(options), &list);
  EXPECT_TRUE(conduct.Register({"r1", 0.2, 7}).ok());
  EXPECT_TRUE(conduct.Ingest("r1", 7, support::RoomRunBatch()).status.ok());
  return list.events;
}

// Puts a mission with these events into the store; returns when they are durable.
inline void PutMission(MissionStore& store, const std::string& key, const MissionOptions& options,
                       const std::vector<Event>& events) {
  const auto epoch = store.Create(key, EncodeMissionStart({"", "", key}, options));
  ASSERT_TRUE(epoch.ok()) << epoch.status();
  std::vector<std::string> records;
  for (const Event& event : events) records.push_back(EncodeEvent(event, PlanDetail::kForReplay));
  absl::Notification durable;
  store.Append(key, *epoch, 1, std::move(records), [&](const absl::Status& status) {
    EXPECT_TRUE(status.ok()) << status;
    durable.Notify();
  });
  durable.WaitForNotification();
}

// Whether two missions stand at the same place, as far as readers can see.
inline void ExpectSameMission(const Belief& a, const Belief& b) {
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(a.sample_time_ns, b.sample_time_ns);
  EXPECT_EQ(a.posterior_time_ns, b.posterior_time_ns);
  EXPECT_EQ(*a.occupancy, *b.occupancy);
  EXPECT_EQ(*a.traversable, *b.traversable);
  EXPECT_TRUE(support::SameBytes(*a.gas_mean_ppm, *b.gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a.gas_variance_ppm2, *b.gas_variance_ppm2));
  EXPECT_EQ(a.gas_quality, b.gas_quality);
  EXPECT_EQ(a.phase, b.phase);
  ASSERT_EQ(a.robots.size(), b.robots.size());
  for (const auto& [robot, record] : a.robots) {
    EXPECT_EQ(record.state.applied_sequence, b.robots.at(robot).state.applied_sequence);
    EXPECT_EQ(record.last_plan, b.robots.at(robot).last_plan);
  }
}

}  // namespace plumescout::server
