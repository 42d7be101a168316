// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "absl/status/status.h"
#include "client/join.h"
#include "core/types/observation.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "formats/draw/robot_drawing.h"
#include "formats/draw/typed_channels.h"
#include "formats/mcap/mcap_encoder.h"

namespace plumescout::client {

inline constexpr char kRegistrationTopic[] = "/registration";
inline constexpr char kObservationsTopic[] = "/observations";

// Where a robot was, in its own frame and by its own clock.
struct RobotPlace {
  std::int64_t time_ns = 0;
  Pose2 pose;
};

// A plan that it was given.
struct PlanGiven {
  std::int64_t time_ns = 0;
  Plan plan;
};

// It does not follow its plan any more.
struct PlanEnded {};

// What is said to people.
struct SaidLine {
  bool is_warning = false;
  std::string text;
};

// What a robot's program has to tell of its run. Observations are those of its log.
using RobotNews = std::variant<Observation, RobotPlace, PlanGiven, PlanEnded, SaidLine>;

// A robot's run as an MCAP file: what the server is told, as it goes over the wire, and what
// viewers draw of it (formats/draw/robot_drawing.h).
//
//   topic          schema                               when
//   /registration  plumescout.v1.RegisterRobotRequest   first: who it is, its frame and its sensors
//   /observations  plumescout.v1.Observation            each entry of its log, in their order
//
// Times are those of the robot's clock: that of the log never goes back, that of publication is the
// message's own. Memory: as of McapEncoder. Single-threaded.
class RobotView {
 public:
  // A robot says some 25 kB a second, and its memory is small.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 19;

  // The file begins at `time_ns`.
  RobotView(Participation participation, std::int64_t time_ns);

  // Errors as of McapEncoder::Add.
  absl::Status Add(const RobotNews& news);
  // The log says that so much of what was to be told is missing here.
  absl::Status NoteGap(std::int64_t missing_news);
  // As of McapEncoder.
  absl::Status EndChunk() { return encoder_.EndChunk(); }
  absl::Status Finish();
  std::string Take() { return encoder_.Take(); }

  std::int64_t now_ns() const { return now_ns_; }  // of the log

 private:
  // The message's own time, and that of the log, which may go on by it.
  McapTimes TimesAt(std::int64_t time_ns);
  absl::Status Begin();
  absl::Status Show(const Observation& observation);
  absl::Status Show(const RobotPlace& place);
  absl::Status Show(const PlanGiven& given);
  absl::Status Show(const PlanEnded& ended);
  absl::Status Show(const SaidLine& line);

  const Participation participation_;
  McapEncoder encoder_;
  TypedChannels channels_{&encoder_};
  RobotDrawing drawing_{&channels_};
  std::int64_t now_ns_;
  bool has_begun_ = false;
};

}  // namespace plumescout::client
