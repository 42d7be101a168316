// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/event_codec_v4.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>

// Files of these versions are decoded event by event in golden_test.cc.
namespace plumescout {
namespace event_codec_v4_test {

template <typename T>
std::string Raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::string Text(const std::string& text) {
  return Raw(static_cast<std::uint32_t>(text.size())) + text;
}

// Number and kind of an event.
std::string Head(std::int64_t number, char kind) { return Raw(number) + kind; }

TEST(EventCodecV4, ARobotHadNoLogEpoch) {
  const auto event =
      DecodeEventV4(Head(5, 0) + Text("r1") + Raw(0.25) + Raw(std::int64_t{1} << 40));
  ASSERT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(*event, (Event{5, RobotRegistered{"r1", 0.25, std::int64_t{1} << 40, 0}}));
}

TEST(EventCodecV4, NumbersAreOfFixedWidth) {
  const auto event =
      DecodeEventV4(std::string("\x03\0\0\0\0\0\0\0\x02\x08\x07\x06\x05\x04\x03\x02\x01", 17));
  ASSERT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(*event, (Event{3, PosteriorRefreshed{0x0102030405060708}}));
}

TEST(EventCodecV4, RangesAreFloats) {
  const std::string bytes = Head(6, 1) + Text("r1") + Raw(std::int64_t{9}) + Raw(std::int64_t{10}) +
                            Raw(1.5) + Raw(-2.5) + Raw(0.25) + '\0' + Raw(-3.0) + Raw(0.01) +
                            Raw(8.0) + Raw(std::uint32_t{2}) + Raw(1.25F) + Raw(2.0F);
  const auto event = DecodeEventV4(bytes);
  ASSERT_TRUE(event.ok()) << event.status();
  const Scan scan{-3.0, 0.01, 8.0, {1.25F, 2.0F}};
  EXPECT_EQ(*event, (Event{6, ObservationReceived{"r1", {9, 10, {1.5, -2.5, 0.25}, scan}}}));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(DecodeEventV4(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
  }
  EXPECT_EQ(DecodeEventV4(bytes + "x").status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodecV4, UnknownKindsAndEnumeratorsAreDataLoss) {
  EXPECT_TRUE(DecodeEventV4(Head(1, 6)).ok());
  EXPECT_EQ(DecodeEventV4(Head(1, 8)).status().code(), absl::StatusCode::kDataLoss);
  const std::string report = Head(1, 4) + Text("r") + Raw(std::int64_t{1});
  EXPECT_TRUE(DecodeEventV4(report + '\2').ok());
  EXPECT_EQ(DecodeEventV4(report + '\3').status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodecV4, ADamagedLengthDoesNotAllocate) {
  const std::string bytes = Head(1, 1) + Text("r") + Raw(std::int64_t{1}) + Raw(std::int64_t{2}) +
                            std::string(3 * sizeof(double), '\0') + '\0' +
                            std::string(3 * sizeof(double), '\0') + "\xFF\xFF\xFF\xFF";
  EXPECT_EQ(DecodeEventV4(bytes).status().code(), absl::StatusCode::kDataLoss);
}

TEST(EventCodecV4, TheStartHasVersionAndOptions) {
  const std::string bytes = Raw(std::int64_t{0}) + Text("1.2.3") + Text("options");
  const auto start = DecodeStartV4(bytes);
  ASSERT_TRUE(start.ok()) << start.status();
  JournalStart expected;
  expected.code_version = "1.2.3";
  expected.mission_options = "options";
  EXPECT_EQ(*start, expected);
  EXPECT_EQ(DecodeStartV4(bytes + "!").status().code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(DecodeStartV4("\1" + bytes.substr(1)).status().code(), absl::StatusCode::kDataLoss);
}

}  // namespace event_codec_v4_test
}  // namespace plumescout
