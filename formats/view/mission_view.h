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
#include "core/belief/belief.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/map_snapshot.h"
#include "formats/draw/robot_drawing.h"
#include "formats/draw/typed_channels.h"
#include "formats/journal/event_codec.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/view/map_ration.h"

namespace google::protobuf {
class Message;
}  // namespace google::protobuf

namespace plumescout {

// What happened in a mission, and what a file of it is to say of how things stood after it.
struct MissionMoment {
  Event event;
  std::string record;  // of the event in a journal
  Applied applied;
  std::int64_t sample_time_ns = 0;                 // the mission's
  std::optional<RobotState> robot = std::nullopt;  // of an observation
  std::shared_ptr<const Belief> belief = nullptr;  // if the map is to be shown
};

// When the map of a mission is shown: not before it has seen anything, and then at most once in a
// period of its own time.
class MapTimer {
 public:
  // 0: after each event.
  explicit MapTimer(double period_s);
  // Whether it is time after this event; notes that it is shown then.
  bool IsDue(const Event& event, std::int64_t sample_time_ns);

 private:
  const std::int64_t period_ns_;
  bool has_seen_ = false;
  std::optional<std::int64_t> shown_ns_;
};

// Of a mission that has just applied the event, without its record.
MissionMoment MomentAfter(Event event, const Applied& applied, const Mission& mission,
                          MapTimer& timer);

// A mission as an MCAP file: the journal to replay it from (formats/mcap/mcap_journal.h), and what
// viewers draw.
//
//   topic                 schema                    when
//   /journal              -                         the start, then each event
//   /map/occupancy        foxglove.Grid             when a moment has the belief and the ration
//                                                   (formats/view/map_ration.h) allows it; at the
//                                                   end
//   /map/gas/mean         foxglove.Grid             as above; of several gases /map/gas/NAME/mean
//   /map/gas/stddev       foxglove.Grid             as above
//   /scene/frontiers      foxglove.SceneUpdate      as above
//
// and what formats/draw/robot_drawing.h draws of robots. The log is not of each observation.
//
// Times are the mission's (sample time): that of the log is when the mission had the message, so it
// never goes back; that of publication is the message's own. Before the first observation it is
// that of the first observation; of what comes before that in more than kMostEarlyBytes it is 0.
// Memory: kMostEarlyBytes, and as of McapEncoder. The same moments give the same bytes.
// Single-threaded.
class MissionView {
 public:
  // Of records that wait for the first observation, which has the first time.
  static constexpr std::size_t kMostEarlyBytes = std::size_t{1} << 20;
  // Of the journal that maps may take.
  static constexpr double kMapShare = 0.1;

  // `map_share`: as of MapRation.
  explicit MissionView(const JournalStart& start, double map_share = kMapShare);

  // Errors as of McapEncoder::Add.
  absl::Status Add(MissionMoment moment);
  // The log says that so many events are missing before this one.
  absl::Status NoteGap(std::int64_t missing_events, std::int64_t event);
  // As of McapEncoder: what was added so far can be read from then on.
  absl::Status EndChunk();
  // The file ends here, with the map as it is; null: it is not known.
  absl::Status Finish(const std::shared_ptr<const Belief>& belief);

  // As of McapEncoder.
  std::string Take() { return encoder_.Take(); }
  std::size_t ready_bytes() const { return encoder_.ready_bytes(); }

 private:
  absl::Status AddRecord(std::int64_t number, absl::string_view record, McapTimes times);
  absl::Status AddShown(const MissionMoment& moment);
  absl::Status Show(const MissionMoment& moment, McapTimes times);
  absl::Status ShowPlan(const Plan& issued, PlanId id, McapTimes times);
  absl::Status ShowLog(const Event& event, const Applied& applied, McapTimes times);
  // What of it was not shown yet, and is allowed to, or has to be for it is the last.
  absl::Status ShowMap(const Belief& belief, bool is_last);
  absl::Status ShowLayer(const std::string& topic, const google::protobuf::Message& layer,
                         std::int64_t revision, bool is_last);
  absl::Status Begin();

  const std::string mission_id_;
  const std::string start_;  // as a record
  McapEncoder encoder_;
  TypedChannels channels_{&encoder_};
  RobotDrawing drawing_{&channels_};
  MapRation ration_;
  const std::uint16_t journal_;       // channel
  std::vector<MissionMoment> early_;  // before the first observation, and so before there is a time
  std::size_t early_bytes_ = 0;
  bool has_begun_ = false;
  std::int64_t now_ns_ = 0;
  std::map<std::string, std::int64_t> shown_revisions_;  // of layers, by their topics
};

}  // namespace plumescout
