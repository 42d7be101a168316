// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/part_token.h"

#include <gtest/gtest.h>

#include "absl/strings/escaping.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace part_token_test {

TEST(PartTokenTest, TokenNamesItsPlace) {
  const MapView view{.level_of_detail = 2, .region = Rectangle{{-1.5, 0.1}, {2.0, 3.0}}};
  const PartPlace place{1234567890123, 77};
  EXPECT_EQ(ReadPartToken(PartToken(place, "hall", view), "hall", view).value(), place);
}

TEST(PartTokenTest, TokensOfOtherMapsAndOtherTextsAreRefused) {
  const MapView view{.region = Rectangle{{0.1, 0.2}, {0.3, 0.4}}};
  const std::string token = PartToken({5, 6}, "hall", view);
  MapView other = view;
  other.region->max.y_m = 0.4 + 1e-15;
  for (const MapView& wrong :
       {MapView{}, other, MapView{.full_precision = true, .region = view.region},
        MapView{.gas_mean = false, .region = view.region},
        MapView{.level_of_detail = 1, .region = view.region},
        MapView{.region = view.region, .species = {"ozone"}}}) {
    EXPECT_FALSE(ReadPartToken(token, "hall", wrong).ok());
  }
  EXPECT_FALSE(ReadPartToken(token, "hal", view).ok());
  for (const char* text : {"!", "aGFsbA", "NSA2", "NSB4IGhhbGw"}) {
    const auto refused = ReadPartToken(text, "hall", view).status();
    ASSERT_EQ(FieldViolations(refused).size(), 1u) << text;
    EXPECT_EQ(FieldViolations(refused)[0].field, "part_token");
  }
  const std::string negative = absl::WebSafeBase64Escape("5 -6 hall/11100");
  EXPECT_FALSE(ReadPartToken(negative, "hall", {}).ok());
}

}  // namespace part_token_test
}  // namespace plumescout::server
