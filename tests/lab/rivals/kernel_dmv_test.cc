// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/kernel_dmv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/types/rng.h"
#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace kernel_dmv_test {

using ::plumescout::testing::GridFromArt;

struct PlacedReading {
  Point2 position;
  double concentration_ppm;
};

Grid<CellState> OpenField(int side) {
  return Grid<CellState>(GridGeometry{0.0, 0.0, 1.0, side, side}, CellState::kFree);
}

MappedGas MapOf(const std::vector<PlacedReading>& readings, const Grid<CellState>& states,
                const KernelDmvOptions& options = {}) {
  KernelDmv mapper(options);
  for (const PlacedReading& reading : readings) {
    EXPECT_TRUE(mapper.Add(reading.position, {reading.concentration_ppm, 0.0}).ok());
  }
  return mapper.MapOver(states).value();
}

// The formulas of the paper written out for one cell, with N(d, sigma) in full.
class Oracle {
 public:
  Oracle(const std::vector<PlacedReading>& readings, const GridGeometry& geometry,
         const KernelDmvOptions& options)
      : readings_(readings), geometry_(geometry), options_(options) {}

  double Mean(Cell cell) const {
    double mean = 0.0;
    for (const PlacedReading& r : readings_) mean += r.concentration_ppm / Count();
    return Blend(cell, mean, [](const PlacedReading& r) { return r.concentration_ppm; });
  }

  double Variance(Cell cell) const {
    const auto square = [this](const PlacedReading& r) {
      return std::pow(r.concentration_ppm - Mean(Nearest(r.position)), 2.0);
    };
    double total = 0.0;
    for (const PlacedReading& r : readings_) total += square(r) / Count();
    return Blend(cell, total, square);
  }

 private:
  double Count() const { return static_cast<double>(readings_.size()); }

  // By asking every cell.
  Cell Nearest(Point2 point) const {
    Cell nearest{0, 0};
    for (std::size_t i = 0; i < geometry_.size(); ++i) {
      const Cell cell = geometry_.CellAtIndex(i);
      const double gained_m =
          Distance_m(geometry_.Center(nearest), point) - Distance_m(geometry_.Center(cell), point);
      if (gained_m > 0.0) nearest = cell;
    }
    return nearest;
  }

  double Normal(double distance_m) const {
    const double sigma = options_.kernel_width_m;
    if (distance_m > 4.0 * sigma) return 0.0;
    return std::exp(-distance_m * distance_m / (2.0 * sigma * sigma)) /
           (2.0 * M_PI * sigma * sigma);
  }

  template <typename Value>
  double Blend(Cell cell, double fallback, const Value& value) const {
    double omega = 0.0;
    double sum = 0.0;
    for (const PlacedReading& r : readings_) {
      const double weight = Normal(Distance_m(geometry_.Center(cell), r.position));
      omega += weight;
      sum += weight * value(r);
    }
    const double scale = options_.confidence_scale * Normal(0.0);
    const double alpha = 1.0 - std::exp(-omega * omega / (scale * scale));
    return (omega > 0.0 ? alpha * sum / omega : 0.0) + (1.0 - alpha) * fallback;
  }

  const std::vector<PlacedReading>& readings_;
  const GridGeometry geometry_;
  const KernelDmvOptions options_;
};

TEST(KernelDmvTest, EqualsTheFormulasWrittenOut) {
  Rng rng(7);
  for (const double width_m : {0.4, 1.5, 6.0}) {
    const KernelDmvOptions options{width_m, 0.8};
    const Grid<CellState> states = testing::RandomStates(14, 11, 0.3, rng);
    std::vector<PlacedReading> readings;
    for (int i = 0; i < 25; ++i) {  // some of them beyond the grid, of cells of 0.1 m
      readings.push_back(
          {{rng.Uniform(-0.4, 1.8), rng.Uniform(-0.4, 1.5)}, rng.Uniform(0.0, 90.0)});
    }
    const MappedGas gas = MapOf(readings, states, options);
    const Oracle oracle(readings, states.geometry(), options);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell cell = states.geometry().CellAtIndex(i);
      if (states[i] != CellState::kFree) {
        EXPECT_TRUE(std::isnan(gas.mean_ppm[i]) && std::isnan(gas.variance_ppm2[i]));
        continue;
      }
      // The map is in floats: half a unit in the last of 24 bits, and rounding on the way.
      constexpr double kRelative = 1e-6;
      EXPECT_NEAR(gas.mean_ppm[i], oracle.Mean(cell), kRelative * 90.0);
      EXPECT_NEAR(gas.variance_ppm2[i], oracle.Variance(cell), kRelative * 8100.0);
    }
  }
}

TEST(KernelDmvTest, FarFromReadingsFallsBackToTheirMeanAndTheirMeanVariance) {
  const std::vector<PlacedReading> readings = {{{1.5, 1.5}, 10.0}, {{2.5, 1.5}, 30.0}};
  const Grid<CellState> states = OpenField(20);
  const MappedGas gas = MapOf(readings, states);
  const Oracle oracle(readings, states.geometry(), {});
  double spread = 0.0;
  for (const PlacedReading& r : readings) {
    const double off = r.concentration_ppm - oracle.Mean(states.geometry().CellAt(r.position));
    spread += 0.5 * off * off;
  }
  EXPECT_FLOAT_EQ(gas.mean_ppm[(Cell{19, 19})], 20.0F);
  EXPECT_NEAR(gas.variance_ppm2[(Cell{19, 19})], spread, 1e-6 * spread);
}

TEST(KernelDmvTest, ASingleReadingIsTheMapAndHasNoVariance) {
  const MappedGas gas = MapOf({{{4.5, 4.5}, 12.0}}, OpenField(9));
  for (std::size_t i = 0; i < gas.mean_ppm.size(); ++i) {
    EXPECT_FLOAT_EQ(gas.mean_ppm[i], 12.0F);
    EXPECT_FLOAT_EQ(gas.variance_ppm2[i], 0.0F);
  }
}

TEST(KernelDmvTest, TrustsAReadingInItsOwnPlaceToAllButOnePartInE) {
  // The second reading is 10 sigma away: r_0 = 50, and the first cell has alpha = 1 - 1/e.
  const MappedGas gas = MapOf({{{0.5, 0.5}, 100.0}, {{10.5, 0.5}, 0.0}}, OpenField(11));
  EXPECT_NEAR(gas.mean_ppm[(Cell{0, 0})], 50.0 + 50.0 * (1.0 - std::exp(-1.0)), 1e-5);
}

TEST(KernelDmvTest, DoesNotSeeWalls) {
  const std::vector<PlacedReading> readings = {{{0.05, 0.05}, 80.0}, {{0.35, 0.05}, 0.0}};
  const KernelDmvOptions options{0.15, 1.0};
  const MappedGas open = MapOf(readings, GridFromArt({"...."}), options);
  const MappedGas walled = MapOf(readings, GridFromArt({".#.."}), options);
  EXPECT_EQ(open.mean_ppm[(Cell{2, 0})], walled.mean_ppm[(Cell{2, 0})]);
}

TEST(KernelDmvTest, HasNoMapWithoutReadings) {
  KernelDmv mapper({});
  EXPECT_TRUE(absl::IsFailedPrecondition(mapper.MapOver(OpenField(3)).status()));
}

TEST(KernelDmvTest, RefusesReadingsThatAreNotFinite) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  KernelDmv mapper({});
  ASSERT_TRUE(mapper.Add({1.5, 1.5}, {3.0, 0.0}).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({1.5, 1.5}, {kNaN, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({kNaN, 1.5}, {3.0, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({1.5, 1.5}, {1e30, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({1.5, 1.5}, {3.0, -1.0})));
  EXPECT_FLOAT_EQ(mapper.MapOver(OpenField(3)).value().mean_ppm[0], 3.0F);
}

TEST(KernelDmvTest, AnEmptyMapStaysEmpty) {
  EXPECT_EQ(MapOf({{{0.0, 0.0}, 1.0}}, Grid<CellState>()).mean_ppm.size(), 0u);
}

TEST(KernelDmvTest, OptionsOutOfRangeAreNamed) {
  EXPECT_TRUE(Validate(KernelDmvOptions{}).ok());
  const absl::Status width = Validate(KernelDmvOptions{0.0, 1.0});
  EXPECT_TRUE(absl::IsInvalidArgument(width));
  EXPECT_NE(width.message().find("kernel_width_m = 0"), absl::string_view::npos);
  EXPECT_TRUE(absl::IsInvalidArgument(Validate(KernelDmvOptions{1.0, -1.0})));
}

}  // namespace kernel_dmv_test
}  // namespace plumescout::lab
