// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/clock_gate.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/mission/observation_check.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace {

// A sample time may be any number, so differences may not fit; those that are wanted do.
absl::Duration Lead(std::int64_t sample_time_ns, std::int64_t reference_ns) {
  if (sample_time_ns <= reference_ns) return absl::ZeroDuration();
  const auto lead_ns =
      static_cast<std::uint64_t>(sample_time_ns) - static_cast<std::uint64_t>(reference_ns);
  return absl::Nanoseconds(1) * static_cast<double>(lead_ns);
}

absl::Status ClockAhead(std::int64_t sample_time_ns, absl::Duration lead, absl::Duration max_lead) {
  return TypedError(absl::StatusCode::kInvalidArgument, reason::kClockAhead,
                    absl::StrCat("sample_time_ns = ", sample_time_ns, " must not be more than ",
                                 absl::FormatDuration(max_lead),
                                 " ahead of the server's clock and of the other robots; it is by ",
                                 absl::ToDoubleSeconds(lead), " s"));
}

}  // namespace

ClockGate::ClockGate(ClockGateOptions options, WallClock wall_clock)
    : options_(options), wall_clock_(std::move(wall_clock)) {}

std::int64_t ClockGate::NewestOfOthers_ns(const RobotId& robot) const {
  std::int64_t newest_ns = std::numeric_limits<std::int64_t>::min();
  for (const auto& [id, time_ns] : newest_ns_) {
    if (id != robot) newest_ns = std::max(newest_ns, time_ns);
  }
  return newest_ns;
}

void ClockGate::Pass(const RobotId& robot, std::vector<IncomingObservation>& batch,
                     const std::optional<Mapped>& mapped) {
  if (options_.max_lead <= absl::ZeroDuration()) return;
  const std::int64_t offset_ns = mapped ? mapped->offset_ns : 0;
  const std::int64_t now_ns = mapped ? mapped->now_ns : wall_clock_();
  const std::int64_t latest_ns = now_ns + absl::ToInt64Nanoseconds(options_.max_lead);
  const std::int64_t reference_ns = mapped ? now_ns : std::max(now_ns, NewestOfOthers_ns(robot));
  for (IncomingObservation& incoming : batch) {
    if (!incoming.unreadable.ok()) continue;
    Observation& observation = incoming.observation;
    const absl::Duration lead = Lead(MissionTime_ns(observation, offset_ns), reference_ns);
    if (lead > options_.max_lead) {
      if (std::holds_alternative<SequenceGap>(observation.payload)) {
        observation.sample_time_ns = 0;
      } else if (options_.stamp_by_arrival) {
        observation.sample_time_ns = std::max<std::int64_t>(0, now_ns - offset_ns);
      } else {
        incoming.unreadable = ClockAhead(observation.sample_time_ns, lead, options_.max_lead);
        continue;
      }
    }
    std::int64_t& newest_ns = newest_ns_[robot];
    newest_ns = std::max(newest_ns, std::min(MissionTime_ns(observation, offset_ns), latest_ns));
  }
}

}  // namespace plumescout::server
