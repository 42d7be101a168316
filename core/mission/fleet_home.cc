// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Of the fleet: what robots tell of themselves, where home is, and who is sent there.

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/mission/fleet.h"
#include "core/mission/observation_check.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// A robot with a low battery takes work up again when it has so much more than would be low: what a
// battery tells goes up and down with what is drawn from it.
constexpr double kChargedShare = 0.1;

absl::Status NotRegistered(const RobotId& robot) {
  return absl::NotFoundError(absl::StrCat("robot \"", robot, "\" is not registered"));
}

}  // namespace

std::optional<WayPoint> Fleet::StartOf(const RobotId& robot) const {
  const Member& member = robots_.at(robot);
  if (!member.record.first_place) return std::nullopt;
  return WayPoint{member.first_ns,
                  {member.record.first_place->x_m, member.record.first_place->y_m, 0.0}};
}

std::optional<WayPoint> Fleet::LatestOf(const RobotId& robot) const {
  const RobotRecord& record = robots_.at(robot).record;
  if (!record.state.has_pose || record.pose_ns == 0) return std::nullopt;
  return WayPoint{record.pose_ns, record.state.pose};
}

absl::Status Fleet::NoteClock(const ClockOffsetNoted& noted) {
  Member* const member = Find(noted.robot);
  if (member == nullptr) return NotRegistered(noted.robot);
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("offset_ns", noted.offset_ns, -kMaxClockOffset_ns, kMaxClockOffset_ns)
          .status());
  std::int64_t& offset_ns = member->record.state.clock_offset_ns;
  if (offset_ns != noted.offset_ns) member->clock.End(offset_ns);
  offset_ns = noted.offset_ns;
  return absl::OkStatus();
}

std::int64_t Fleet::MissionTime_ns(const RobotId& robot, std::int64_t robot_ns) const {
  const Member& member = robots_.at(robot);
  return member.clock.MissionTime_ns(robot_ns, member.record.state.clock_offset_ns);
}

absl::Status Fleet::OrderHome(const HomeOrdered& order) {
  Member* const member = Find(order.robot);
  if (member == nullptr) return NotRegistered(order.robot);
  member->record.state.ordered_home = order.home;
  if (order.home) HandBackClaim(*member);
  return absl::OkStatus();
}

void Fleet::TakeStatus(const RobotStatus& status, Member& member) {
  RobotRecord& record = member.record;
  record.state.battery_share = status.battery_share;
  if (status.battery_share < low_battery_share_) {
    record.battery_low = true;
    HandBackClaim(member);
  } else if (status.battery_share >= std::min(1.0, low_battery_share_ + kChargedShare)) {
    record.battery_low = false;
  }
}

void Fleet::HandBackClaim(Member& member) {
  if (member.live) member.live->handed_back = true;
  CompleteIfAllAre();
}

}  // namespace plumescout
