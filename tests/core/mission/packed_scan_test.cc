// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/packed_scan.h"

#include <cmath>

#include "gtest/gtest.h"

namespace plumescout {
namespace packed_scan_test {

TEST(PackedScan, ComesBackWithinHalfAStep) {
  const Scan scan{-1.0, 0.01, 8.0, {0.1F, 3.14159F, 8.0F, 7.99F}};
  const Scan back = Unpack(Pack(scan, {}));
  EXPECT_EQ(back.start_angle_rad, scan.start_angle_rad);
  EXPECT_EQ(back.angle_step_rad, scan.angle_step_rad);
  EXPECT_EQ(back.max_range_m, scan.max_range_m);
  ASSERT_EQ(back.ranges_m.size(), scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    EXPECT_NEAR(back.ranges_m[i], scan.ranges_m[i], 0.5001 * 8.0 / 65534.0);
  }
}

TEST(PackedScan, KeepsWhatIsNoRange) {
  const float nothing = std::nanf("");
  const Scan back = Unpack(
      Pack({0.0, 0.1, 4.0, {nothing, INFINITY, -1.0F, 0.0F, 4.1F, 1e-6F}}, {{{1.0, 2.0}, 0.5}}));
  EXPECT_TRUE(std::isnan(back.ranges_m[0]));
  EXPECT_EQ(back.ranges_m[1], INFINITY);
  EXPECT_TRUE(std::isnan(back.ranges_m[2]));
  EXPECT_TRUE(std::isnan(back.ranges_m[3]));
  EXPECT_TRUE(std::isnan(back.ranges_m[4])) << "beyond the range";
  EXPECT_GT(back.ranges_m[5], 0.0F) << "very near, but seen";
}

TEST(PackedScan, TakesTwoBytesABeam) {
  const Scan scan{0.0, 0.1, 8.0, std::vector<float>(360, 1.0F)};
  EXPECT_EQ(Pack(scan, {}).bytes(), 160 + 720);
}

}  // namespace packed_scan_test
}  // namespace plumescout
