// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/convert/status.h"

namespace plumescout {
namespace geometry_test {

TEST(GeometryTest, ValuesSurviveTheRoundTrip) {
  const Pose2 pose{1.25, -7.5, -3.0};
  const Point2 point{-0.1, 1e6};
  const GridGeometry geometry{-3.2, 6.4, 0.1, 640, 128};
  EXPECT_EQ(FromProto(ToProto(pose), "pose").value(), pose);
  EXPECT_EQ(FromProto(ToProto(point), "point").value(), point);
  EXPECT_EQ(FromProto(ToProto(Cell{-3, 9})), (Cell{-3, 9}));
  EXPECT_EQ(FromProto(ToProto(geometry), "geometry").value(), geometry);
}

TEST(GeometryTest, HeadingsAreWrapped) {
  v1::Pose2D proto;
  proto.set_yaw_rad(3.0 * M_PI / 2.0);
  EXPECT_NEAR(FromProto(proto, "pose")->yaw_rad, -M_PI / 2.0, 1e-15);
}

TEST(GeometryTest, EveryCoordinateMustBeFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const char* name : {"x_m", "y_m", "yaw_rad"}) {
      v1::Pose2D proto;
      proto.GetReflection()->SetDouble(&proto, proto.GetDescriptor()->FindFieldByName(name), bad);
      const auto violations = FieldViolations(FromProto(proto, "pose").status());
      ASSERT_EQ(violations.size(), 1u);
      EXPECT_EQ(violations[0].field, std::string("pose.") + name);
    }
  }
}

TEST(GeometryTest, RasterTooLargeToAllocateIsRefused) {
  v1::GridGeometry proto;
  proto.set_resolution_m(0.1);
  proto.set_column_count(4001);
  proto.set_row_count(4000);
  EXPECT_EQ(FieldViolations(FromProto(proto, "g").status()).at(0).field, "g.row_count");
  proto.set_column_count(std::numeric_limits<int>::max());
  EXPECT_EQ(FieldViolations(FromProto(proto, "g").status()).at(0).field, "g.column_count");
  proto.set_column_count(-1);
  EXPECT_EQ(FieldViolations(FromProto(proto, "g").status()).at(0).field, "g.column_count");
}

TEST(GeometryTest, RasterNeedsAResolution) {
  EXPECT_EQ(FieldViolations(FromProto(v1::GridGeometry(), "g").status()).at(0).field,
            "g.resolution_m");
}

}  // namespace geometry_test
}  // namespace plumescout
