// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Files of every version that was ever written: see golden/README.md.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "formats/file_io.h"
#include "formats/journal/journal_file.h"
#include "tests/formats/journal/golden_events.h"
#include "tests/support/same_bytes.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace golden_test {

using support::GoldenEvents;
using support::GoldenStart;

constexpr std::uint64_t kNoLimit = 1 << 20;

std::string Path(int version) {
  return absl::StrCat("tests/formats/journal/golden/version_", version, ".events");
}

// As versions 3 and 4 had them.
std::vector<Event> OlderEvents() {
  std::vector<Event> events = GoldenEvents();
  for (Event& event : events) {
    if (auto* registered = std::get_if<RobotRegistered>(&event.body)) registered->log_epoch = 0;
  }
  return events;
}

// Equal, bit by bit where numbers may be none.
void ExpectSame(const Event& event, const Event& expected) {
  EXPECT_EQ(EncodeEvent(event), EncodeEvent(expected));
  EXPECT_EQ(event.number, expected.number);
  ASSERT_EQ(event.body.index(), expected.body.index());
  const auto* observed = std::get_if<ObservationReceived>(&event.body);
  const bool is_scan =
      observed != nullptr && std::holds_alternative<Scan>(observed->observation.payload);
  if (!is_scan) {
    EXPECT_EQ(event, expected);
    return;
  }
  Event without_ranges = event;
  Event expected_without_ranges = expected;
  const auto take = [](Event& of) {
    Observation& observation = std::get<ObservationReceived>(of.body).observation;
    std::vector<float> ranges_m;
    ranges_m.swap(std::get<Scan>(observation.payload).ranges_m);
    return ranges_m;
  };
  const std::vector<float> ranges_m = take(without_ranges);
  const std::vector<float> expected_m = take(expected_without_ranges);
  EXPECT_EQ(without_ranges, expected_without_ranges);
  ASSERT_EQ(ranges_m.size(), expected_m.size());
  EXPECT_EQ(std::memcmp(ranges_m.data(), expected_m.data(), ranges_m.size() * sizeof(float)), 0);
}

void ExpectHolds(int version, const std::optional<JournalStart>& start,
                 const std::vector<Event>& events) {
  auto reader = JournalFileReader::Open(Path(version));
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start(), start);
  for (const Event& expected : events) {
    SCOPED_TRACE(expected.number);
    const auto event = reader->Next();
    ASSERT_TRUE(event.ok()) << event.status();
    ASSERT_TRUE(event->has_value());
    ExpectSame(**event, expected);
  }
  const auto end = reader->Next();
  ASSERT_TRUE(end.ok()) << end.status();
  EXPECT_FALSE(end->has_value());
  EXPECT_EQ(reader->torn_end(), "");
}

TEST(GoldenJournals, Version3HoldsTheEvents) { ExpectHolds(3, std::nullopt, OlderEvents()); }

TEST(GoldenJournals, Version4HoldsTheEvents) {
  JournalStart start;
  start.code_version = GoldenStart().code_version;
  start.mission_options = GoldenStart().mission_options;
  ExpectHolds(4, start, OlderEvents());
}

TEST(GoldenJournals, Version5HoldsTheEvents) { ExpectHolds(5, GoldenStart(), GoldenEvents()); }

TEST(GoldenJournals, TheNewestIsWhatIsWritten) {
  const TempFolder folder;
  const std::string path = folder.File("mission.events");
  auto writer = JournalFileWriter::Create(path, GoldenStart());
  ASSERT_TRUE(writer.ok()) << writer.status();
  for (const Event& event : GoldenEvents()) ASSERT_TRUE(writer->Append(event).ok());
  EXPECT_EQ(*ReadFile(path, kNoLimit), *ReadFile(Path(5), kNoLimit));
}

TEST(GoldenJournals, ScansTakeTheUnitTheyAreIn) {
  std::vector<std::size_t> sizes;
  for (const Scan& scan : support::GoldenScans()) {
    sizes.push_back(EncodeEvent({1, ObservationReceived{"r1", {1, 1, {}, scan}}}).size());
  }
  EXPECT_LT(sizes[0], sizes[1]);
  EXPECT_LT(sizes[1], sizes[2]);
}

TEST(GoldenJournals, EveryVersionIsTheSameMission) {
  std::vector<std::unique_ptr<Mission>> missions;
  for (const int version : {3, 4, 5}) {
    MissionOptions options;
    options.seed = support::kGoldenSeed;
    missions.push_back(std::make_unique<Mission>(options));
    auto reader = JournalFileReader::Open(Path(version));
    ASSERT_TRUE(reader.ok()) << reader.status();
    auto event = reader->Next();
    for (; event.ok() && *event; event = reader->Next()) {
      const auto applied = missions.back()->Apply((*event)->body);
      ASSERT_TRUE(applied.ok()) << (*event)->number << ": " << applied.status();
      ASSERT_EQ(applied->revision, (*event)->number);
    }
    ASSERT_TRUE(event.ok()) << event.status();
  }
  const auto expected = missions[2]->Snapshot();
  EXPECT_EQ(expected->posterior_time_ns, 1'700'000'001'600'000'000);
  for (const auto& mission : missions) {
    const auto belief = mission->Snapshot();
    EXPECT_EQ(belief->revision, expected->revision);
    EXPECT_EQ(belief->occupancy->values(), expected->occupancy->values());
    EXPECT_TRUE(support::SameBytes(*belief->gas_mean_ppm, *expected->gas_mean_ppm));
    EXPECT_TRUE(support::SameBytes(*belief->gas_variance_ppm2, *expected->gas_variance_ppm2));
  }
}

}  // namespace golden_test
}  // namespace plumescout
