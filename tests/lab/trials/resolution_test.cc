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

}  // namespace resolution_test
}  // namespace plumescout::lab
