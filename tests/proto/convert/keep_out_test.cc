// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/keep_out.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "proto/convert/status.h"

namespace plumescout {
namespace keep_out_proto_test {

const std::vector<Polygon> kAreas = {{{{1, 2}, {3, 4}, {5, 7}}, "spill"},
                                     {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};

TEST(KeepOutProto, AreasSurviveTheRoundTrip) {
  const auto back = FromProto(ToProto(kAreas), "keep_out");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, kAreas);
}

TEST(KeepOutProto, ChangesAreRead) {
  v1::ChangeKeepOutAreasRequest request;
  request.add_deleted("ramp");
  *request.mutable_added() = ToProto(kAreas);
  const auto change = FromProto(request);
  ASSERT_TRUE(change.ok()) << change.status();
  EXPECT_EQ(*change, (KeepOutChanged{{"ramp"}, kAreas}));
  request.mutable_added(1)->mutable_vertices(2)->set_y_m(std::numeric_limits<double>::infinity());
  EXPECT_EQ(FieldViolations(FromProto(request).status()).at(0).field, "added[1].vertices[2].y_m");
}

}  // namespace keep_out_proto_test
}  // namespace plumescout
