// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumescout::lab {

// What a server may hold, and what tells it so.
struct MemoryBudget {
  double budget_mb = 0.0;
  std::vector<std::string> settings;  // empty for a server that knows no budget

  // What the process may come to hold with its code, stacks and buffers.
  double limit_mb() const { return budget_mb + kBesides_mb; }

 private:
  static constexpr double kBesides_mb = 128.0;
};

// The server's default. Of a server that knows no budget, 1 GiB: what it should do with.
MemoryBudget DefaultBudget(const std::string& server_program);
// 1 GiB for all, in which four missions have room.
MemoryBudget SmallBudget(const std::string& server_program);

// A process beyond this is left alone, for the sake of the machine.
inline constexpr double kUnbearable_mb = 6000.0;

}  // namespace plumescout::lab
