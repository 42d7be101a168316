// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/journal_file_encoder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "formats/journal/journal_file.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace journal_file_encoder_test {

const JournalStart kStart{.code_version = "1.2.3",
                          .mission_options = "options",
                          .mission = "hall",
                          .owner = "alice",
                          .last_number = 2,
                          .last_digest = 77};
const Event kEvents[] = {{1, RobotRegistered{"r1", 0.2, 5, 0}}, {2, PosteriorRefreshed{3}}};

TEST(JournalFileEncoderTest, MakesWhatAWriterWrites) {
  TempFolder folder;
  const std::string path = folder.File("journal");
  auto writer = JournalFileWriter::Create(path, kStart);
  ASSERT_TRUE(writer.ok()) << writer.status();
  JournalFileEncoder encoder;
  std::string bytes = encoder.Begin(kStart);
  for (const Event& event : kEvents) {
    ASSERT_TRUE(writer->Append(event).ok());
    bytes += encoder.Record(EncodeEvent(event));
  }
  std::ostringstream written;
  written << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_TRUE(written.str() == bytes);
}

TEST(JournalFileEncoderTest, ReadersReadIt) {
  TempFolder folder;
  const std::string path = folder.File("journal");
  JournalFileEncoder encoder;
  std::ofstream file(path, std::ios::binary);
  file << encoder.Begin(kStart);
  for (const Event& event : kEvents) file << encoder.Record(EncodeEvent(event));
  file.close();
  auto reader = JournalFileReader::Open(path);
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start(), kStart);
  for (const Event& event : kEvents) {
    const auto read = reader->Next();
    ASSERT_TRUE(read.ok() && read->has_value()) << read.status();
    EXPECT_EQ(**read, event);
  }
  const auto end = reader->Next();
  EXPECT_TRUE(end.ok() && !end->has_value());
  EXPECT_EQ(reader->torn_end(), "");
}

}  // namespace journal_file_encoder_test
}  // namespace plumescout
