// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "lab/bench/bars.h"
#include "lab/bench/load/bystander.h"

namespace plumescout::lab {

struct RowSettings {
  std::string server_program;
  Bystander* bystander = nullptr;           // not null
  absl::Duration time = absl::Seconds(20);  // of each measurement
  std::uint64_t seed = 1;
};

// Each row starts servers of its own.
using Row = absl::StatusOr<std::vector<Bar>>(const RowSettings&);

Row PlanRow;      // 8 robots that scan, smell and plan, with the default strategy and with xit_gff
Row IngestRow;    // 32 robots in 8 missions that only send
Row WatcherRow;   // 300 watchers of one mission, and one robot beside them
Row FloodRow;     // a robot that asks and sends 100 times what it may, beside 7 others
Row MemoryRow;    // random legal requests that ask for memory
Row DurableRow;   // plans with and without a journal; how long acknowledgements wait for the disk
Row RecoveryRow;  // 64 missions after a crash
Row DrainRow;     // how long a server takes to stop, whatever it is at

inline constexpr int kRowWidth = 160;  // of the building in all rows: 16 x 20 m
inline constexpr int kRowHeight = 200;

}  // namespace plumescout::lab
