// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formats/file_io.h"
#include "formats/zlib_codec.h"
#include "tests/support/gaden_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace gaden_frame_test {

using support::Append;
using support::FrameBytes2;
using support::FrameBytes3;
using support::SampleFrame;
using testing::HasSubstr;

void ExpectError(const std::string& bytes, absl::StatusCode code, const std::string& message) {
  const auto frame = ParseGadenFrame(bytes);
  EXPECT_EQ(frame.status().code(), code) << frame.status();
  EXPECT_THAT(std::string(frame.status().message()), HasSubstr(message));
}

void ExpectSample(const absl::StatusOr<GadenFrame>& frame) {
  ASSERT_TRUE(frame.ok()) << frame.status();
  const GadenFrame expected = SampleFrame();
  EXPECT_EQ(frame->cells, expected.cells);
  EXPECT_EQ(frame->source_m, expected.source_m);
  EXPECT_EQ(frame->moles_per_filament, expected.moles_per_filament);
  EXPECT_EQ(frame->moles_per_cm3, expected.moles_per_cm3);
  EXPECT_EQ(frame->wind_index, expected.wind_index);
  EXPECT_EQ(frame->filaments, expected.filaments);
  EXPECT_TRUE(frame->concentrations_ppm.empty());
}

TEST(GadenFrameTest, ReadsFilamentsOfVersion3) {
  const auto frame = ParseGadenFrame(FrameBytes3(SampleFrame()));
  ExpectSample(frame);
  EXPECT_EQ(frame->version_major, 3);
}

TEST(GadenFrameTest, ReadsFilamentsOfVersion2) {
  for (const int minor : {0, 4, 5}) {
    const auto frame = ParseGadenFrame(FrameBytes2(SampleFrame(), minor));
    ExpectSample(frame);
    EXPECT_EQ(frame->version_minor, minor);
  }
}

TEST(GadenFrameTest, ReadsConcentrations) {
  GadenFrame sample = SampleFrame();
  for (int i = 0; i < 6 * 5 * 4; ++i) sample.concentrations_ppm.push_back(static_cast<float>(i));
  const auto frame = ParseGadenFrame(FrameBytes3(sample));
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->concentrations_ppm, sample.concentrations_ppm);
  EXPECT_TRUE(frame->filaments.empty());
}

TEST(GadenFrameTest, SkipsTheSizesOfSources) {
  const std::string bytes = FrameBytes3(SampleFrame());
  const std::string point = std::string("\5\0\0\0\0\0\0\0", 8) + "point";
  const struct {
    const char* type;
    int numbers;
  } sources[] = {{"sphere", 1}, {"cylinder", 2}, {"box", 3}, {"line", 3}};
  for (const auto& source : sources) {
    std::string head;
    support::AppendText(head, source.type);
    for (int i = 0; i < source.numbers; ++i) Append<float>(head, 0.5F);
    std::string other = bytes;
    ExpectSample(ParseGadenFrame(other.replace(bytes.find(point), point.size(), head)));
  }
}

TEST(GadenFrameTest, LeavesOutFilamentsThatAreGone) {
  std::string bytes = FrameBytes3(SampleFrame());
  bytes[bytes.size() - 4] = 0;  // the flag of the last filament
  const auto frame = ParseGadenFrame(bytes);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->filaments.size(), 1u);
}

// A filament whose centre is at c ppm holds c 1e-6 n (2 pi)^(3/2) sigma^3 moles, n those of all
// gases in a cubic centimetre.
TEST(GadenFrameTest, KnowsThePeakOfAFilament) {
  GadenFrame frame;
  frame.moles_per_cm3 = 4.09e-5;  // 298 K, 1 atm
  const double sigma_cm = 10.0;
  frame.moles_per_filament =
      20e-6 * frame.moles_per_cm3 * std::pow(2.0 * M_PI, 1.5) * std::pow(sigma_cm, 3);
  EXPECT_NEAR(frame.PeakPpm({{}, sigma_cm}), 20.0, 1e-9);
  EXPECT_NEAR(frame.PeakPpm({{}, 2.0 * sigma_cm}), 2.5, 1e-9);
}

TEST(GadenFrameTest, NamesVersionsItCannotRead) {
  std::string first;
  Append<std::int32_t>(first, 1);
  ExpectError(first + std::string(200, '\0'), absl::StatusCode::kInvalidArgument,
              "written by GADEN 1;");
  ExpectError(FrameBytes2(SampleFrame(), 6), absl::StatusCode::kInvalidArgument,
              "written by GADEN 2.6;");
  std::string fourth = FrameBytes3(SampleFrame());
  fourth[0] = 4;
  ExpectError(fourth, absl::StatusCode::kInvalidArgument, "written by GADEN 4.0;");
}

TEST(GadenFrameTest, EveryTruncationIsDataLoss) {
  const std::string bytes = FrameBytes3(SampleFrame());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(ParseGadenFrame(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss)
        << size;
  }
  ExpectError(bytes + "x", absl::StatusCode::kDataLoss, "1 bytes follow");
  const std::string old = FrameBytes2(SampleFrame());
  ExpectError(old.substr(0, old.size() - 1), absl::StatusCode::kDataLoss, "35 bytes follow");
  ExpectError(old.substr(0, 60), absl::StatusCode::kDataLoss, "ends early");
}

TEST(GadenFrameTest, ACountThatIsTooLargeIsDataLoss) {
  std::string bytes = support::FrameHead3(SampleFrame(), "filaments");
  Append<std::uint64_t>(bytes, ~std::uint64_t{0});
  ExpectError(bytes, absl::StatusCode::kDataLoss, "ends early");
}

TEST(GadenFrameTest, NamesFieldsOutOfRange) {
  const auto with = [](auto&& change) {
    GadenFrame frame = SampleFrame();
    change(frame);
    return FrameBytes3(frame);
  };
  constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
  ExpectError(with([](GadenFrame& f) { f.moles_per_cm3 = 0.0; }), kInvalid, "moles per cm3 = 0");
  ExpectError(with([](GadenFrame& f) { f.moles_per_filament = NAN; }), kInvalid,
              "moles per filament = nan");
  ExpectError(with([](GadenFrame& f) { f.wind_index = -1; }), kInvalid, "wind index = -1");
  ExpectError(with([](GadenFrame& f) { f.source_m[1] = INFINITY; }), kInvalid, "source position");
  ExpectError(with([](GadenFrame& f) { f.filaments[1].sigma_cm = 0.0; }), kInvalid,
              "filament sigma = 0");
  ExpectError(with([](GadenFrame& f) { f.filaments[0].position_m[2] = NAN; }), kInvalid,
              "filament position = nan");
  ExpectError(with([](GadenFrame& f) { f.concentrations_ppm = {1.0F}; }), kInvalid,
              "1 concentrations for 120 cells");
  ExpectError(with([](GadenFrame& f) { f.concentrations_ppm.assign(120, -1.0F); }), kInvalid,
              "concentration = -1");
  ExpectError(support::FrameHead3(SampleFrame(), "voxels"), kInvalid, "mode \"voxels\"");
}

TEST(GadenFrameTest, FilesAreZlibStreamsAndNamedInErrors) {
  const TempFolder folder;
  const std::string path = folder.File("iteration_0");
  ASSERT_TRUE(WriteFile(path, CompressZlib(FrameBytes3(SampleFrame()))).ok());
  ExpectSample(ReadGadenFrame(path));
  ASSERT_TRUE(WriteFile(path, FrameBytes3(SampleFrame())).ok());  // not packed
  const auto raw = ReadGadenFrame(path);
  EXPECT_EQ(raw.status().code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(raw.status().message()), HasSubstr(path));
  EXPECT_EQ(ReadGadenFrame(folder.File("none")).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace gaden_frame_test
}  // namespace plumescout::lab
