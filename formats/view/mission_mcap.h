// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/map_snapshot.h"
#include "formats/journal/event_codec.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/view/typed_channels.h"

namespace plumescout {

// A mission as an MCAP file: the journal to replay it from (formats/mcap/mcap_journal.h), and what
// viewers draw. The mission is replayed for that, event by event.
//
//   topic                 schema                    when
//   /journal              -                         the start, then each event
//   /plans                plumescout.v1.Plan        each plan
//   /log                  foxglove.Log              what happens, in words; not each observation
//   /map/occupancy        foxglove.Grid             every map_period_s, and at the end
//   /map/gas/mean         foxglove.Grid             as above; of several gases /map/gas/NAME/mean
//   /map/gas/stddev       foxglove.Grid             as above
//   /scene/frontiers      foxglove.SceneUpdate      as above
//   /scene/plans          foxglove.SceneUpdate      the ways of live plans
//   /robots/NAME/pose     foxglove.PoseInFrame      every 0.2 s
//   /robots/NAME/scan     foxglove.LaserScan        every second
//   /robots/NAME/gas      plumescout.v1.Observation  each reading
//
// Times are the mission's (sample time): that of the log is when the mission had the message, so it
// never goes back; that of publication is the message's own. Before the first observation it is
// that of the first observation; of what comes before that in more than kMostEarlyBytes it is 0.
// Memory: that of the mission, kMostEarlyBytes, and as of McapEncoder. The same events give the
// same bytes. Single-threaded.
class MissionMcap {
 public:
  // Of records that wait for the first observation, which has the first time.
  static constexpr std::size_t kMostEarlyBytes = std::size_t{1} << 20;

  // `mission` is that of the start's options, before its first event. `map_period_s` is in the
  // mission's time, at least; 0: after each event.
  MissionMcap(const JournalStart& start, std::unique_ptr<Mission> mission, double map_period_s);

  // Applies the event. `record` is its bytes in a journal. kDataLoss if the mission refuses the
  // event or gives it another number; kInternal as of McapEncoder.
  absl::Status Add(const Event& event, absl::string_view record);
  // The file ends here.
  absl::Status Finish();

  // As of McapEncoder.
  std::string Take() { return encoder_.Take(); }
  std::size_t ready_bytes() const { return encoder_.ready_bytes(); }
  const Mission& mission() const { return *mission_; }

 private:
  // What of a robot was shown last, by the message's own time.
  struct Shown {
    std::optional<std::int64_t> pose_ns;
    std::optional<std::int64_t> scan_ns;
  };

  absl::Status AddRecord(std::int64_t number, absl::string_view record, McapTimes times);
  absl::Status Show(const Event& event, const Applied& applied, McapTimes times);
  absl::Status ShowObservation(const ObservationReceived& received, McapTimes times);
  absl::Status ShowPlan(const Plan& issued, PlanId id, McapTimes times);
  absl::Status ShowLog(const Event& event, const Applied& applied, McapTimes times);
  absl::Status ShowMap();
  absl::Status Begin();

  // An event that came before the first observation, and so before there is a time.
  struct Early {
    std::string record;
    Applied applied;
  };

  const std::string mission_id_;
  const std::string start_;  // as a record
  const std::int64_t map_period_ns_;
  std::unique_ptr<Mission> mission_;
  McapEncoder encoder_;
  TypedChannels channels_{&encoder_};
  const std::uint16_t journal_;  // channel
  std::vector<Early> early_;
  std::size_t early_bytes_ = 0;
  bool has_begun_ = false;
  std::int64_t now_ns_ = 0;
  std::map<RobotId, Shown> shown_;
  std::optional<std::int64_t> map_ns_;  // when the map was shown last
  std::int64_t map_revision_ = -1;      // which
};

}  // namespace plumescout
