// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/observation.h"

namespace plumescout::client {

// Entries of a log got other numbers, in step: who was `from` is `to` now. Entries before that are
// gone.
struct Renumbering {
  std::int64_t from = 1;
  std::int64_t to = 1;

  friend bool operator==(const Renumbering&, const Renumbering&) = default;
};

// A robot's log as it was when a process of the robot ended.
struct KeptLog {
  std::int64_t epoch = 0;             // see RobotRegistered
  std::int64_t last_sequence = 0;     // numbers up to here are taken
  std::int64_t applied_sequence = 0;  // as last written down; the server may be further
  std::int64_t durable_sequence = 0;  // likewise
  // Numbers ascend; those that are missing were dropped or lost.
  std::vector<Observation> entries = {};
};

}  // namespace plumescout::client
