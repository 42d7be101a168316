// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_wind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formats/file_io.h"
#include "tests/support/gaden_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace gaden_wind_test {

using support::Append;
using testing::HasSubstr;

// Wind of cell i: u = i, v = i / 2.
std::string Bytes3(std::size_t cells) {
  std::string bytes;
  Append<std::int32_t>(bytes, 3);
  Append<std::int32_t>(bytes, 0);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto u = static_cast<float>(i);
    for (const float speed : {u, u / 2.0F, -1.0F}) Append<float>(bytes, speed);
  }
  return bytes;
}

std::string Bytes2(std::size_t cells) {
  std::string bytes;
  for (const double factor : {1.0, 0.5, -1.0}) {
    for (std::size_t i = 0; i < cells; ++i) {
      Append<double>(bytes, factor * static_cast<double>(i));
    }
  }
  return bytes;
}

class GadenWindFile : public testing::Test {
 protected:
  absl::StatusOr<WindField> Read(const std::string& bytes, int z) {
    EXPECT_TRUE(WriteFile(path_, bytes).ok());
    return ReadGadenWind(path_, room_, z);
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("wind_iteration_0");
  const GadenEnvironment room_ = support::GadenRoom();
};

TEST_F(GadenWindFile, ReadsTheLayerOfBothForms) {
  for (const std::string& bytes : {Bytes3(room_.size()), Bytes2(room_.size())}) {
    const auto wind = Read(bytes, 2);
    ASSERT_TRUE(wind.ok()) << wind.status();
    EXPECT_EQ(wind->u_mps.geometry(), (GridGeometry{-1.0, 2.0, 0.5, 6, 5}));
    EXPECT_EQ(wind->u_mps[(Cell{3, 4})], 3.0F + 6.0F * (4.0F + 5.0F * 2.0F));
    EXPECT_EQ(wind->v_mps[(Cell{3, 4})], (3.0F + 6.0F * (4.0F + 5.0F * 2.0F)) / 2.0F);
  }
}

TEST_F(GadenWindFile, AFileOfAnotherLengthIsNamed) {
  const auto wind = Read(Bytes3(room_.size() - 1), 0);
  EXPECT_EQ(wind.status().code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(wind.status().message()),
              HasSubstr("wind_iteration_0: 1436 bytes, for 120 cells it must be 1448 or 2880"));
}

TEST_F(GadenWindFile, ASpeedThatIsNoNumberIsNamed) {
  std::string bytes = Bytes3(room_.size());
  std::string nan;
  Append<float>(nan, NAN);
  bytes.replace(8 + 12 * room_.Index(2, 1, 1), nan.size(), nan);
  EXPECT_TRUE(Read(bytes, 0).ok());  // in another layer
  const auto wind = Read(bytes, 1);
  EXPECT_EQ(wind.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(wind.status().message()), HasSubstr("cell (2, 1, 1) is nan"));
}

}  // namespace gaden_wind_test
}  // namespace plumescout::lab
