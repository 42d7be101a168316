// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/calibration_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace plumescout::lab {
namespace calibration_json_test {

TEST(CalibrationJson, ReadsBackWhatItWrote) {
  const MapCalibration map{0.1 + 0.2, 0.5, 0.25, -1.0 / 3.0, 0.75, 1.0, 1.5, 7};
  EXPECT_EQ(CalibrationFrom(nlohmann::json::parse(ToJson(map).dump())), map);
}

TEST(CalibrationJson, NanIsNull) {
  MapCalibration map;
  map.rms_z = std::nan("");
  const auto value = nlohmann::json::parse(ToJson(map).dump());
  EXPECT_TRUE(value.at("rms_z").is_null());
  EXPECT_TRUE(std::isnan(CalibrationFrom(value).rms_z));
}

TEST(CalibrationJson, AMissingFigureIsAnError) {
  auto value = ToJson(MapCalibration{});
  value.erase("within_2_sigma");
  EXPECT_THROW(CalibrationFrom(value), nlohmann::json::exception);
}

}  // namespace calibration_json_test
}  // namespace plumescout::lab
