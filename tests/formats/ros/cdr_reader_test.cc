// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/ros/cdr_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/ros/cdr_writer.h"
#include "formats/ros/messages.h"

namespace plumescout::ros {
namespace cdr_reader_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Bytes(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

LaserScan SomeScan() {
  LaserScan scan;
  scan.header = {.stamp = {7, 9}, .frame_id = "laser"};
  scan.angle_min = -1.5F;
  scan.range_max = 8.0F;
  scan.ranges = {1.0F, 2.5F, 4.0F};
  scan.intensities = {3.0F};
  return scan;
}

// The bytes are those that the format asks for, not only what our writer makes.
TEST(CdrReader, AlignsFieldsToTheirOwnSize) {
  const auto wind = DecodeCdr<Anemometer>(
      Bytes({0, 1, 0, 0, 5, 0, 0,   0,   6, 0, 0, 0, 2,    0,    0, 0, 'a', 0,
             0, 0, 3, 0, 0, 0, 'b', 'c', 0, 0, 0, 0, 0x80, 0x3f, 0, 0, 0,   0x40}));
  ASSERT_TRUE(wind.ok()) << wind.status();
  EXPECT_EQ(wind->header.stamp.sec, 5);
  EXPECT_EQ(wind->header.stamp.nanosec, 6u);
  EXPECT_EQ(wind->header.frame_id, "a");
  EXPECT_EQ(wind->sensor_label, "bc");
  EXPECT_EQ(wind->wind_speed, 1.0F);
  EXPECT_EQ(wind->wind_direction, 2.0F);
}

TEST(CdrReader, ReadsBigEndian) {
  const auto wind = DecodeCdr<Anemometer>(
      Bytes({0, 0, 0, 0, 0, 0, 0,   5,   0, 0, 0,    6,    0, 0, 0,    2, 'a', 0,
             0, 0, 0, 0, 0, 3, 'b', 'c', 0, 0, 0x3f, 0x80, 0, 0, 0x40, 0, 0,   0}));
  ASSERT_TRUE(wind.ok()) << wind.status();
  EXPECT_EQ(wind->header.stamp.sec, 5);
  EXPECT_EQ(wind->wind_direction, 2.0F);
}

TEST(CdrReader, ReadsWhatIsWritten) {
  const auto scan = DecodeCdr<LaserScan>(EncodeCdr(SomeScan()));
  ASSERT_TRUE(scan.ok()) << scan.status();
  EXPECT_EQ(scan->header.frame_id, "laser");
  EXPECT_EQ(scan->angle_min, -1.5F);
  EXPECT_THAT(scan->ranges, ElementsAre(1.0F, 2.5F, 4.0F));
  EXPECT_THAT(scan->intensities, ElementsAre(3.0F));
}

TEST(CdrReader, NamesAnEncodingThatItDoesNotKnow) {
  std::string bytes = EncodeCdr(SomeScan());
  bytes[1] = 7;  // XCDR2
  EXPECT_THAT(DecodeCdr<LaserScan>(bytes).status().message(),
              HasSubstr("sensor_msgs/msg/LaserScan: encoding 7 is not plain CDR"));
  EXPECT_THAT(DecodeCdr<LaserScan>("").status().message(), HasSubstr("no encapsulation"));
}

TEST(CdrReader, RefusesAMessageThatIsCutAnywhere) {
  const std::string bytes = EncodeCdr(SomeScan());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeCdr<LaserScan>(bytes.substr(0, size)).ok()) << size;
  }
}

TEST(CdrReader, RefusesLengthsBeyondTheMessage) {
  std::string bytes = EncodeCdr(TfMessage{.transforms = {{}}});
  bytes[7] = 0x7f;  // two thousand million transforms
  EXPECT_THAT(DecodeCdr<TfMessage>(bytes).status().message(),
              HasSubstr("a sequence is longer than the message"));
  bytes = EncodeCdr(Anemometer{});
  bytes[15] = 0x7f;
  EXPECT_THAT(DecodeCdr<Anemometer>(bytes).status().message(),
              HasSubstr("a text is longer than the message"));
}

TEST(CdrReader, RefusesATextWithoutEnd) {
  std::string bytes = EncodeCdr(Anemometer{.header = {.stamp = {}, .frame_id = "ab"}});
  bytes[18] = 'c';
  EXPECT_THAT(DecodeCdr<Anemometer>(bytes).status().message(), HasSubstr("a text has no end"));
}

TEST(CdrReader, TakesPaddingButNoOtherMessage) {
  const std::string bytes = EncodeCdr(SomeScan());
  EXPECT_TRUE(DecodeCdr<LaserScan>(bytes + std::string(4, '\0')).ok());
  EXPECT_THAT(DecodeCdr<LaserScan>(bytes + std::string(8, '\0')).status().message(),
              HasSubstr("8 bytes beyond the message"));
}

}  // namespace cdr_reader_test
}  // namespace plumescout::ros
