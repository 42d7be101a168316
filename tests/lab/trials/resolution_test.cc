// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/resolution.h"

#include <gtest/gtest.h>

#include <vector>

namespace plumescout::lab {
namespace resolution_test {

constexpr double kLimit_s = 10'000.0;

SamplingDrive Drive(double elapsed_s, const ErrorCurve& errors) {
  SamplingDrive drive;
  drive.elapsed_s = elapsed_s;
  drive.errors = errors;
  return drive;
}

// Ends with an error of 2 ppm, which it first has after 4,000 s.
const SamplingDrive kSweep = Drive(6'000.0, {{0.0, 9.0}, {4'000.0, 2.0}, {6'000.0, 2.0}});
const SamplingDrive kQuick = Drive(9'000.0, {{0.0, 9.0}, {1'000.0, 1.5}, {9'000.0, 3.0}});
const SamplingDrive kNever = Drive(9'000.0, {{0.0, 9.0}, {9'000.0, 2.1}});

TEST(ResolutionTest, IsOneOfTheSweepItself) {
  const std::vector<SamplingDrive> sweeps = {kSweep};
  const Resolution own = Resolve(sweeps, sweeps, kLimit_s);
  EXPECT_EQ(own.times_faster, 1.0);
  EXPECT_EQ(own.resolved, 1);
}

TEST(ResolutionTest, CountsUntilADriveIsFirstAsGoodAsTheSweepIsInTheEnd) {
  const Resolution quick = Resolve(std::vector{kQuick}, std::vector{kSweep}, kLimit_s);
  EXPECT_EQ(quick.times_faster, 4.0);
  EXPECT_EQ(quick.resolved, 1);
}

TEST(ResolutionTest, CountsADriveThatIsNeverAsGoodWithAllTheTimeThereWas) {
  const Resolution never = Resolve(std::vector{kNever}, std::vector{kSweep}, kLimit_s);
  EXPECT_EQ(never.times_faster, 4'000.0 / kLimit_s);
  EXPECT_EQ(never.resolved, 0);
}

TEST(ResolutionTest, ComparesMeanTimesOverAllStarts) {
  const std::vector<SamplingDrive> drives = {kQuick, kNever};
  const Resolution both = Resolve(drives, std::vector{kSweep, kSweep}, kLimit_s);
  EXPECT_EQ(both.times_faster, 8'000.0 / 11'000.0);
  EXPECT_EQ(both.resolved, 1);
}

TEST(ResolutionTest, TakesTheSweepFromTheSameStart) {
  const SamplingDrive rough = Drive(5'000.0, {{0.0, 9.0}, {5'000.0, 2.5}});
  const std::vector<SamplingDrive> drives = {kQuick, kNever};
  const Resolution both = Resolve(drives, std::vector{kSweep, rough}, kLimit_s);
  EXPECT_EQ(both.resolved, 2);
  EXPECT_EQ(both.times_faster, 9'000.0 / 10'000.0);
}

TEST(ResolutionTest, ALimitIsTheSameForAll) {
  // Below 1.8 ppm: the sweep never, the quick drive after 1,000 s.
  const Resolution limited = Resolve(std::vector{kQuick}, std::vector{kSweep}, kLimit_s, 1.8);
  EXPECT_EQ(limited.times_faster, 10.0);
  EXPECT_EQ(limited.resolved, 1);
  EXPECT_EQ(limited.sweeps_resolved, 0);
}

using Worlds = std::vector<std::vector<SamplingDrive>>;

TEST(ResolutionTest, WorldsAreTheUnit) {
  // 4 times as fast in one, as fast in the other, however many drives there are: sqrt(4).
  const Worlds drives = {{kQuick, kQuick, kQuick}, {kSweep}, {}};
  const Worlds sweeps = {{kSweep, kSweep, kSweep}, {kSweep}, {}};
  const WorldsResolution worlds = ResolveWorlds(drives, sweeps, kLimit_s);
  EXPECT_DOUBLE_EQ(worlds.times_faster.mean, 2.0);
  EXPECT_LT(worlds.times_faster.low, 1.0);
  EXPECT_EQ(worlds.kind, ResolutionKind::kExact);
  EXPECT_EQ(worlds.resolved, 4);
  EXPECT_EQ(worlds.drives, 4);
}

TEST(ResolutionTest, SaysWhatIsABound) {
  const auto one = [](const SamplingDrive& drive, const SamplingDrive& sweep, double limit_ppm) {
    return ResolveWorlds(Worlds{{drive}}, Worlds{{sweep}}, kLimit_s, limit_ppm);
  };
  EXPECT_EQ(TextOf(one(kQuick, kSweep, 2.05)), "4.00 [4.00, 4.00]");
  EXPECT_EQ(TextOf(one(kQuick, kSweep, 1.8)), "≥ 10.00 [10.00, 10.00]");
  EXPECT_EQ(TextOf(one(kNever, kSweep, 2.05)), "N/A");
  const WorldsResolution some =
      ResolveWorlds(Worlds{{kSweep, kNever}}, Worlds{{kSweep, kSweep}}, kLimit_s);
  EXPECT_EQ(some.kind, ResolutionKind::kAtMost);
  EXPECT_EQ(TextOf(some), "≤ 0.57 [0.57, 0.57] (1 of 2)");  // 8,000 s over 14,000 s
  const WorldsResolution open =
      ResolveWorlds(Worlds{{kQuick, kNever}}, Worlds{{kSweep, kSweep}}, kLimit_s, 1.8);
  EXPECT_EQ(open.kind, ResolutionKind::kOpen);
}

}  // namespace resolution_test
}  // namespace plumescout::lab
