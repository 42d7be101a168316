// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_seed.h"

#include <algorithm>

#include "core/types/rng.h"

namespace plumescout {
namespace {

std::uint64_t Fnv1a(const RobotId& name) {
  constexpr std::uint64_t kOffset = 0xCBF29CE484222325ULL;
  constexpr std::uint64_t kPrime = 0x100000001B3ULL;
  std::uint64_t hash = kOffset;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

std::uint64_t Stirred(std::uint64_t value) { return Rng(value).Next(); }

}  // namespace

std::uint64_t DerivedPlanSeed(std::uint64_t mission_seed, const RobotId& robot,
                              std::int64_t plans_issued) {
  const std::uint64_t of_robot = Stirred(mission_seed ^ Stirred(Fnv1a(robot)));
  return std::max<std::uint64_t>(Stirred(of_robot + static_cast<std::uint64_t>(plans_issued)), 1);
}

}  // namespace plumescout
