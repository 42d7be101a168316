// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/map_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/types/error_reason.h"
#include "proto/convert/status.h"
#include "server/maps/level_of_detail.h"
#include "server/maps/part_token.h"
#include "tests/server/maps/map_replica.h"
#include "tests/server/maps/random_map.h"

namespace plumescout::server {
namespace map_store_test {

constexpr std::int64_t kAmple_bytes = 1 << 24;

bool Same(float a, float b, float tolerance) {
  return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance;
}

// Whether a reader's copy is what the whole map looks like in the view, as far as the region's
// tiles reach; what lies beyond is not told.
void ExpectLike(const MapSnapshot& copy, const RandomMap& truth, const MapView& view) {
  const int level = view.level_of_detail;
  const GridGeometry squares = SquaresOf(truth.states.geometry(), level);
  ASSERT_EQ(copy.occupancy.geometry(), squares);
  const auto states = WorstStates(truth.states, level, WholeRaster(squares));
  const auto values = LargestValues(truth.values, level, WholeRaster(squares));
  // Steps of 1/65534 of 1000 ppm.
  const float tolerance = view.full_precision ? 0.0f : 0.01f;
  int told = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const Point2 place = squares.Center(squares.CellAtIndex(i));
    if (view.region && (place.x_m < view.region->min.x_m || place.x_m > view.region->max.x_m ||
                        place.y_m < view.region->min.y_m || place.y_m > view.region->max.y_m)) {
      continue;
    }
    ++told;
    if (view.occupancy) {
      ASSERT_EQ(copy.occupancy[i], states[i]) << i;
    }
    if (view.gas_mean) {
      ASSERT_TRUE(Same(copy.gas_mean_ppm[i], values[i], tolerance)) << i;
    }
    if (view.gas_variance) {
      ASSERT_TRUE(Same(copy.gas_variance_ppm2[i], values[i], tolerance)) << i;
    }
  }
  if (squares.size() > 0 && !view.region) {
    EXPECT_GT(told, 0);
  }
}

// Fetches a map part by part, as clients do; `before_next` is called between two.
absl::StatusOr<MapSnapshot> Fetch(
    MapStore& store, const Belief& belief, const MapView& view, std::int64_t max_bytes,
    const std::function<void()>& before_next = [] {}) {
  v1::GetMapResponse part;
  EXPECT_TRUE(Parse(store.FirstPart(belief, view, max_bytes), part).ok());
  auto map = FromProto(part);
  while (map.ok() && !part.next_part_token().empty()) {
    before_next();
    const auto bytes = store.NextPart(part.next_part_token(), view, max_bytes);
    if (!bytes.ok()) return bytes.status();
    EXPECT_TRUE(Parse(*bytes, part).ok());
    EXPECT_EQ(part.revision(), map->revision);
    EXPECT_FALSE(part.has_status());
    EXPECT_GT(part.tiles_size(), 0);
    EXPECT_TRUE(AddTiles(part, *map).ok());
  }
  return map;
}

// Changes a few cells near each other, or the geometry, or nothing.
void ChangeAtRandom(RandomMap& map, Rng& rng) {
  const std::uint64_t kind = rng.Below(10);
  if (kind == 0) {
    map = MakeRandomMap({-6.4 * static_cast<double>(rng.Below(3)), 0.0, 0.1,
                         64 * static_cast<int>(1 + rng.Below(3)), 128},
                        rng);
  } else if (kind < 8 && map.states.size() > 0) {
    for (int i = 0; i < 5; ++i) {
      const std::size_t cell = rng.Below(map.states.size());
      map.states[cell] = static_cast<CellState>(rng.Below(3));
      map.values[cell] = map.states[cell] == CellState::kFree
                             ? RandomGas(rng)
                             : std::numeric_limits<float>::quiet_NaN();
    }
  } else if (kind == 8) {
    std::fill(map.states.values().begin(), map.states.values().end(), CellState::kUnknown);
    std::fill(map.values.values().begin(), map.values.values().end(),
              std::numeric_limits<float>::quiet_NaN());
  }
}

// Each watcher looks when he likes; two of the forms are shared by several.
TEST(MapStoreTest, ReplicasAreTheMapWhateverHappensAndWhoeverLags) {
  const std::vector<MapView> views = {
      {},
      {.full_precision = true},
      {.full_precision = true, .level_of_detail = 1},
      {.occupancy = false, .gas_variance = false, .level_of_detail = 3},
      {.full_precision = true, .region = Rectangle{{-3.0, 1.0}, {5.0, 4.0}}},
      {.full_precision = true, .level_of_detail = 6, .region = Rectangle{{9.0, 9.0}, {99.0, 99.0}}},
      {.full_precision = true}};
  for (const std::int64_t max_bytes : {std::int64_t{20'000}, kAmple_bytes}) {
    Rng rng(11);
    MapStore store("hall", max_bytes);
    std::vector<MapReplica> watchers(views.size());
    RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 0, 0}, rng);
    for (std::int64_t revision = 0; revision < 60; ++revision) {
      if (revision > 0) ChangeAtRandom(map, rng);
      const auto belief = BeliefOf(revision, map);
      for (std::size_t i = 0; i < views.size(); ++i) {
        if (rng.Below(3) != 0) continue;
        watchers[i].Apply(*store.FramesSince(watchers[i].revision(), *belief, views[i]));
        ASSERT_NO_FATAL_FAILURE(ExpectLike(watchers[i].map(), map, views[i]))
            << "revision " << revision << ", view " << i;
      }
    }
  }
}

TEST(MapStoreTest, PartsMakeTheWholeInEveryView) {
  Rng rng(3);
  const RandomMap map = MakeRandomMap({-12.8, -6.4, 0.1, 320, 192}, rng);
  const auto belief = BeliefOf(5, map);
  MapStore store("hall", kAmple_bytes);
  const std::vector<std::optional<Rectangle>> regions = {
      std::nullopt, Rectangle{{0.0, 0.0}, {3.0, 3.0}}, Rectangle{{-1e300, -1e300}, {1e300, 0.0}},
      Rectangle{{1.0, 1.0}, {1.0, 1.0}}};
  for (int level = 0; level <= kMaxLevelOfDetail; ++level) {
    for (const auto& region : regions) {
      const MapView view{.full_precision = true, .level_of_detail = level, .region = region};
      const auto whole = Fetch(store, *belief, view, 0);
      ASSERT_TRUE(whole.ok()) << whole.status();
      ASSERT_NO_FATAL_FAILURE(ExpectLike(*whole, map, view)) << level;
      const auto parts = Fetch(store, *belief, view, 1);
      ASSERT_TRUE(parts.ok()) << parts.status();
      EXPECT_EQ(parts->occupancy, whole->occupancy);
      ASSERT_NO_FATAL_FAILURE(ExpectLike(*parts, map, view)) << level;
    }
  }
}

TEST(MapStoreTest, RegionHasTheTilesThatItMeetsAndNoOthers) {
  Rng rng(4);
  const auto belief = BeliefOf(1, MakeRandomMap({0.0, 0.0, 0.1, 256, 256}, rng));
  MapStore store("hall", kAmple_bytes);
  const auto tiles = [&](const Rectangle& region) {
    const MapView view{.gas_mean = false, .gas_variance = false, .region = region};
    return store.Encode(*belief, view)->tiles.size();
  };
  EXPECT_EQ(tiles({{0.1, 0.1}, {6.3, 6.3}}), 1u);
  EXPECT_EQ(tiles({{6.3, 0.1}, {6.5, 6.3}}), 2u);
  EXPECT_EQ(tiles({{-50.0, -50.0}, {50.0, 50.0}}), 16u);
  EXPECT_EQ(tiles({{-50.0, -50.0}, {-1.0, 50.0}}), 0u);
  EXPECT_EQ(tiles({{25.7, 0.0}, {50.0, 50.0}}), 0u);
}

TEST(MapStoreTest, PartsAreOfOneRevisionWhileTheMapChanges) {
  Rng rng(5);
  RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 256, 128}, rng);
  const RandomMap first = map;
  const MapView view{.full_precision = true};
  MapStore store("hall", kAmple_bytes);
  std::int64_t revision = 1;
  const auto belief = BeliefOf(revision, map);
  const auto fetched = Fetch(store, *belief, view, 1, [&] {
    ChangeAtRandom(map, rng);
    store.FramesSince(kHoldsNothing, *BeliefOf(++revision, map), view);
  });
  ASSERT_TRUE(fetched.ok()) << fetched.status();
  EXPECT_GT(revision, 20);
  EXPECT_EQ(fetched->revision, 1);
  ExpectLike(*fetched, first, view);
}

TEST(MapStoreTest, PartsOfARevisionThatIsGoneAreAborted) {
  Rng rng(6);
  RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 128, 128}, rng);
  MapStore store("hall", kAmple_bytes);
  std::int64_t revision = 1;
  const auto fetched = Fetch(store, *BeliefOf(revision, map), {}, 1, [&] {
    for (int others = 0; others < 20; ++others) {  // each of whom reads in parts
      ChangeAtRandom(map, rng);
      store.FirstPart(*BeliefOf(++revision, map), {}, 1);
    }
  });
  EXPECT_TRUE(absl::IsAborted(fetched.status()));
  EXPECT_EQ(ErrorReason(fetched.status()), reason::kMapPartsGone);
}

TEST(MapStoreTest, PlaceBeyondTheMapIsNoToken) {
  Rng rng(6);
  MapStore store("hall", kAmple_bytes);
  store.FirstPart(*BeliefOf(1, MakeRandomMap({0.0, 0.0, 0.1, 128, 128}, rng)), {}, 1);
  const auto refused = store.NextPart(PartToken({1, 1000}, "hall", {}), {}, 1).status();
  ASSERT_EQ(FieldViolations(refused).size(), 1u);
  EXPECT_EQ(FieldViolations(refused)[0].field, "part_token");
}

TEST(MapStoreTest, WhoComesWithAnOlderBeliefGetsTheNewer) {
  Rng rng(8);
  const RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 64, 64}, rng);
  MapStore store("hall", kAmple_bytes);
  store.Encode(*BeliefOf(9, map), {});
  EXPECT_EQ(store.Encode(*BeliefOf(8, map), {})->revision, 9);
  EXPECT_EQ(store.counts().revisions, 1);
}

TEST(MapStoreTest, AuditsAreNewsWithoutARevision) {
  Rng rng(8);
  const RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 64, 64}, rng);
  MapStore store("hall", kAmple_bytes);
  const auto before = BeliefOf(9, map);
  store.FirstPart(*before, {}, 0);
  Belief after = *before;
  after.gas_audits.audits = 1;
  v1::GetMapResponse response;
  ASSERT_TRUE(Parse(store.FirstPart(after, {}, 0), response).ok());
  EXPECT_EQ(response.status().gas_quality().audit_count(), 1);
  EXPECT_EQ(store.counts().tiles, 3);
}

// A map on which a second gas is what the first is not.
TEST(MapStoreTest, GasesAreToldToThoseWhoAskForThem) {
  Rng rng(11);
  const GridGeometry geometry{0.0, 0.0, 0.1, 128, 64};
  const RandomMap first = MakeRandomMap(geometry, rng);
  RandomMap second = first;
  for (float& value : second.values.values()) value += 1000.0F;
  Belief belief = *BeliefOf(3, first);
  MissionOptions options;
  options.gas_species.emplace_back().name = "methane";
  options.gas_species.emplace_back().name = "ozone";
  belief.options = std::make_shared<const MissionOptions>(options);
  GasField ozone;
  ozone.mean_ppm = std::make_shared<const Grid<float>>(second.values);
  ozone.variance_ppm2 = ozone.mean_ppm;
  ozone.counters.readings = 7;
  belief.further_gases = {ozone};
  MapStore store("hall", kAmple_bytes);
  const MapView plain{.full_precision = true};
  const auto of_first = Fetch(store, belief, plain, 0);
  ASSERT_TRUE(of_first.ok()) << of_first.status();
  EXPECT_TRUE(of_first->further_gases.empty());
  ASSERT_EQ(of_first->gases.size(), 2u);
  EXPECT_EQ(of_first->gases[1].species, "ozone");
  EXPECT_EQ(of_first->gases[1].counters.readings, 7);
  ExpectLike(*of_first, first, plain);
  EXPECT_EQ(store.counts().tiles, 6);
  MapView both = plain;
  both.species = {"ozone", "methane"};
  auto of_both = Fetch(store, belief, both, 1);
  ASSERT_TRUE(of_both.ok()) << of_both.status();
  EXPECT_EQ(store.counts().tiles, 10) << "the first was encoded before";
  ExpectLike(*of_both, first, plain);
  ASSERT_EQ(of_both->further_gases.size(), 1u);
  EXPECT_EQ(of_both->further_gases[0].species, "ozone");
  of_both->gas_mean_ppm = of_both->further_gases[0].mean_ppm;
  of_both->gas_variance_ppm2 = of_both->further_gases[0].variance_ppm2;
  ExpectLike(*of_both, second, plain);
  // Only what has changed is told of the second either.
  second.values[Cell{100, 10}] = second.states[Cell{100, 10}] == CellState::kFree ? 5.0F : NAN;
  const bool changes = second.states[Cell{100, 10}] == CellState::kFree;
  belief.revision = 4;
  belief.further_gases[0].mean_ppm = std::make_shared<const Grid<float>>(second.values);
  MapView ozone_only = both;
  ozone_only.species = {"ozone"};
  store.FramesSince(3, belief, ozone_only);
  EXPECT_EQ(store.counts().tiles, changes ? 11 : 10);
}

TEST(MapStoreTest, WorkIsSharedByAllWhoWantTheSame) {
  Rng rng(9);
  RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 128, 128}, rng);
  MapStore store("hall", kAmple_bytes);
  const auto first = BeliefOf(1, map);
  for (int i = 0; i < 100; ++i) {
    store.FramesSince(kHoldsNothing, *first, {});
    store.FirstPart(*first, {}, 0);
  }
  EXPECT_EQ(store.counts().revisions, 1);
  EXPECT_EQ(store.counts().tiles, 12);
  EXPECT_EQ(store.counts().frames, 1);
  map.states[Cell{100, 100}] = map.states[Cell{100, 100}] == CellState::kOccupied
                                   ? CellState::kUnknown
                                   : CellState::kOccupied;
  const auto second = BeliefOf(2, map);
  for (int i = 0; i < 100; ++i) store.FramesSince(1, *second, {});
  EXPECT_EQ(store.counts().revisions, 2);
  EXPECT_EQ(store.counts().tiles, 13);
  EXPECT_EQ(store.counts().frames, 2);
}

// Specks of the unknown all over free space: each is a frontier.
TEST(MapStoreTest, StatusLeavesRoomForTiles) {
  Rng rng(10);
  RandomMap map = MakeRandomMap({0.0, 0.0, 0.1, 64, 64}, rng);
  for (CellState& state : map.states.values()) {
    state = rng.Below(8) == 0 ? CellState::kUnknown : CellState::kFree;
  }
  map.states[Cell{32, 32}] = CellState::kFree;
  Belief belief = *BeliefOf(1, map);
  belief.robots["r1"].state.id = "r1";
  belief.robots["r1"].state.has_pose = true;
  belief.robots["r1"].state.pose = {3.25, 3.25, 0.0};
  const auto status_of = [&](std::int64_t max_bytes) {
    MapStore store("hall", max_bytes);
    v1::GetMapResponse response;
    EXPECT_TRUE(Parse(store.FirstPart(belief, {}, 0), response).ok());
    return response.status();
  };
  const v1::MapStatus whole = status_of(kAmple_bytes);
  ASSERT_GT(whole.frontiers_size(), 10);
  ASSERT_GT(whole.frontiers(0).cell_rows_size(), 0);
  const auto bytes = static_cast<std::int64_t>(whole.ByteSizeLong());
  const v1::MapStatus without_cells = status_of(2 * bytes - 2);
  EXPECT_EQ(without_cells.frontiers_size(), whole.frontiers_size());
  EXPECT_EQ(without_cells.frontiers(0).cell_rows_size(), 0);
  const v1::MapStatus short_list = status_of(1000);
  EXPECT_LE(short_list.ByteSizeLong(), 500u);
  EXPECT_LT(short_list.frontiers_size(), whole.frontiers_size());
  EXPECT_EQ(short_list.geometry().column_count(), 64);
}

}  // namespace map_store_test
}  // namespace plumescout::server
