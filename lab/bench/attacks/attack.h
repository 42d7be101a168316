// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "lab/bench/bars.h"

namespace plumescout::lab {

struct AttackSettings {
  std::string server_program;
  absl::Duration time = absl::Seconds(6);      // of what takes as long as one likes
  absl::Duration warm_up = absl::Seconds(2);   // of honest callers
  absl::Duration patience = absl::Seconds(5);  // of theirs; a call that takes longer has failed
  std::uint64_t seed = 1;
  std::string front_config;    // of HAProxy, for attacks that a front is to stop; empty: no front
  bool beside_others = false;  // other work keeps the processors busy
};

// Something that a client might do to a server, out of malice or by mistake, and what honest robots
// and operators may notice of it.
struct Attack {
  std::string name;
  std::string what;    // it does
  std::string before;  // what it did to a server without limits
  absl::StatusOr<std::vector<Bar>> (*run)(const AttackSettings&) = nullptr;
};

// One a file.
Attack WaitersAttack();
Attack KnownMapAttack();
Attack FarScansAttack();
Attack NarrowBeamsAttack();
Attack SilentConnectionsAttack();
Attack RapidResetAttack();
Attack HalfRequestsAttack();
Attack LongPlansAttack();
Attack WatchersAttack();
Attack KnownMapReadersAttack();
Attack DeleteBusyAttack();
Attack StopInRefreshAttack();
Attack LogUnreadAttack();
Attack ManyStreamsAttack();
Attack ScatteredReadingsAttack();

}  // namespace plumescout::lab
