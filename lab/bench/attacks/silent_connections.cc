// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>

#include <algorithm>
#include <memory>

#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/attacks/raw_connection.h"

namespace plumescout::lab {
namespace {

constexpr int kConnections = 1100;
constexpr int kDescriptors = 1024;  // of the server, unless it asks for more
constexpr rlim_t kOwnDescriptors = 4096;

absl::Status RaiseOwnLimit() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = std::max(limit.rlim_cur, std::min(kOwnDescriptors, limit.rlim_max));
  if (limit.rlim_cur < kConnections + 200 || setrlimit(RLIMIT_NOFILE, &limit) != 0) {
    return absl::ResourceExhaustedError("too few descriptors for the attacker");
  }
  return absl::OkStatus();
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_RETURN_IF_ERROR(RaiseOwnLimit());
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed,
                              AttackBed::Start(settings, {.max_descriptors = kDescriptors}));
  std::vector<std::unique_ptr<RawConnection>> connections;
  for (int i = 0; i < kConnections; ++i) {
    auto connection = RawConnection::Open(bed->target());
    if (connection.ok()) connections.push_back(*std::move(connection));
  }
  absl::SleepFor(absl::Seconds(1));
  std::vector<Bar> bars = bed->Judge(bed->Take());
  connections.clear();
  absl::SleepFor(absl::Seconds(1));
  bars.push_back(MustHold("newcomer not served afterwards", bed->IsNewcomerServed()));
  return bars;
}

}  // namespace

Attack SilentConnectionsAttack() {
  return {"silent_connections", "1,100 silent connections to a server with 1,024 descriptors",
          "the listener never accepts again", &Run};
}

}  // namespace plumescout::lab
