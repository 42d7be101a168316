// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/event_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "formats/file_io.h"
#include "tests/support/random_events.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace event_log_test {

using testing::HasSubstr;

constexpr std::uint64_t kNoLimit = 1 << 24;
// Fits no options of any mission: the log does not read them.
const RecordingStart kStart = {"1.2.3", std::string("\0\xff", 2)};
// Magic, version and event 0.
const std::size_t kHeaderBytes = 12 + 8 + EncodeStart(kStart).size();

class EventLogTest : public testing::Test {
 protected:
  // Records `count` random events and returns their encodings.
  std::vector<std::string> Record(int count) {
    auto writer = EventLogWriter::Create(path_, kStart);
    EXPECT_TRUE(writer.ok()) << writer.status();
    RandomEvents events(6);
    std::vector<std::string> bodies;
    for (int i = 0; i < count; ++i) {
      const Event event = events.Next();
      EXPECT_TRUE(writer->Append(event).ok());
      bodies.push_back(EncodeEvent(event));
    }
    return bodies;
  }
  std::string Bytes() const { return *ReadFile(path_, kNoLimit); }
  // Reads a recording of `bytes`, whose header is whole.
  EventLog ReadBytes(const std::string& bytes) const {
    EXPECT_TRUE(WriteFile(path_, bytes).ok());
    auto log = ReadEventLog(path_);
    EXPECT_TRUE(log.ok()) << log.status();
    return log.ok() ? *std::move(log) : EventLog{};
  }
  static std::vector<std::string> Encodings(const EventLog& log) {
    std::vector<std::string> bodies;
    for (const Event& event : log.events) bodies.push_back(EncodeEvent(event));
    return bodies;
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("mission.events");
};

TEST_F(EventLogTest, EventsComeBackInOrderBitForBit) {
  const std::vector<std::string> bodies = Record(300);
  const auto log = ReadEventLog(path_);
  ASSERT_TRUE(log.ok()) << log.status();
  EXPECT_TRUE(log->end.ok()) << log->end;
  EXPECT_EQ(Encodings(*log), bodies);
}

TEST_F(EventLogTest, ARecordingWithoutEventsIsWhole) {
  Record(0);
  const auto log = ReadEventLog(path_);
  ASSERT_TRUE(log.ok()) << log.status();
  EXPECT_TRUE(log->end.ok());
  EXPECT_TRUE(log->events.empty());
  EXPECT_EQ(log->start, kStart);
}

TEST_F(EventLogTest, WithoutAWholeEventZeroNothingIsRead) {
  Record(2);
  const std::string bytes = Bytes();
  for (std::size_t size = 12; size < kHeaderBytes; ++size) {
    ASSERT_TRUE(WriteFile(path_, bytes.substr(0, size)).ok());
    const auto log = ReadEventLog(path_);
    ASSERT_EQ(log.status().code(), absl::StatusCode::kDataLoss) << size;
    ASSERT_THAT(std::string(log.status().message()), HasSubstr("event 0"));
  }
}

TEST_F(EventLogTest, AnEventIsNotTakenForEventZero) {
  Record(1);
  std::string bytes = Bytes();
  ASSERT_TRUE(WriteFile(path_, bytes.substr(0, 12) + bytes.substr(kHeaderBytes)).ok());
  EXPECT_EQ(ReadEventLog(path_).status().code(), absl::StatusCode::kDataLoss);
}

TEST_F(EventLogTest, VersionThreeBeginsWithEventOne) {
  const std::vector<std::string> bodies = Record(3);
  std::string bytes = Bytes();
  bytes.erase(12, kHeaderBytes - 12);
  bytes[8] = 3;
  const EventLog log = ReadBytes(bytes);
  EXPECT_TRUE(log.end.ok()) << log.end;
  EXPECT_FALSE(log.start.has_value());
  EXPECT_EQ(Encodings(log), bodies);
}

TEST_F(EventLogTest, EventsCanBeReadWhileTheWriterLives) {
  auto writer = EventLogWriter::Create(path_, kStart);
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->Append({1, PosteriorRefreshed{5}}).ok());
  EXPECT_EQ(ReadEventLog(path_)->events.size(), 1U);
}

TEST_F(EventLogTest, AnExistingFileIsNotOverwritten) {
  Record(1);
  EXPECT_EQ(EventLogWriter::Create(path_, kStart).status().code(),
            absl::StatusCode::kAlreadyExists);
}

TEST_F(EventLogTest, EveryTornTailKeepsTheEventsBeforeItAndIsReported) {
  const std::vector<std::string> bodies = Record(4);
  const std::string bytes = Bytes();
  std::size_t whole = 0;           // records within the cut
  std::size_t end = kHeaderBytes;  // of the last whole record
  for (std::size_t size = kHeaderBytes; size < bytes.size(); ++size) {
    if (size == end + 8 + bodies[whole].size()) {
      end = size;
      ++whole;
    }
    const EventLog log = ReadBytes(bytes.substr(0, size));
    ASSERT_EQ(Encodings(log),
              std::vector<std::string>(bodies.begin(),
                                       bodies.begin() + static_cast<std::ptrdiff_t>(whole)));
    ASSERT_EQ(log.end.ok(), size == end) << size;
    if (size != end) {
      ASSERT_THAT(std::string(log.end.message()), HasSubstr("torn"));
    }
  }
}

TEST_F(EventLogTest, EveryFlippedBitIsFoundAndEventsBeforeItAreKept) {
  const std::vector<std::string> bodies = Record(3);
  const std::string bytes = Bytes();
  const std::size_t first_end = kHeaderBytes + 8 + bodies[0].size();
  for (std::size_t at = first_end; at < first_end + 8 + bodies[1].size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      const EventLog log = ReadBytes(damaged);
      ASSERT_EQ(log.end.code(), absl::StatusCode::kDataLoss) << at << " bit " << bit;
      ASSERT_EQ(Encodings(log), std::vector<std::string>{bodies[0]});
    }
  }
}

TEST_F(EventLogTest, ATailOfZerosIsNoEvent) {
  Record(2);
  const EventLog log = ReadBytes(Bytes() + std::string(4096, '\0'));
  EXPECT_EQ(log.events.size(), 2U);
  EXPECT_EQ(log.end.code(), absl::StatusCode::kDataLoss);
}

TEST_F(EventLogTest, FilesThatAreNoRecordingAreRefused) {
  EXPECT_EQ(ReadEventLog(path_).status().code(), absl::StatusCode::kNotFound);
  ASSERT_TRUE(WriteFile(path_, "something else entirely").ok());
  EXPECT_EQ(ReadEventLog(path_).status().code(), absl::StatusCode::kDataLoss);
  ASSERT_TRUE(WriteFile(path_, "").ok());
  EXPECT_EQ(ReadEventLog(path_).status().code(), absl::StatusCode::kDataLoss);
}

TEST_F(EventLogTest, AnotherVersionIsRefused) {
  Record(1);
  std::string bytes = Bytes();
  bytes[8] = 99;
  ASSERT_TRUE(WriteFile(path_, bytes).ok());
  const auto log = ReadEventLog(path_);
  EXPECT_EQ(log.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(log.status().message()), HasSubstr("version 99"));
}

TEST_F(EventLogTest, AFolderThatDoesNotExistIsUnavailable) {
  EXPECT_EQ(EventLogWriter::Create(folder_.File("absent/a"), kStart).status().code(),
            absl::StatusCode::kUnavailable);
}

}  // namespace event_log_test
}  // namespace plumescout::lab
