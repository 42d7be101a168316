// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/types/rng.h"

namespace plumescout {
namespace field_origin_test {

constexpr GasLattice kLattice{-3, 2, 25, 18};
const FieldOptions kOptions{
    {.prior_precision_per_ppm2 = 3.0, .background_precision_per_ppm2 = 0.001}, {}, 16};

bool AreSame(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(FieldOrigin, TheSameWayLeadsToTheSameBits) {
  Rng rng(1);
  std::vector<CellInput> cells(kLattice.size());
  for (CellInput& cell : cells) cell.active = rng.Below(5) != 0;
  FieldOrigin origin = {CellRuns(cells), {}};
  FieldEngine live(25, 18, cells, kOptions);
  const auto tell = [&](FieldEngine& field, std::vector<CellChange> changes) {
    EXPECT_TRUE(field.Apply(changes).ok());
    return changes;
  };
  for (int call = 0; call < 20; ++call) {
    std::vector<CellChange> changes(1 + rng.Below(call % 4 == 0 ? 40 : 1));
    for (CellChange& change : changes) {
      change.cell = rng.Below(kLattice.size());
      change.input = live.input(change.cell);
      change.input.precision += 10.0;
      change.input.weighted_deviation += rng.Uniform(0.0, 100.0);
      if (call % 4 == 0) change.input.active = rng.Below(4) != 0;
    }
    origin.changes.push_back(tell(live, changes));
  }
  const auto again = MakeField(origin, kLattice, kOptions);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_TRUE(AreSame(live.means_ppm(), (*again)->means_ppm()));
  EXPECT_TRUE(AreSame(live.variances_ppm2(), (*again)->variances_ppm2()));
  for (int call = 0; call < 40; ++call) {
    const std::size_t cell = rng.Below(kLattice.size());
    CellInput input = live.input(cell);
    input.precision += 1.0;
    tell(live, {{cell, input}});
    tell(**again, {{cell, input}});
    ASSERT_TRUE(AreSame(live.means_ppm(), (*again)->means_ppm())) << call;
    ASSERT_TRUE(AreSame(live.variances_ppm2(), (*again)->variances_ppm2())) << call;
  }

  // All at once leads elsewhere, within the tolerance: that is why the way is kept.
  for (std::size_t i = 0; i < kLattice.size(); ++i) cells[i] = live.input(i);
  const auto fresh = MakeField({CellRuns(cells), {}}, kLattice, kOptions);
  ASSERT_TRUE(fresh.ok());
  EXPECT_FALSE(AreSame(live.variances_ppm2(), (*fresh)->variances_ppm2()));
}

TEST(FieldOrigin, WhatIsNoFieldIsRefused) {
  FieldOrigin origin;
  EXPECT_FALSE(MakeField(origin, kLattice, kOptions).ok());
  std::vector<CellInput> cells(kLattice.size(), {.active = true});
  origin.cells = CellRuns(cells);
  EXPECT_TRUE(MakeField(origin, kLattice, kOptions).ok());
  EXPECT_FALSE(MakeField(origin, {0, 0, 17, 25}, kOptions).ok());
  cells[3].precision = std::nan("");
  origin.cells = CellRuns(cells);
  EXPECT_FALSE(MakeField(origin, kLattice, kOptions).ok());
  cells[3] = {.active = true, .precision = 1.0, .weighted_deviation = INFINITY};
  origin.cells = CellRuns(cells);
  EXPECT_FALSE(MakeField(origin, kLattice, kOptions).ok());
  cells[3] = {.active = true};
  origin.cells = CellRuns(cells);
  origin.changes = {{{kLattice.size(), {}}}};
  EXPECT_FALSE(MakeField(origin, kLattice, kOptions).ok());
}

TEST(FieldOrigin, EndsWhenItIsTold) {
  const std::vector<CellInput> cells(kLattice.size(), {.active = true});
  const FieldOrigin origin = {CellRuns(cells), {}};
  FieldOptions options = kOptions;
  options.stop = [] { return true; };
  EXPECT_EQ(MakeField(origin, kLattice, options).status().code(), absl::StatusCode::kCancelled);
}

}  // namespace field_origin_test
}  // namespace plumescout
