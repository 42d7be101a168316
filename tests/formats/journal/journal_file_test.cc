// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/journal_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "tests/support/random_events.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace journal_file_test {

using testing::HasSubstr;

constexpr std::uint64_t kNoLimit = 1 << 24;
constexpr std::size_t kFileHeaderBytes = 12;
constexpr std::size_t kRecordHeaderBytes = 12;

// Fits no options of any mission: the journal does not read them.
JournalStart MakeStart() {
  JournalStart start;
  start.code_version = "1.2.3";
  start.mission_options = std::string("\0\xFF", 2);
  return start;
}

// All that a reader says until it ends.
struct Reading {
  std::optional<JournalStart> start;
  std::vector<std::string> events;  // encoded again
  absl::Status end;
  std::string torn_end;
};

class JournalFileTest : public testing::Test {
 protected:
  // Writes `count` random events and returns their encodings.
  std::vector<std::string> Write(int count) {
    auto writer = JournalFileWriter::Create(path_, MakeStart());
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
  Reading Read() const {
    Reading reading;
    auto reader = JournalFileReader::Open(path_);
    EXPECT_TRUE(reader.ok()) << reader.status();
    if (!reader.ok()) return reading;
    reading.start = reader->start();
    auto event = reader->Next();
    for (; event.ok() && *event; event = reader->Next()) {
      reading.events.push_back(EncodeEvent(**event));
    }
    reading.end = event.status();
    reading.torn_end = reader->torn_end();
    EXPECT_EQ(reader->Next().status(), reading.end);  // and says so again
    return reading;
  }
  // Of a file of `bytes`, whose start is whole.
  Reading ReadBytes(const std::string& bytes) const {
    EXPECT_TRUE(WriteFile(path_, bytes).ok());
    return Read();
  }
  absl::Status OpenBytes(const std::string& bytes) const {
    EXPECT_TRUE(WriteFile(path_, bytes).ok());
    return JournalFileReader::Open(path_).status();
  }
  static std::size_t RecordBytes(const std::string& body) {
    return kRecordHeaderBytes + body.size();
  }
  // Where event 1 begins.
  static std::size_t FirstEvent() {
    return kFileHeaderBytes + RecordBytes(EncodeStart(MakeStart()));
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("mission.events");
};

TEST_F(JournalFileTest, EventsComeBackInOrderBitForBit) {
  const std::vector<std::string> bodies = Write(300);
  const Reading reading = Read();
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.torn_end, "");
  EXPECT_EQ(reading.start, MakeStart());
  EXPECT_EQ(reading.events, bodies);
}

TEST_F(JournalFileTest, AJournalWithoutEventsIsWhole) {
  Write(0);
  const Reading reading = Read();
  EXPECT_TRUE(reading.end.ok());
  EXPECT_TRUE(reading.events.empty());
  EXPECT_EQ(reading.start, MakeStart());
}

TEST_F(JournalFileTest, PlansMayBeKeptForReplayOnly) {
  auto writer = JournalFileWriter::Create(path_, MakeStart());
  ASSERT_TRUE(writer.ok());
  Event event{1, PlanIssued{}};
  std::get<PlanIssued>(event.body).plan.candidates.resize(3);
  ASSERT_TRUE(writer->Append(event, PlanDetail::kForReplay).ok());
  ASSERT_TRUE(writer->Append(event).ok());
  EXPECT_EQ(Read().events, (std::vector<std::string>{EncodeEvent(event, PlanDetail::kForReplay),
                                                     EncodeEvent(event)}));
}

TEST_F(JournalFileTest, WithoutAWholeEventZeroNothingIsRead) {
  Write(2);
  const std::string bytes = Bytes();
  for (std::size_t size = kFileHeaderBytes; size < FirstEvent(); ++size) {
    const absl::Status status = OpenBytes(bytes.substr(0, size));
    ASSERT_EQ(status.code(), absl::StatusCode::kDataLoss) << size;
    ASSERT_THAT(std::string(status.message()), HasSubstr("event 0"));
  }
}

TEST_F(JournalFileTest, AnEventIsNotTakenForEventZero) {
  Write(1);
  const std::string bytes = Bytes();
  EXPECT_EQ(OpenBytes(bytes.substr(0, kFileHeaderBytes) + bytes.substr(FirstEvent())).code(),
            absl::StatusCode::kDataLoss);
}

TEST_F(JournalFileTest, EventsCanBeReadWhileTheWriterLives) {
  auto writer = JournalFileWriter::Create(path_, MakeStart());
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->Append({1, PosteriorRefreshed{5}}).ok());
  EXPECT_EQ(Read().events.size(), 1U);
}

TEST_F(JournalFileTest, AnExistingFileIsNotOverwritten) {
  Write(1);
  EXPECT_EQ(JournalFileWriter::Create(path_, MakeStart()).status().code(),
            absl::StatusCode::kAlreadyExists);
}

TEST_F(JournalFileTest, EveryTornTailKeepsTheEventsBeforeItAndIsReported) {
  const std::vector<std::string> bodies = Write(4);
  const std::string bytes = Bytes();
  std::vector<std::string> whole;  // records within the cut
  std::size_t end = FirstEvent();  // of the last whole record
  for (std::size_t size = FirstEvent(); size < bytes.size(); ++size) {
    if (size == end + RecordBytes(bodies[whole.size()])) {
      end = size;
      whole.push_back(bodies[whole.size()]);
    }
    const Reading reading = ReadBytes(bytes.substr(0, size));
    ASSERT_TRUE(reading.end.ok()) << reading.end;
    ASSERT_EQ(reading.events, whole);
    ASSERT_EQ(reading.torn_end.empty(), size == end) << size;
    if (size != end) {
      ASSERT_THAT(reading.torn_end, HasSubstr(absl::StrCat("at byte ", end, ", ", size - end)));
    }
  }
}

TEST_F(JournalFileTest, EveryFlippedBitIsFoundAndEventsBeforeItAreKept) {
  const std::vector<std::string> bodies = Write(3);
  const std::string bytes = Bytes();
  const std::size_t begin = FirstEvent() + RecordBytes(bodies[0]);
  for (std::size_t at = begin; at < begin + RecordBytes(bodies[1]); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      const Reading reading = ReadBytes(damaged);
      ASSERT_EQ(reading.end.code(), absl::StatusCode::kDataLoss) << at << " bit " << bit;
      ASSERT_THAT(std::string(reading.end.message()), HasSubstr(absl::StrCat("at byte ", begin)));
      ASSERT_THAT(std::string(reading.end.message()), HasSubstr(path_));
      ASSERT_EQ(reading.events, std::vector<std::string>{bodies[0]});
    }
  }
}

// The last record is damaged, not torn: a length that leads beyond the end is no excuse.
TEST_F(JournalFileTest, AFlippedBitOfTheLastLengthIsNoTornEnd) {
  const std::vector<std::string> bodies = Write(3);
  const std::string bytes = Bytes();
  const std::size_t at = bytes.size() - RecordBytes(bodies[2]);
  for (int bit = 0; bit < 32; ++bit) {
    std::string damaged = bytes;
    char& byte = damaged[at + static_cast<std::size_t>(bit / 8)];
    byte = static_cast<char>(byte ^ (1 << (bit % 8)));
    const Reading reading = ReadBytes(damaged);
    ASSERT_EQ(reading.end.code(), absl::StatusCode::kDataLoss) << bit;
    ASSERT_EQ(reading.events.size(), 2U);
  }
}

TEST_F(JournalFileTest, EveryFlippedBitOfTheBeginningIsFound) {
  Write(1);
  const std::string bytes = Bytes();
  for (std::size_t at = 0; at < FirstEvent(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      ASSERT_FALSE(OpenBytes(damaged).ok()) << at << " bit " << bit;
    }
  }
}

TEST_F(JournalFileTest, ARecordThatIsMissingOrElsewhereIsFound) {
  const std::vector<std::string> bodies = Write(3);
  const std::string bytes = Bytes();
  const std::size_t second = FirstEvent() + RecordBytes(bodies[0]);
  const std::size_t third = second + RecordBytes(bodies[1]);
  const Reading without_first = ReadBytes(bytes.substr(0, FirstEvent()) + bytes.substr(second));
  EXPECT_EQ(without_first.end.code(), absl::StatusCode::kDataLoss);
  EXPECT_TRUE(without_first.events.empty());
  const Reading swapped = ReadBytes(bytes.substr(0, second) + bytes.substr(third) +
                                    bytes.substr(second, third - second));
  EXPECT_EQ(swapped.end.code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(swapped.events.size(), 1U);
}

TEST_F(JournalFileTest, ARecordOfAnotherFileIsFound) {
  const std::vector<std::string> bodies = Write(1);
  const std::string bytes = Bytes();
  ASSERT_TRUE(WriteFile(path_, "").ok());
  const std::string other_path = folder_.File("other");
  JournalStart other = MakeStart();
  other.code_version = "1.2.4";
  ASSERT_TRUE(JournalFileWriter::Create(other_path, other).ok());
  const Reading reading = ReadBytes(*ReadFile(other_path, kNoLimit) + bytes.substr(FirstEvent()));
  EXPECT_EQ(reading.end.code(), absl::StatusCode::kDataLoss);
  EXPECT_TRUE(reading.events.empty());
}

TEST_F(JournalFileTest, ATailOfZerosIsNoEvent) {
  Write(2);
  const Reading reading = ReadBytes(Bytes() + std::string(4096, '\0'));
  EXPECT_EQ(reading.events.size(), 2U);
  EXPECT_EQ(reading.end.code(), absl::StatusCode::kDataLoss);
}

TEST_F(JournalFileTest, TellsHowFarItIs) {
  Write(50);
  auto reader = JournalFileReader::Open(path_);
  ASSERT_TRUE(reader.ok());
  double before = reader->share_read();
  EXPECT_GT(before, 0.0);
  EXPECT_LT(before, 0.1);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(reader->Next().ok());
    EXPECT_GT(reader->share_read(), before);
    before = reader->share_read();
  }
  EXPECT_EQ(before, 1.0);
}

TEST_F(JournalFileTest, FilesThatAreNoJournalAreRefused) {
  EXPECT_EQ(JournalFileReader::Open(path_).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(JournalFileReader::Open(folder_.path()).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(OpenBytes("something else entirely").code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(OpenBytes("").code(), absl::StatusCode::kDataLoss);
}

TEST_F(JournalFileTest, AnotherVersionIsRefusedByName) {
  Write(1);
  std::string bytes = Bytes();
  for (const int version : {2, 6, 99}) {
    bytes[8] = static_cast<char>(version);
    const absl::Status status = OpenBytes(bytes);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), HasSubstr(absl::StrCat("version ", version)));
    EXPECT_EQ(Bytes(), bytes);
  }
}

TEST_F(JournalFileTest, AFolderThatDoesNotExistIsUnavailable) {
  EXPECT_EQ(JournalFileWriter::Create(folder_.File("absent/a"), MakeStart()).status().code(),
            absl::StatusCode::kUnavailable);
}

}  // namespace journal_file_test
}  // namespace plumescout
