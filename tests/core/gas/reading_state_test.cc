// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_state.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "core/types/byte_reader.h"
#include "core/types/rng.h"

namespace plumescout {
namespace reading_state_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kResolution_m = 0.1;

std::string BytesOf(const ReadingStore& store) {
  ByteWriter writer;
  writer(store);
  return writer.sink().bytes;
}

// A store, and the states that it is placed on; both are read from bytes at any time.
struct Placed {
  explicit Placed(const GasOptions& options) : store(options, kResolution_m) {}

  void Place(const Grid<CellState>& news) {
    const auto changed = states.Update(news);
    ASSERT_TRUE(changed.ok());
    ASSERT_TRUE(store.Place(states.states(), *changed).ok());
    store.TakeChanged();
  }

  AnchoredStates states;
  ReadingStore store;
};

void ExpectSame(const Placed& a, const Placed& b) {
  EXPECT_EQ(BytesOf(a.store), BytesOf(b.store));
  EXPECT_EQ(a.store.counters(), b.store.counters());
  EXPECT_EQ(a.store.sites(), b.store.sites());
  EXPECT_EQ(a.store.buckets(), b.store.buckets());
  EXPECT_EQ(a.store.arrivals(), b.store.arrivals());
  EXPECT_EQ(a.store.anchor(), b.store.anchor());
  EXPECT_EQ(a.store.HasRoomFor({0.3, 0.3}), b.store.HasRoomFor({0.3, 0.3}));
  const auto all = a.store.AllEvidence();
  const auto same = b.store.AllEvidence();
  ASSERT_EQ(all.size(), same.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].cell, same[i].cell);
    EXPECT_EQ(all[i].evidence.precision, same[i].evidence.precision);
    EXPECT_EQ(all[i].evidence.weighted_deviation, same[i].evidence.weighted_deviation);
  }
}

// Two stores are told the same; one of them is written and read at every step.
void Compare(const GasOptions& options, std::uint64_t seed) {
  Placed live(options);
  Placed read(options);
  Rng rng(seed);
  std::int64_t now_ns = 0;
  for (int step = 0; step < 60; ++step) {
    now_ns += static_cast<std::int64_t>(rng.Below(5)) * kSecond_ns;
    for (int i = 0; i < 20; ++i) {
      const Point2 place{rng.Uniform(-0.3, 1.5), rng.Uniform(-0.3, 1.5)};
      const GasReading reading{rng.Uniform(0.0, 9.0),
                               rng.Below(2) == 0 ? 0.0 : rng.Uniform(0.01, 1.0)};
      live.store.Add(now_ns, place, reading);
      read.store.Add(now_ns, place, reading);
    }
    if (step > 5 && step % 3 == 0) {
      const int width = step < 30 ? 10 : 15;
      Grid<CellState> news(GridGeometry{step < 30 ? 0.0 : -0.2, 0.0, kResolution_m, width, 12});
      for (CellState& state : news.values()) state = static_cast<CellState>(rng.Below(3));
      live.Place(news);
      read.Place(news);
    }
    if (step % 7 == 6) {
      for (ReadingStore* store : {&live.store, &read.store}) {
        store->Compact(now_ns);
        store->AgeTo(now_ns);
        store->TakeChanged();
      }
    }
    for (ReadingStore* store : {&live.store, &read.store}) {
      store->AgeStale(now_ns);
      store->TakeChanged();
    }
    ByteWriter writer;
    writer(read.states, read.store);
    Placed again(options);
    ByteReader reader(writer.sink().bytes, 1 << 20);
    reader(again.states, again.store);
    ASSERT_TRUE(reader.Finish().ok()) << reader.Finish();
    ASSERT_TRUE(again.store.PlaceAgain(again.states));
    read = std::move(again);
    ExpectSame(live, read);
  }
}

TEST(ReadingState, ReadStoresGoOnTheSame) {
  GasOptions options;
  Compare(options, 1);
  options.ageing_half_life_s = 20.0;
  Compare(options, 2);
}

// What was written with `was` in it is read with `is` in its place.
absl::Status StatusWith(const GasOptions& options, double was, double is) {
  Placed live(options);
  live.store.Add(0, {0.55, 0.55}, {3.0, 0.1});
  live.Place(Grid<CellState>({0.0, 0.0, kResolution_m, 10, 10}, CellState::kFree));
  std::string bytes = BytesOf(live.store);
  const std::string from(reinterpret_cast<const char*>(&was), sizeof(was));
  const std::size_t place = bytes.find(from);
  EXPECT_NE(place, std::string::npos);
  std::memcpy(bytes.data() + place, &is, sizeof(is));
  Placed again(options);
  ByteReader reader(bytes, 1 << 20);
  reader(again.store);
  return reader.Finish();
}

TEST(ReadingState, WhatNoReadingSaysIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  GasOptions options;
  options.observation_precision_per_ppm2 = 7.0;
  const Evidence evidence =
      EvidenceOf(BucketOf(0, 0.1, 3.0), Ageing(options), 0);  // as Add makes it
  EXPECT_TRUE(StatusWith(options, evidence.precision, 11.0).ok());
  for (double is : {-10.0, nan, 1e101}) {
    EXPECT_FALSE(StatusWith(options, evidence.precision, is).ok()) << is;
    EXPECT_FALSE(StatusWith(options, evidence.weighted_deviation, is * 1e100).ok()) << is;
    EXPECT_FALSE(StatusWith(options, evidence.weighted_square, is).ok()) << is;
  }
  options.ageing_half_life_s = 20.0;
  EXPECT_TRUE(StatusWith(options, 1.0, 2.0).ok()) << "a bucket of two readings";
  EXPECT_FALSE(StatusWith(options, 1.0, -1.0).ok()) << "a bucket of minus one";
  EXPECT_FALSE(StatusWith(options, 9.0, -9.0).ok()) << "its square";
}

TEST(ReadingState, SitesOnOtherStatesAreNoticed) {
  Placed live{GasOptions()};
  const GridGeometry geometry{0.0, 0.0, kResolution_m, 10, 10};
  live.store.Add(0, {0.55, 0.55}, {1.0});
  live.Place(Grid<CellState>(geometry, CellState::kUnknown));
  ASSERT_EQ(live.store.counters().waiting, 1);
  AnchoredStates free;
  ASSERT_TRUE(free.Update(Grid<CellState>(geometry, CellState::kFree)).ok());
  ByteWriter writer;
  writer(free, live.store);
  Placed again{GasOptions()};
  ByteReader reader(writer.sink().bytes, 1 << 20);
  reader(again.states, again.store);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_FALSE(again.store.PlaceAgain(again.states)) << "nothing was ever placed in that cell";
}

}  // namespace reading_state_test
}  // namespace plumescout
