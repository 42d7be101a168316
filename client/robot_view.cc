// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_view.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "client/robot_messages.h"
#include "core/types/status_macros.h"
#include "proto/convert/observation.h"

namespace plumescout::client {

RobotView::RobotView(Participation participation, std::int64_t time_ns)
    : participation_(std::move(participation)),
      encoder_("plumescout robot", McapCompression::kZstd, kChunkBytes),
      now_ns_(std::max(std::int64_t{0}, time_ns)) {}

absl::Status RobotView::Add(const RobotNews& news) {
  PLUMESCOUT_RETURN_IF_ERROR(Begin());
  return std::visit([this](const auto& of) { return Show(of); }, news);
}

absl::Status RobotView::NoteGap(std::int64_t missing_news) {
  return Add(SaidLine{true, absl::StrCat("recording: ", missing_news, " messages are missing")});
}

absl::Status RobotView::Finish() {
  PLUMESCOUT_RETURN_IF_ERROR(Begin());
  return encoder_.Finish();
}

absl::Status RobotView::Begin() {
  if (std::exchange(has_begun_, true)) return absl::OkStatus();
  return channels_.Add(kRegistrationTopic, RegistrationOf(participation_), {now_ns_, now_ns_});
}

McapTimes RobotView::TimesAt(std::int64_t time_ns) {
  const std::int64_t own_ns = std::max(std::int64_t{0}, time_ns);
  now_ns_ = std::max(now_ns_, own_ns);
  return {now_ns_, own_ns};
}

absl::Status RobotView::Show(const Observation& observation) {
  const McapTimes times = TimesAt(observation.sample_time_ns);
  PLUMESCOUT_RETURN_IF_ERROR(channels_.Add(kObservationsTopic, ToProto(observation), times));
  return drawing_.DrawObservation(participation_.robot, participation_.frame, observation, times);
}

absl::Status RobotView::Show(const RobotPlace& place) {
  return drawing_.DrawPose(participation_.robot, InMission(participation_.frame, place.pose),
                           TimesAt(place.time_ns));
}

absl::Status RobotView::Show(const PlanGiven& given) {
  Plan plan = given.plan;
  plan.robot = participation_.robot;
  return drawing_.DrawPlan(participation_.mission, plan, TimesAt(given.time_ns));
}

absl::Status RobotView::Show(const PlanEnded&) {
  return drawing_.DrawEndOfPlan(participation_.robot, {now_ns_, now_ns_});
}

absl::Status RobotView::Show(const SaidLine& line) {
  return drawing_.DrawLine(line.is_warning, participation_.robot, line.text, {now_ns_, now_ns_});
}

}  // namespace plumescout::client
