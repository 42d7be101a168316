// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The store against placing every reading from scratch, while readings arrive and the map changes
// and grows.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "core/gas/reading_store.h"
#include "core/types/rng.h"

namespace plumescout {
namespace reading_store_random_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kResolution_m = 0.1;
constexpr double kObservationPrecision = 10.0;
constexpr double kMean_ppm = 2.0;

constexpr GridGeometry kLattice{0.0, 0.0, kResolution_m, 1, 1};

struct RawReading {
  std::int64_t time_ns;
  Point2 position;
  GasReading reading;
};

// A map of which a window is known; the anchor is where the window first was.
class GrowingMap {
 public:
  explicit GrowingMap(Rng& rng) : rng_(rng), world_(GridGeometry{0.0, 0.0, 1.0, kSide, kSide}) {
    for (CellState& state : world_.values()) state = RandomState();
  }

  // Flips a few cells, and now and then moves a side of the window, mostly outwards.
  void Change() {
    for (int k = 0; k < 3; ++k) {
      world_[Cell{x0_ + Draw(x1_ - x0_), y0_ + Draw(y1_ - y0_)}] = RandomState();
    }
    if (rng_.Below(8) != 0) return;
    const int step = rng_.Below(5) == 0 ? -1 : 1 + Draw(2);
    switch (rng_.Below(4)) {
      case 0:
        x0_ = std::max(0, x0_ - step);
        break;
      case 1:
        y0_ = std::max(0, y0_ - step);
        break;
      case 2:
        x1_ = std::min(kSide, x1_ + step);
        break;
      default:
        y1_ = std::min(kSide, y1_ + step);
        break;
    }
  }

  bool IsFree(AnchorCell cell) const {
    const Cell c{cell.x + kFirst, cell.y + kFirst};
    const bool is_known = c.x >= x0_ && c.x < x1_ && c.y >= y0_ && c.y < y1_;
    return is_known && world_[c] == CellState::kFree;
  }

  AnchorCell corner() const { return {x0_ - kFirst, y0_ - kFirst}; }

  Grid<CellState> Window() const {
    Grid<CellState> states(GridGeometry{kResolution_m * (x0_ - kFirst),
                                        kResolution_m * (y0_ - kFirst), kResolution_m, x1_ - x0_,
                                        y1_ - y0_});
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell cell = states.geometry().CellAtIndex(i);
      states[i] = world_[Cell{cell.x + x0_, cell.y + y0_}];
    }
    return states;
  }

 private:
  static constexpr int kSide = 40;
  static constexpr int kFirst = 18;

  int Draw(int bound) { return static_cast<int>(rng_.Below(static_cast<std::uint64_t>(bound))); }
  CellState RandomState() {
    const std::uint64_t draw = rng_.Below(5);
    if (draw < 3) return CellState::kFree;
    return draw == 3 ? CellState::kOccupied : CellState::kUnknown;
  }

  Rng& rng_;
  Grid<CellState> world_;
  int x0_ = kFirst;
  int y0_ = kFirst;
  int x1_ = kFirst + 5;
  int y1_ = kFirst + 4;
};

using ByCell = std::map<AnchorCell, std::vector<std::size_t>>;  // indices of readings

// Where a reading goes by definition: its cell, else the free one of the eight around it whose
// centre is nearest, those across a side before those across a corner, of equal ones in the order
// E, N, W, S, NE, NW, SW, SE.
std::optional<AnchorCell> PlaceByDefinition(Point2 position, const GrowingMap& map) {
  const AnchorCell own{static_cast<int>(std::floor(position.x_m / kResolution_m)),
                       static_cast<int>(std::floor(position.y_m / kResolution_m))};
  if (map.IsFree(own)) return own;
  constexpr Cell kNeighbours[] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                  {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  constexpr double kTie_m = 1e-9;    // the first of equal ones comes first
  constexpr double kCorner_m = 1.0;  // beyond any neighbour
  int rank = 0;
  std::optional<AnchorCell> nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Cell step : kNeighbours) {
    const AnchorCell cell{own.x + step.x, own.y + step.y};
    const double distance_m = Distance_m(position, kLattice.Center({cell.x, cell.y})) +
                              (step.x != 0 && step.y != 0 ? kCorner_m : 0.0) + kTie_m * rank++;
    if (!map.IsFree(cell) || distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    nearest = cell;
  }
  return nearest;
}

AnchorCell OwnCell(Point2 position) {
  const Cell cell = kLattice.CellAt(position);
  return {cell.x, cell.y};
}

struct Placed {
  ByCell by_cell;
  GasCounters counters;
};

Placed PlaceAllByDefinition(const std::vector<RawReading>& readings, const GrowingMap& map) {
  Placed placed;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    ++placed.counters.readings;
    const std::optional<AnchorCell> cell = PlaceByDefinition(readings[k].position, map);
    if (!cell) {
      ++placed.counters.waiting;
      continue;
    }
    ++placed.counters.in_posterior;
    if (OwnCell(readings[k].position) != *cell) ++placed.counters.moved_to_neighbour;
    placed.by_cell[*cell].push_back(k);
  }
  return placed;
}

// Of all readings of a site in a free cell that are a half-life old: they count as taken at its
// centre.
void ForgetPlaces(const Placed& placed, double half_life_s, std::int64_t now_ns,
                  std::vector<RawReading>& readings) {
  const auto half_life_ns = static_cast<std::int64_t>(half_life_s) * kSecond_ns;
  std::map<ReadingSite, std::int64_t> newest_ns;
  for (const RawReading& r : readings) {
    std::int64_t& newest =
        newest_ns.try_emplace(SiteOf(r.position, kLattice), r.time_ns).first->second;
    newest = std::max(newest, r.time_ns);
  }
  for (const auto& [cell, chosen] : placed.by_cell) {
    for (const std::size_t k : chosen) {
      RawReading& r = readings[k];
      if (OwnCell(r.position) != cell) continue;
      if (now_ns - newest_ns.at(SiteOf(r.position, kLattice)) < half_life_ns) continue;
      r.position = kLattice.Center({cell.x, cell.y});
    }
  }
}

// Straight from the definition of ageing; a half-life of 0 means that nothing ages.
Evidence SumByDefinition(const std::vector<RawReading>& readings,
                         const std::vector<std::size_t>& chosen, double half_life_s,
                         std::int64_t time_ns) {
  Evidence sum;
  for (const std::size_t k : chosen) {
    const RawReading& r = readings[k];
    const double age_s = std::max(0.0, static_cast<double>(time_ns - r.time_ns) * 1e-9);
    const double growth = half_life_s > 0.0 ? age_s / half_life_s / kObservationPrecision : 0.0;
    const double own =
        r.reading.variance_ppm2 > 0.0 ? r.reading.variance_ppm2 : 1.0 / kObservationPrecision;
    const double precision = 1.0 / (own + growth);
    const double deviation_ppm = r.reading.concentration_ppm - kMean_ppm;
    sum += {precision, precision * deviation_ppm, precision * deviation_ppm * deviation_ppm, 1.0};
  }
  return sum;
}

RawReading RandomReading(const GrowingMap& map, const Grid<CellState>& window, std::int64_t now_ns,
                         Rng& rng) {
  const double west_m = kResolution_m * (map.corner().x - 3);
  const double south_m = kResolution_m * (map.corner().y - 3);
  return {now_ns - static_cast<std::int64_t>(rng.Below(5)) * kSecond_ns,
          {west_m + rng.Uniform(0.0, kResolution_m * (window.width() + 6)),
           south_m + rng.Uniform(0.0, kResolution_m * (window.height() + 6))},
          {rng.Uniform(3.0, 40.0), rng.Below(3) == 0 ? rng.Uniform(0.05, 2.0) : 0.0}};
}

// Cells of `states` that are free and were not, or the other way round.
std::vector<std::size_t> Difference(const Grid<CellState>& before, AnchorCell corner_before,
                                    const Grid<CellState>& states, AnchorCell corner) {
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Cell cell = states.geometry().CellAtIndex(i);
    const CellState was =
        before.At({cell.x + corner.x - corner_before.x, cell.y + corner.y - corner_before.y},
                  CellState::kUnknown);
    if ((was == CellState::kFree) != (states[i] == CellState::kFree)) changed.push_back(i);
  }
  return changed;
}

// Those whose readings are not the same in both.
std::vector<AnchorCell> ChangedCells(const ByCell& before, const ByCell& after) {
  std::map<AnchorCell, bool> changed;
  for (const auto& [cell, readings] : before) {
    if (!after.contains(cell) || after.at(cell) != readings) changed[cell] = true;
  }
  for (const auto& [cell, readings] : after) {
    if (!before.contains(cell)) changed[cell] = true;
  }
  std::vector<AnchorCell> cells;
  for (const auto& [cell, is_changed] : changed) cells.push_back(cell);
  return cells;
}

void ExpectEvidence(const std::vector<CellEvidence>& evidence, const ByCell& by_cell,
                    const std::vector<RawReading>& readings, double half_life_s,
                    std::int64_t time_ns, double tolerance) {
  ASSERT_EQ(evidence.size(), by_cell.size());
  auto expected = by_cell.begin();
  for (const CellEvidence& e : evidence) {
    ASSERT_EQ(e.cell, expected->first);
    const Evidence sum = SumByDefinition(readings, expected->second, half_life_s, time_ns);
    ASSERT_NEAR(e.evidence.precision, sum.precision, tolerance * sum.precision);
    // Every reading lies above the background, so this is the sum of their magnitudes too.
    ASSERT_NEAR(e.evidence.weighted_deviation, sum.weighted_deviation,
                tolerance * sum.weighted_deviation);
    ASSERT_EQ(e.evidence.count, sum.count);
    ++expected;
  }
}

struct MissionOptions {
  double half_life_s = 0.0;
  bool compacts = false;
  std::uint64_t seed = 0;
};

void CompareOverAMission(const MissionOptions& run) {
  constexpr double kRounding = 1e-12;
  Rng rng(run.seed);
  GrowingMap map(rng);
  GasOptions options = PublishedGasOptions();
  options.observation_precision_per_ppm2 = kObservationPrecision;
  options.background_mean_ppm = kMean_ppm;
  options.ageing_half_life_s = run.half_life_s;
  ReadingStore store(options);
  std::vector<RawReading> readings;
  Placed before;
  Grid<CellState> window;
  AnchorCell corner;
  for (std::int64_t second = 0; second < 600; ++second) {
    const std::int64_t now_ns = second * kSecond_ns;
    if (second > 0) map.Change();
    const Grid<CellState> next = map.Window();
    for (std::uint64_t k = rng.Below(4); k > 0; --k) {
      readings.push_back(RandomReading(map, next, now_ns, rng));
      store.Add(readings.back().time_ns, readings.back().position, readings.back().reading);
    }
    ASSERT_TRUE(store.Place(next, Difference(window, corner, next, map.corner())).ok());
    window = next;
    corner = map.corner();

    const Placed placed = PlaceAllByDefinition(readings, map);
    ASSERT_EQ(store.counters(), placed.counters);
    ASSERT_EQ(store.TakeChanged(), ChangedCells(before.by_cell, placed.by_cell));
    before = placed;
    if (run.compacts && second % 20 == 0) {
      store.Compact(now_ns);
      ForgetPlaces(placed, run.half_life_s, now_ns, readings);
    }
    const double tolerance = run.compacts ? kBucketError : kRounding;
    ExpectEvidence(store.EvidenceAsOf(now_ns), placed.by_cell, readings, run.half_life_s, now_ns,
                   tolerance);
    if (second % 10 != 0) continue;
    store.AgeTo(now_ns);
    store.TakeChanged();
    for (const CellEvidence& e : store.EvidenceAsOf(now_ns)) {
      ASSERT_EQ(store.EvidenceAt(e.cell).precision, e.evidence.precision);
      ASSERT_EQ(store.EvidenceAt(e.cell).weighted_deviation, e.evidence.weighted_deviation);
    }
  }
  EXPECT_GT(before.counters.in_posterior, 300);
  EXPECT_GT(before.counters.moved_to_neighbour, 50);
  EXPECT_GT(before.counters.waiting, 20);
  if (run.compacts) {
    EXPECT_LT(store.buckets(), readings.size());
  }
}

TEST(ReadingStoreRandomTest, AgreesWithPlacingEverythingFromScratch) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) CompareOverAMission({.seed = seed});
}

TEST(ReadingStoreRandomTest, AgreesWhileReadingsAge) {
  for (const std::uint64_t seed : {4U, 5U})
    CompareOverAMission({.half_life_s = 30.0, .seed = seed});
}

TEST(ReadingStoreRandomTest, AgreesWithinTheBoundsWhileReadingsMerge) {
  for (const std::uint64_t seed : {6U, 7U}) {
    CompareOverAMission({.half_life_s = 30.0, .compacts = true, .seed = seed});
  }
}

}  // namespace reading_store_random_test
}  // namespace plumescout
