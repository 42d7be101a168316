// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/range_codec.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "formats/journal/varint.h"

namespace plumescout {
namespace {

// The first that fits is taken: the coarser, the smaller the differences.
constexpr std::uint64_t kUnits_um[] = {100'000, 50'000, 20'000, 10'000, 5'000, 4'000,
                                       2'500,   2'000,  1'000,  500,    250,   100};
constexpr std::uint64_t kCoarsestUnit_um = 1'000'000;  // that is read
constexpr std::uint64_t kNoUnit = 0;
// Differences take four bytes at most, no more than a float.
constexpr std::int64_t kMaxUnits = std::int64_t{1} << 26;

constexpr std::uint64_t kNothingSeen = 0;
constexpr std::uint64_t kSaysNothing = 1;
constexpr std::uint64_t kFirstDifference = 2;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool SameBits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

double Metres(std::uint64_t unit_um) { return static_cast<double>(unit_um) / 1e6; }

// As proto/convert makes ranges of what comes by wire.
float RangeOf(std::int64_t units, double unit_m) {
  return static_cast<float>(static_cast<double>(units) * unit_m);
}

// How many units the range is, if it is whole ones.
std::optional<std::int64_t> UnitsOf(float range_m, double unit_m) {
  const double units = static_cast<double>(range_m) / unit_m;
  if (!(units >= 0.0 && units <= static_cast<double>(kMaxUnits))) return std::nullopt;
  const std::int64_t whole = std::llround(units);
  if (!SameBits(RangeOf(whole, unit_m), range_m)) return std::nullopt;
  return whole;
}

// False, with `bytes` anywhere, if some range is not whole units.
bool AppendDifferences(const std::vector<float>& ranges_m, double unit_m, std::string& bytes) {
  std::int64_t last = 0;
  for (const float range_m : ranges_m) {
    if (SameBits(range_m, kInfinity)) {
      AppendVarint(kNothingSeen, bytes);
    } else if (SameBits(range_m, kNaN)) {
      AppendVarint(kSaysNothing, bytes);
    } else {
      const std::optional<std::int64_t> units = UnitsOf(range_m, unit_m);
      if (!units) return false;
      AppendVarint(kFirstDifference + ZigZag(*units - last), bytes);
      last = *units;
    }
  }
  return true;
}

bool TakeDifferences(absl::string_view& rest, std::uint64_t beams, double unit_m,
                     std::vector<float>& ranges_m) {
  std::int64_t last = 0;
  for (std::uint64_t beam = 0; beam < beams; ++beam) {
    std::uint64_t code = 0;
    if (!TakeVarint(rest, code)) return false;
    if (code < kFirstDifference) {
      ranges_m.push_back(code == kNothingSeen ? kInfinity : kNaN);
      continue;
    }
    if (code - kFirstDifference > ZigZag(kMaxUnits)) return false;
    last += UnZigZag(code - kFirstDifference);
    if (last < 0 || last > kMaxUnits) return false;
    ranges_m.push_back(RangeOf(last, unit_m));
  }
  return true;
}

bool TakeFloats(absl::string_view& rest, std::uint64_t beams, std::vector<float>& ranges_m) {
  if (rest.size() / sizeof(float) < beams) return false;
  if (beams == 0) return true;
  ranges_m.resize(static_cast<std::size_t>(beams));
  const std::size_t size = ranges_m.size() * sizeof(float);
  std::memcpy(ranges_m.data(), rest.data(), size);
  rest.remove_prefix(size);
  return true;
}

}  // namespace

void AppendRanges(const std::vector<float>& ranges_m, std::string& bytes) {
  AppendVarint(ranges_m.size(), bytes);
  const std::size_t begin = bytes.size();
  for (const std::uint64_t unit_um : kUnits_um) {
    AppendVarint(unit_um, bytes);
    if (AppendDifferences(ranges_m, Metres(unit_um), bytes)) return;
    bytes.resize(begin);
  }
  AppendVarint(kNoUnit, bytes);
  bytes.append(reinterpret_cast<const char*>(ranges_m.data()), ranges_m.size() * sizeof(float));
}

bool TakeRanges(absl::string_view& rest, std::vector<float>& ranges_m) {
  std::uint64_t beams = 0;
  std::uint64_t unit_um = 0;
  if (!TakeVarint(rest, beams) || !TakeVarint(rest, unit_um)) return false;
  ranges_m.clear();
  if (unit_um == kNoUnit) return TakeFloats(rest, beams, ranges_m);
  if (unit_um > kCoarsestUnit_um) return false;
  if (beams <= rest.size()) ranges_m.reserve(static_cast<std::size_t>(beams));
  return TakeDifferences(rest, beams, Metres(unit_um), ranges_m);
}

}  // namespace plumescout
