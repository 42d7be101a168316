// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/map_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "absl/strings/str_replace.h"
#include "formats/file_io.h"
#include "formats/pgm.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace map_server_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr CellState kUnknown = CellState::kUnknown;
constexpr CellState kFree = CellState::kFree;
constexpr CellState kOccupied = CellState::kOccupied;

constexpr char kYaml[] =
    "image: m.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.5, 2.25, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

// Reads a map of `image` under the header kYaml with `from` replaced by `to`.
absl::StatusOr<Grid<CellState>> ReadWith(const GrayImage& image, const std::string& from,
                                         const std::string& to) {
  const TempFolder folder;
  EXPECT_TRUE(WritePgm(image, folder.File("m.pgm")).ok());
  const std::string yaml = from.empty() ? kYaml : absl::StrReplaceAll(kYaml, {{from, to}});
  EXPECT_TRUE(WriteFile(folder.File("m.yaml"), yaml).ok());
  return ReadMapServer(folder.File("m.yaml"));
}

absl::StatusCode CodeWith(const std::string& from, const std::string& to) {
  return ReadWith({1, 1, {254}}, from, to).status().code();
}

TEST(MapServer, GreysBecomeStatesByTheThresholds) {
  const auto map = ReadWith({4, 1, {254, 0, 205, 127}}, "", "");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_THAT(map->values(), ElementsAre(kFree, kOccupied, kUnknown, kUnknown));
  EXPECT_EQ(map->geometry(), (GridGeometry{-1.5, 2.25, 0.05, 4, 1}));
}

std::string PgmOf(const GrayImage& image) {
  const TempFolder folder;
  EXPECT_TRUE(WritePgm(image, folder.File("m.pgm")).ok());
  return *ReadFile(folder.File("m.pgm"), 1 << 20);
}

TEST(MapServer, FromMemoryIsTheSameMap) {
  const GrayImage image = {3, 2, {254, 0, 205, 0, 254, 254}};
  const auto map = ParseMapServer(kYaml, PgmOf(image));
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(*map, *ReadWith(image, "", ""));
}

TEST(MapServer, FromMemoryTheNameOfTheImageDoesNotMatter) {
  const std::string yaml = absl::StrReplaceAll(kYaml, {{"image: m.pgm\n", ""}});
  EXPECT_TRUE(ParseMapServer(yaml, PgmOf({1, 1, {254}})).ok());
  EXPECT_EQ(CodeWith("image: m.pgm", "negate: 0"), absl::StatusCode::kDataLoss);
}

TEST(MapServer, ErrorsFromMemorySayWhichHalfAndWhere) {
  const std::string pgm = PgmOf({2, 2, {254, 254, 254, 254}});
  const auto error = [](const std::string& yaml, const std::string& image) {
    const absl::Status status = ParseMapServer(yaml, image).status();
    EXPECT_FALSE(status.ok());
    return std::string(status.message());
  };
  const auto with = [](const char* from, const char* to) {
    return absl::StrReplaceAll(kYaml, {{from, to}});
  };
  EXPECT_THAT(error("resolution: [", pgm), AllOf(StartsWith("yaml "), HasSubstr("line 1")));
  EXPECT_THAT(error("", pgm), StartsWith("yaml "));
  EXPECT_THAT(error("just words", pgm), StartsWith("yaml "));
  EXPECT_THAT(error(std::string(60'000, '['), pgm), StartsWith("yaml "));
  EXPECT_THAT(error(std::string(70'000, ' '), pgm), StartsWith("yaml of 70000 bytes"));
  EXPECT_THAT(error(with("0.0]", "0.5]"), pgm), StartsWith("yaml origin yaw = 0.5"));
  EXPECT_THAT(error(with("0.05", ".nan"), pgm), StartsWith("yaml resolution = nan"));
  EXPECT_THAT(error(kYaml, ""), StartsWith("pgm no binary PGM"));
  EXPECT_THAT(error(kYaml, "P5 2 x 255 "), AllOf(StartsWith("pgm "), HasSubstr("byte 5")));
  EXPECT_THAT(error(kYaml, pgm.substr(0, pgm.size() - 1)),
              StartsWith("pgm pixels are missing: 3 of 4"));
}

TEST(MapServer, TheThresholdsOfTheFileAreHonoured) {
  // Grey 205 means p = 50/255 = 0.196078, grey 100 means p = 155/255 = 0.6078.
  const auto free = ReadWith({2, 1, {205, 100}}, "0.196", "0.25");
  ASSERT_TRUE(free.ok()) << free.status();
  EXPECT_THAT(free->values(), ElementsAre(kFree, kUnknown));
  const auto occupied = ReadWith({2, 1, {205, 100}}, "0.65", "0.6");
  ASSERT_TRUE(occupied.ok()) << occupied.status();
  EXPECT_THAT(occupied->values(), ElementsAre(kUnknown, kOccupied));
}

TEST(MapServer, NegateTurnsGreysRound) {
  const auto map = ReadWith({3, 1, {255, 0, 100}}, "negate: 0", "negate: 1");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_THAT(map->values(), ElementsAre(kOccupied, kFree, kUnknown));
}

TEST(MapServer, TheFirstRowOfTheImageIsTheNorthernOne) {
  const auto map = ReadWith({1, 3, {0, 254, 205}}, "", "");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->values()[2], kOccupied);
  EXPECT_EQ(map->values()[1], kFree);
  EXPECT_EQ(map->values()[0], kUnknown);
}

TEST(MapServer, TrinaryIsTheDefaultMode) {
  EXPECT_EQ(CodeWith("mode: trinary\n", ""), absl::StatusCode::kOk);
}

TEST(MapServer, WhatIsWrittenComesBack) {
  const TempFolder folder;
  Grid<CellState> map({-5.5, 1.0 / 3.0, 0.1, 3, 2});
  map.values() = {kFree, kOccupied, kUnknown, kOccupied, kFree, kFree};
  ASSERT_TRUE(WriteMapServer(map, folder.File("lab.yaml")).ok());
  const auto read = ReadMapServer(folder.File("lab.yaml"));
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(*read, map);
}

TEST(MapServer, FieldsOutOfRangeAreRefused) {
  const absl::StatusCode invalid = absl::StatusCode::kInvalidArgument;
  EXPECT_EQ(CodeWith("trinary", "raw"), invalid);
  EXPECT_EQ(CodeWith("0.05", "0"), invalid);
  EXPECT_EQ(CodeWith("0.05", "-1"), invalid);
  EXPECT_EQ(CodeWith("0.05", ".nan"), invalid);
  EXPECT_EQ(CodeWith("0.05", ".inf"), invalid);
  EXPECT_EQ(CodeWith("-1.5", "1e9"), invalid);
  EXPECT_EQ(CodeWith("-1.5", ".nan"), invalid);
  EXPECT_EQ(CodeWith("2.25, 0.0", "2.25, 0.1"), invalid);
  EXPECT_EQ(CodeWith("0.65", "1.5"), invalid);
  EXPECT_EQ(CodeWith("0.196", ".nan"), invalid);
  EXPECT_EQ(CodeWith("0.196", "0.7"), invalid);
}

TEST(MapServer, FilesThatDoNotParseAreDataLoss) {
  const absl::StatusCode loss = absl::StatusCode::kDataLoss;
  EXPECT_EQ(CodeWith(kYaml, ""), loss);
  EXPECT_EQ(CodeWith(kYaml, "just a text"), loss);
  EXPECT_EQ(CodeWith(kYaml, "[1, 2"), loss);
  EXPECT_EQ(CodeWith("image: m.pgm\n", ""), loss);
  EXPECT_EQ(CodeWith("0.05", "fine"), loss);
  EXPECT_EQ(CodeWith("[-1.5, 2.25, 0.0]", "[-1.5]"), loss);
  EXPECT_EQ(CodeWith("[-1.5, 2.25, 0.0]", "3"), loss);
  EXPECT_EQ(CodeWith("negate: 0\n", ""), loss);
}

TEST(MapServer, MissingFilesAreNotFoundAndNamed) {
  EXPECT_EQ(ReadMapServer("/nowhere/m.yaml").status().code(), absl::StatusCode::kNotFound);
  const auto map = ReadWith({1, 1, {254}}, "m.pgm", "gone.pgm");
  EXPECT_EQ(map.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(map.status().message()), HasSubstr("gone.pgm"));
}

TEST(MapServer, MapsWithoutCellsOrPlaceAreNotWritten) {
  const TempFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(WriteMapServer(Grid<CellState>(), folder.File("m.yaml")).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(WriteMapServer(Grid<CellState>({nan, 0, 0.1, 1, 1}), folder.File("m.yaml")).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(WriteMapServer(Grid<CellState>({0, 0, nan, 1, 1}), folder.File("m.yaml")).code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace map_server_test
}  // namespace plumescout
