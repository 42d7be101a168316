// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "lab/sim/faulty_link.h"

namespace plumescout::lab {

enum class OutageKind {
  kLinkLost,  // the robot drives on, keeps what it senses, and sends it afterwards
  kSilent,    // it is switched off, or has died, and stands where it is
  kLeaves,    // it takes leave of the mission, and stands where it is
};

// A stretch of an episode for which a robot is not what it should be. Who was silent or has left
// comes back by registering again.
struct Outage {
  OutageKind kind = OutageKind::kLinkLost;
  double at_s = 0.0;                           // of the world's time, (1e-6, 1e6]
  std::optional<double> for_s = std::nullopt;  // (0, 1e6]; none, but not of a lost link: for good

  double end_s() const { return for_s ? at_s + *for_s : std::numeric_limits<double>::infinity(); }

  friend bool operator==(const Outage&, const Outage&) = default;
};

// Of one robot: kInvalidArgument naming field, value and range; also if they are not in order, or
// one begins before the last has ended.
absl::Status Validate(const std::vector<Outage>& outages);

// How the robot's link stands at a time.
LinkState LinkAt(const std::vector<Outage>& outages, double time_s);

// The first outage from `time_s` on in which the robot takes no part; null if there is none.
const Outage* NextAbsence(const std::vector<Outage>& outages, double time_s);

// Whether it is that time, but for rounding.
bool HasCome(double due_s, double time_s);

}  // namespace plumescout::lab
