// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/memory_budget.h"

#include <cstdint>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "lab/bench/load/server_process.h"

namespace plumescout::lab {
namespace {

constexpr char kAll[] = "limits.memory_budget_bytes";
constexpr char kMission[] = "mission.memory_budget_bytes";
constexpr std::int64_t kSmall_bytes = std::int64_t{1} << 30;
constexpr int kMissions = 4;
constexpr double kBytesPerMb = 1 << 20;

}  // namespace

MemoryBudget DefaultBudget(const std::string& server_program) {
  MemoryBudget budget;
  double bytes = 0.0;
  const bool known = absl::SimpleAtod(DefaultOf(server_program, kAll).value_or(""), &bytes);
  budget.budget_mb = (known ? bytes : static_cast<double>(kSmall_bytes)) / kBytesPerMb;
  return budget;
}

MemoryBudget SmallBudget(const std::string& server_program) {
  MemoryBudget budget;
  budget.budget_mb = static_cast<double>(kSmall_bytes) / kBytesPerMb;
  if (DefaultOf(server_program, kAll).has_value()) {
    budget.settings.push_back(absl::StrCat(kAll, "=", kSmall_bytes));
  }
  if (DefaultOf(server_program, kMission).has_value()) {
    budget.settings.push_back(absl::StrCat(kMission, "=", kSmall_bytes / kMissions));
  }
  return budget;
}

}  // namespace plumescout::lab
