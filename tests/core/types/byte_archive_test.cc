// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/byte_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/types/byte_reader.h"
#include "core/types/rng.h"
#include "core/types/visit_types.h"

namespace plumescout {
namespace byte_archive_test {

constexpr std::size_t kRoom_bytes = 1 << 20;

// One of everything that archives know.
struct Everything {
  bool flag = true;
  std::int64_t number = -3;
  float fraction = -0.0F;
  GoalKind kind = GoalKind::kSite;
  std::string text = std::string("a\0b", 3);
  std::vector<Point2> list = {{1.0, 2.0}, {3.0, 4.0}};
  std::set<int> all = {1, 5};
  std::map<std::string, std::pair<int, int>> table = {{"x", {1, 2}}, {"y", {3, 4}}};
  std::array<double, 5> moments = {1.0, 0.0, -2.0, 0.0, 0.0};
  std::optional<Cell> some = Cell{7, 8};
  std::optional<Cell> none;
  std::shared_ptr<const Trajectory> way =
      std::make_shared<const Trajectory>(Trajectory{{{{1, 2, 3}, 4, 5, 6}}, 7, 8});
  std::shared_ptr<const Trajectory> no_way;
  Grid<CellState> grid = Grid<CellState>({0.0, 1.0, 0.1, 30, 20}, CellState::kFree);
  std::vector<float> runs = std::vector<float>(1000, 0.5F);

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.flag, self.number, self.fraction, self.kind, self.text, self.list, self.all);
    archive(self.table, self.moments, self.some, self.none, self.way, self.no_way, self.grid);
    archive.Runs(self.runs);
  }
};

template <typename T>
std::string BytesOf(const T& value) {
  ByteWriter writer;
  writer(value);
  return writer.sink().bytes;
}

std::uint64_t HashOf(const Everything& everything) {
  StateHasher hasher;
  hasher(everything);
  return hasher.sink().hash.value();
}

template <typename T>
absl::Status Read(const std::string& bytes, T& value, std::size_t room_bytes = kRoom_bytes) {
  ByteReader reader(bytes, room_bytes);
  reader(value);
  return reader.Finish();
}

TEST(ByteArchive, WhatIsReadIsWhatWasWritten) {
  Everything everything;
  everything.grid[Cell{3, 4}] = CellState::kOccupied;
  everything.runs[500] = std::nanf("");
  const std::string bytes = BytesOf(everything);
  Everything read;
  read.flag = false;
  read.fraction = 1.0F;
  read.kind = GoalKind::kHome;
  read.all = {2};
  read.table = {{"z", {}}};
  read.moments.fill(9.0);
  read.some.reset();
  read.none = Cell{};
  read.way = nullptr;
  read.no_way = std::make_shared<const Trajectory>();
  ASSERT_TRUE(Read(bytes, read).ok());
  EXPECT_EQ(BytesOf(read), bytes);
  EXPECT_EQ(HashOf(read), HashOf(everything));
  EXPECT_EQ(read.text, everything.text);
  EXPECT_EQ(read.list, everything.list);
  EXPECT_EQ(read.table, everything.table);
  EXPECT_EQ(read.moments, everything.moments);
  EXPECT_TRUE(std::signbit(read.fraction));
  EXPECT_EQ(*read.way, *everything.way);
  EXPECT_EQ(read.grid, everything.grid);
  EXPECT_TRUE(std::isnan(read.runs[500]));
  EXPECT_EQ(read.no_way, nullptr);
}

TEST(ByteArchive, RunsTakeLittleRoom) {
  std::vector<float> all(10'000, 0.5F);
  ByteWriter writer;
  writer.Runs(all);
  EXPECT_LT(writer.sink().bytes.size(), 250u);
}

TEST(ByteArchive, AnyOneBitShowsInTheHash) {
  const Everything everything;
  const std::uint64_t hash = HashOf(everything);
  Everything other = everything;
  other.fraction = 0.0F;
  EXPECT_NE(HashOf(other), hash);
  other = everything;
  other.runs[999] = std::nextafter(0.5F, 1.0F);
  EXPECT_NE(HashOf(other), hash);
  other = everything;
  other.none = Cell{};
  EXPECT_NE(HashOf(other), hash);
  other = everything;
  other.list.pop_back();
  EXPECT_NE(HashOf(other), hash);
}

TEST(ByteArchive, DamagedBytesAreRefusedOrReadAsOthers) {
  const std::string bytes = BytesOf(Everything());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Everything read;
    EXPECT_EQ(Read(bytes.substr(0, i), read).code(), absl::StatusCode::kDataLoss);
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(bytes[i]) ^ (1U << bit));
      Everything other;
      if (Read(damaged, other).ok()) {
        EXPECT_NE(BytesOf(other), bytes);
      }
    }
  }
  Everything read;
  EXPECT_EQ(Read(bytes + "x", read).message(), "bytes are left over");
}

TEST(ByteArchive, NoiseDoesNotAllocate) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    std::string noise(rng.Below(400), '\0');
    for (char& c : noise) c = static_cast<char>(rng.Below(256));
    Everything read;
    EXPECT_FALSE(Read(noise, read).ok());
  }
  ByteWriter writer;
  writer(std::uint64_t{1} << 60U, std::uint8_t{255}, 1.0F);
  std::vector<float> values;
  ByteReader reader(writer.sink().bytes, kRoom_bytes);
  reader.Runs(values);
  EXPECT_EQ(reader.Finish().message(), "a raster is too large");
  EXPECT_EQ(values.capacity(), 0u);
}

TEST(ByteArchive, RasterHasAsManyValuesAsItsSizeSays) {
  for (const auto& [width, height] : {std::pair(-1, -1), std::pair(4, 3), std::pair(1, 1)}) {
    ByteWriter writer;
    writer(GridGeometry{0.0, 0.0, 0.1, width, height});
    writer.Runs(std::vector<float>{1.0F});
    Grid<float> grid;
    EXPECT_EQ(Read(writer.sink().bytes, grid).ok(), width == 1);
  }
}

TEST(ByteArchive, KeysAscend) {
  ByteWriter writer;
  writer(std::uint32_t{2}, 5, 5);
  std::set<int> all;
  EXPECT_EQ(Read(writer.sink().bytes, all).message(), "elements are out of order");
}

}  // namespace byte_archive_test
}  // namespace plumescout
