// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/range_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/types/rng.h"
#include "formats/journal/varint.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace range_codec_test {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::string Bytes(const std::vector<float>& ranges_m) {
  std::string bytes;
  AppendRanges(ranges_m, bytes);
  return bytes;
}

bool SameBits(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// Whether the ranges come back to the last bit, and what follows them is left.
bool ComesBack(const std::vector<float>& ranges_m) {
  const std::string bytes = Bytes(ranges_m) + "rest";
  absl::string_view rest = bytes;
  std::vector<float> back = {1.0F};
  return TakeRanges(rest, back) && rest == "rest" && SameBits(back, ranges_m);
}

bool AreRanges(const std::string& bytes) {
  absl::string_view rest = bytes;
  std::vector<float> ranges_m;
  return TakeRanges(rest, ranges_m);
}

// The beams of a lidar in a room with furniture, as it comes by wire: noise, a few beams without
// return, and steps of a unit.
std::vector<float> Measured(const Pose2& pose, double unit_m, Rng& rng) {
  constexpr double kNoise_m = 0.01;
  const std::vector<support::Disc> furniture = {{{2.0, 1.0}, 0.3},
                                                {{6.5, 3.0}, 0.5},
                                                {{4.0, 5.0}, 0.2},
                                                {{8.0, 6.5}, 0.8},
                                                {{1.0, 6.0}, 0.4}};
  std::vector<float> ranges_m = support::ScanInBox(pose, 10.0, 8.0, furniture).ranges_m;
  for (float& range_m : ranges_m) {
    if (!std::isfinite(range_m)) continue;
    const double noisy_m = static_cast<double>(range_m) + kNoise_m * rng.Gaussian();
    const auto units = static_cast<double>(std::llround(noisy_m / unit_m));
    const bool says_nothing = units < 1.0 || rng.Below(200) == 0;
    range_m = says_nothing ? kNaN : static_cast<float>(units * unit_m);
  }
  return ranges_m;
}

TEST(RangeCodec, TheLayoutIsFixed) {
  EXPECT_EQ(Bytes({0.5F, 0.51F, kInfinity, 0.48F, kNaN}),
            std::string("\x05\x90\x4E\x66\x04\x00\x07\x01", 8));  // 10,000 um: 50, +1, inf, -3, NaN
  EXPECT_EQ(Bytes({0.123456F}), std::string("\x01\x00\x80\xD6\xFC\x3D", 6));
}

TEST(RangeCodec, AScanOf360BeamsIn10MillimetresTakesLittleMoreThanAByteABeam) {
  Rng rng(1);
  std::size_t most_bytes = 0;
  std::size_t sum_bytes = 0;
  constexpr int kScans = 500;
  for (int i = 0; i < kScans; ++i) {
    const Pose2 pose{rng.Uniform(0.5, 9.5), rng.Uniform(0.5, 7.5), rng.Uniform(-3.0, 3.0)};
    const std::vector<float> ranges_m = Measured(pose, 0.01, rng);
    ASSERT_EQ(ranges_m.size(), 360U);
    ASSERT_TRUE(ComesBack(ranges_m));
    most_bytes = std::max(most_bytes, Bytes(ranges_m).size());
    sum_bytes += Bytes(ranges_m).size();
  }
  EXPECT_LE(most_bytes, 430U);
  EXPECT_LE(sum_bytes / kScans, 400U);
}

TEST(RangeCodec, EveryUsualUnitIsFound) {
  Rng rng(2);
  for (const double unit_m : {0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.004, 0.003, 0.0025, 0.002,
                              0.001, 0.0005, 0.00025, 0.0001}) {
    for (int i = 0; i < 20; ++i) {
      const std::vector<float> ranges_m = Measured({3.0 + 0.1 * i, 2.5, 0.1 * i}, unit_m, rng);
      ASSERT_TRUE(ComesBack(ranges_m)) << unit_m;
      ASSERT_LE(Bytes(ranges_m).size(), 2 * ranges_m.size() + 100) << unit_m;
    }
  }
}

// The unit that proto/convert takes for ranges beyond 327 m is not round.
TEST(RangeCodec, ARareUnitIsKeptAsFloats) {
  const double unit_m = 400.0 / 65534;
  std::vector<float> ranges_m;
  for (int i = 1; i < 100; ++i) ranges_m.push_back(static_cast<float>(661 * i * unit_m));
  EXPECT_EQ(Bytes(ranges_m).size(), 2 + 4 * ranges_m.size());
  EXPECT_TRUE(ComesBack(ranges_m));
}

TEST(RangeCodec, EveryBitPatternComesBack) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    std::vector<float> ranges_m(rng.Below(20));
    for (float& range_m : ranges_m) {
      const auto bits = static_cast<std::uint32_t>(rng.Next());
      std::memcpy(&range_m, &bits, sizeof(bits));
    }
    ASSERT_TRUE(ComesBack(ranges_m));
  }
}

TEST(RangeCodec, SpecialValuesComeBack) {
  std::vector<float> with_payload = {1.0F, kNaN};
  std::uint32_t bits = 0;
  std::memcpy(&bits, &with_payload[1], sizeof(bits));
  ++bits;
  std::memcpy(&with_payload[1], &bits, sizeof(bits));
  EXPECT_TRUE(ComesBack(with_payload));
  for (const float value : {0.0F, -0.0F, kInfinity, -kInfinity, kNaN, -1.0F, 1e30F,
                            std::numeric_limits<float>::denorm_min()}) {
    EXPECT_TRUE(ComesBack({value})) << value;
    EXPECT_TRUE(ComesBack({1.0F, value, 1.01F})) << value;
  }
  EXPECT_TRUE(ComesBack({}));
  EXPECT_TRUE(ComesBack(std::vector<float>(100, kInfinity)));
}

TEST(RangeCodec, NeverTakesMuchMoreThanFloats) {
  std::vector<float> ranges_m;  // to and fro as far as it goes
  for (int i = 0; i < 100; ++i) ranges_m.push_back(i % 2 == 0 ? 0.0001F : 6500.0F);
  EXPECT_LE(Bytes(ranges_m).size(), 8 + 4 * ranges_m.size());
  EXPECT_TRUE(ComesBack(ranges_m));
}

TEST(RangeCodec, DamageIsFound) {
  EXPECT_FALSE(AreRanges(""));
  EXPECT_FALSE(AreRanges("\x01"));
  const std::string whole = Bytes({0.5F, 0.51F, kInfinity, 0.48F});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(AreRanges(whole.substr(0, size))) << size;
  }
  EXPECT_FALSE(AreRanges("\x01\x90\x4E\x03"));  // one step below 0
  std::string far("\x01\x90\x4E", 3);
  AppendVarint(2 + ZigZag((std::int64_t{1} << 26) + 1), far);
  EXPECT_FALSE(AreRanges(far));
  std::string unit("\x00", 1);
  AppendVarint(1'000'001, unit);
  EXPECT_FALSE(AreRanges(unit));
}

TEST(RangeCodec, ADamagedNumberOfBeamsDoesNotAllocate) {
  std::string bytes;
  AppendVarint(std::uint64_t{1} << 62, bytes);
  for (const char* unit : {"\x0A", "\x90\x4E"}) {
    EXPECT_FALSE(AreRanges(bytes + unit + "\x02\x02\x02"));
  }
  EXPECT_FALSE(AreRanges(bytes + std::string(9, '\0')));
}

}  // namespace range_codec_test
}  // namespace plumescout
