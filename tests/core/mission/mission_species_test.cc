// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions that map several gases.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/mission/mission.h"
#include "core/types/byte_archive.h"
#include "core/types/species.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_species_test {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::size_t kGases = 2;
constexpr char kSecond[] = "hydrogen-sulfide";

MissionOptions Both() {
  MissionOptions options;
  options.gas_species.resize(kGases);
  options.gas_species[0].name = "methane";
  options.gas_species[1].name = kSecond;
  options.gas_species[1].prior_precision_per_ppm2 = 12.0;
  options.gas_species[1].background_mean_ppm = 0.5;
  return options;
}

// Of a mission of that gas only.
MissionOptions Alone(std::size_t species) {
  MissionOptions options = Both();
  options.gas = GasOptionsOf(options, species);
  options.gas_species.clear();
  return options;
}

std::int64_t TimeOf(int step) { return kSecond_ns + step * kSecond_ns / 10; }
Pose2 PlaceAt(int step) {
  const double angle_rad = 0.02 * step;
  return {3.5 + 1.5 * std::cos(angle_rad), 2.5 + 1.2 * std::sin(angle_rad), angle_rad};
}
double Truth_ppm(std::size_t species, const Pose2& place) {
  return species == 0 ? 10.0 * place.x_m : 1.0 + 0.5 * place.y_m;
}

// What happens to a mission in a room of 7 m x 5 m, of both gases or of one of them. Of that, what
// sensors of the other read becomes a word on the battery, so that everything else is the same.
class Story {
 public:
  explicit Story(int only = -1) : only_(only) {}

  void Register(const RobotId& robot, const std::vector<GasSensor>& sensors) {
    RobotRegistered registered{robot, 0.2, 1};
    for (GasSensor sensor : sensors) {
      if (!IsTold(sensor.species == kSecond ? 1 : 0)) continue;
      if (only_ >= 0) sensor.species.clear();
      registered.sensors.push_back(sensor);
    }
    Add(registered);
  }
  void See(const RobotId& robot, int step) {
    const Pose2 place = PlaceAt(step);
    constexpr double kWall_m = 0.05;  // walls stand in the middle of cells, not between two
    Send(robot, step,
         support::ScanInBox({place.x_m - kWall_m, place.y_m - kWall_m, place.yaw_rad}, 7.1, 5.1));
  }
  void Read(const RobotId& robot, int step, int species, double offset_ppm = 0.0) {
    GasReading reading{Truth_ppm(static_cast<std::size_t>(species), PlaceAt(step)) + offset_ppm};
    reading.sensor = only_ >= 0 ? 0 : species;
    if (IsTold(species)) return Send(robot, step, reading);
    Send(robot, step, RobotStatus{0.5});
  }
  void Send(const RobotId& robot, int step, ObservationPayload payload) {
    Add(ObservationReceived{robot,
                            {++sequence_[robot], TimeOf(step), PlaceAt(step), std::move(payload)}});
  }
  void Add(EventBody body) { events_.push_back(std::move(body)); }
  // A robot "a" with a sensor for each gas drives, and reads both at every third step.
  void Drive(int from, int to) {
    for (int step = from; step < to; ++step) {
      See("a", step);
      if (step % 3 == 0) {
        for (int species = 0; species < 2; ++species) Read("a", step, species);
      }
      if (step % 5 == 4) Add(PosteriorRefreshed{TimeOf(step)});
    }
  }
  const std::vector<EventBody>& events() const { return events_; }

 private:
  bool IsTold(int species) const { return only_ < 0 || only_ == species; }

  const int only_;  // of this gas; -1: of both
  std::map<RobotId, std::int64_t> sequence_;
  std::vector<EventBody> events_;
};

const std::vector<GasSensor> kOneOfEach = {{"ch4", {0.1, 0.0}, 0.3, 0.0},
                                           {"h2s", {0.1, 0.0}, 0.1, 0.0, kSecond}};

void ApplyAll(const std::vector<EventBody>& events, std::size_t from, Mission& mission) {
  for (std::size_t i = from; i < events.size(); ++i) {
    const auto applied = mission.Apply(events[i]);
    ASSERT_TRUE(applied.ok()) << applied.status() << " of event " << i;
    ASSERT_TRUE(applied->observation.ok()) << applied->observation << " of event " << i;
    ASSERT_TRUE(applied->posterior.ok()) << applied->posterior << " of event " << i;
  }
}

std::unique_ptr<Mission> Play(const MissionOptions& options, const Story& story) {
  auto mission = Mission::Create(options).value();
  ApplyAll(story.events(), 0, *mission);
  return mission;
}

std::string BytesOf(const SampledCells& cells) {
  ByteWriter writer;
  writer(cells);
  return writer.sink().bytes;
}

// `tell` fills a story.
template <typename Tell>
void ExpectEachAsAlone(const Tell& tell) {
  Story of_both;
  tell(of_both);
  const auto together = Play(Both(), of_both);
  const auto belief = together->Snapshot();
  ASSERT_EQ(belief->further_gases.size(), kGases - 1);
  for (std::size_t species = 0; species < kGases; ++species) {
    SCOPED_TRACE(species);
    Story of_one(static_cast<int>(species));
    tell(of_one);
    const auto alone = Play(Alone(species), of_one)->Snapshot();
    const GasField gas = belief->Gas(species);
    EXPECT_TRUE(support::SameBytes(*belief->occupancy, *alone->occupancy));
    EXPECT_TRUE(support::SameBytes(*gas.mean_ppm, *alone->gas_mean_ppm));
    EXPECT_TRUE(support::SameBytes(*gas.variance_ppm2, *alone->gas_variance_ppm2));
    EXPECT_EQ(gas.counters, alone->gas_counters);
    EXPECT_EQ(gas.quality, alone->gas_quality);
    EXPECT_TRUE(BytesOf(*gas.sampled_cells) == BytesOf(*alone->sampled_cells));
    EXPECT_GT(gas.counters.in_posterior, 0);
  }
}

TEST(MissionSpeciesTest, EachGasIsWhatItWouldBeAlone) {
  ExpectEachAsAlone([](Story& story) {
    story.Register("a", kOneOfEach);
    story.Drive(0, 30);
    story.Add(EpochBegun{TimeOf(30)});
    story.Drive(30, 45);
    story.Add(EpochAdopted{});
    story.Drive(45, 60);
  });
}

TEST(MissionSpeciesTest, EachGasIsWhatItWouldBeAloneWhenReadingsAgeToo) {
  MissionOptions both = Both();
  both.gas.ageing_half_life_s = 5.0;
  const auto tell = [](Story& story) {
    story.Register("a", kOneOfEach);
    story.Drive(0, 60);
    story.Add(EpochBegun{TimeOf(60)});
    story.Add(EpochAdopted{});
    story.Add(PosteriorRefreshed{TimeOf(90)});
  };
  Story of_both;
  tell(of_both);
  const auto belief = Play(both, of_both)->Snapshot();
  for (std::size_t species = 0; species < kGases; ++species) {
    Story of_one(static_cast<int>(species));
    tell(of_one);
    MissionOptions options = Alone(species);
    options.gas.ageing_half_life_s = 5.0;
    const auto alone = Play(options, of_one)->Snapshot();
    EXPECT_TRUE(support::SameBytes(*belief->Gas(species).mean_ppm, *alone->gas_mean_ppm));
    EXPECT_EQ(belief->Gas(species).quality, alone->gas_quality);
  }
}

// The second robot's sensor of methane is off, and it meets sensors of both gases.
void TellOfOffsets(Story& story) {
  story.Register("a", kOneOfEach);
  story.Register("b", {{"ch4", {}, 0.3, 2.0}});
  story.Drive(0, 90);
  for (int step = 0; step < 90; step += 3) story.Read("b", step, 0, 1.5);
  story.Add(PosteriorRefreshed{TimeOf(90)});
}

TEST(MissionSpeciesTest, OffsetsAreEstimatedAmongSensorsOfOneGas) {
  ExpectEachAsAlone(TellOfOffsets);
  Story of_both;
  TellOfOffsets(of_both);
  Story of_first(0);
  TellOfOffsets(of_first);
  std::vector<SensorOffset> offsets = Play(Both(), of_both)->Snapshot()->sensor_offsets;
  const auto alone = Play(Alone(0), of_first)->Snapshot()->sensor_offsets;
  ASSERT_EQ(offsets.size(), 1u);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(offsets[0].species, "methane");
  EXPECT_TRUE(offsets[0].estimated);
  offsets[0].species.clear();
  EXPECT_EQ(offsets[0], alone[0]) << "sensors of the other gas are no crossings";
}

TEST(MissionSpeciesTest, CorrectionsMoveTheReadingsOfAllGases) {
  const auto tell = [](Story& story) {
    story.Register("a", kOneOfEach);
    story.Drive(0, 60);
    PoseCorrection correction;
    for (const int step : {6, 57}) {
      Pose2 moved = PlaceAt(step);
      moved.x_m += 0.3;
      correction.anchors.push_back({TimeOf(step), moved});
    }
    story.Send("a", 60, correction);
    story.Add(PosteriorRefreshed{TimeOf(60)});
    story.Add(MapRebuildBegun{});
    story.Add(MapRebuilt{});
    story.Add(PosteriorRefreshed{TimeOf(61)});
  };
  ExpectEachAsAlone(tell);
  Story before;
  before.Register("a", kOneOfEach);
  before.Drive(0, 60);
  Story after;
  tell(after);
  const auto was = Play(Both(), before)->Snapshot();
  const auto is = Play(Both(), after)->Snapshot();
  for (std::size_t species = 0; species < kGases; ++species) {
    EXPECT_EQ(is->Gas(species).counters.readings, 20);
    EXPECT_FALSE(support::SameBytes(*is->Gas(species).mean_ppm, *was->Gas(species).mean_ppm));
  }
}

TEST(MissionSpeciesTest, ASavedMissionGoesOnAsTheOneThatWasSaved) {
  Story story;
  story.Register("a", kOneOfEach);
  story.Drive(0, 30);
  story.Add(EpochBegun{TimeOf(30)});
  story.Drive(30, 40);
  PoseCorrection correction;
  correction.anchors.push_back({TimeOf(20), PlaceAt(20)});
  story.Send("a", 40, correction);
  story.Add(PosteriorRefreshed{TimeOf(40)});
  story.Add(EpochBegun{TimeOf(41)});
  story.Add(EpochAdopted{});
  const std::size_t saved_at = story.events().size();
  const auto live = Play(Both(), story);
  ASSERT_TRUE(live->can_be_saved());
  const auto restored = Mission::Restore(Both(), live->SaveState().value());
  ASSERT_TRUE(restored.ok()) << restored.status();
  EXPECT_EQ((*restored)->Digest(), live->Digest());
  EXPECT_EQ((*restored)->SaveState().value(), live->SaveState().value());
  story.Drive(42, 60);
  ApplyAll(story.events(), saved_at, *live);
  ApplyAll(story.events(), saved_at, **restored);
  EXPECT_EQ((*restored)->Digest(), live->Digest());
  EXPECT_EQ(Play(Both(), story)->Digest(), live->Digest()) << "a replay";
  EXPECT_TRUE(support::SameBytes(*(*restored)->Snapshot()->Gas(1).mean_ppm,
                                 *live->Snapshot()->Gas(1).mean_ppm));
}

TEST(MissionSpeciesTest, TheSecondGasShowsInTheDigest) {
  const auto digest_of = [](double offset_ppm) {
    Story story;
    story.Register("a", kOneOfEach);
    for (int step = 0; step < 5; ++step) story.See("a", step);
    story.Read("a", 5, 1, offset_ppm);
    story.Add(PosteriorRefreshed{TimeOf(6)});
    return Play(Both(), story)->Digest();
  };
  EXPECT_EQ(digest_of(0.0), digest_of(0.0));
  EXPECT_NE(digest_of(0.0), digest_of(1e-9));
}

TEST(MissionSpeciesTest, WithOneGasItIsTheMissionThatNamesNone) {
  MissionOptions named = Alone(0);
  named.gas_species.resize(1);
  named.gas_species[0].name = "methane";
  Story story;
  story.Register("a", {{"pid", {}, 0.3, 0.0}});
  for (int step = 0; step < 5; ++step) story.See("a", step);
  story.Read("a", 5, 0);
  story.Add(PosteriorRefreshed{TimeOf(6)});
  story.Add(EpochBegun{TimeOf(6)});
  story.Add(EpochAdopted{});
  const auto with = Play(named, story);
  const auto without = Play(Alone(0), story);
  EXPECT_EQ(with->Digest(), without->Digest());
  EXPECT_EQ(with->SaveState().value(), without->SaveState().value());
  EXPECT_EQ(with->memory_bytes(), without->memory_bytes());
}

// Plans go by the first: what only the second was read at is not sampled.
TEST(MissionSpeciesTest, OnlyReadingsOfTheFirstGasCountForPlans) {
  Story story;
  story.Register("a", kOneOfEach);
  for (int step = 0; step < 5; ++step) story.See("a", step);
  story.Read("a", 5, 1);
  story.Add(PosteriorRefreshed{TimeOf(6)});
  const auto mission = Play(Both(), story);
  const auto count = [&] {
    const auto belief = mission->Snapshot();
    int sampled = 0;
    for (const std::uint8_t cell : belief->sampled->values()) sampled += cell;
    EXPECT_EQ(belief->Gas(1).counters.readings, 1);
    return sampled;
  };
  EXPECT_EQ(count(), 0);
  EXPECT_EQ(mission->Snapshot()->gas_counters.readings, 0);
  const std::size_t applied = story.events().size();
  story.Read("a", 6, 0);
  ApplyAll(story.events(), applied, *mission);
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(mission->Snapshot()->gas_counters.readings, 1);
}

TEST(MissionSpeciesTest, AReadingOfAnyGasMakesARefreshDue) {
  Story story;
  story.Register("a", kOneOfEach);
  for (int step = 0; step < 5; ++step) story.See("a", step);
  story.Add(PosteriorRefreshed{TimeOf(4)});
  const auto mission = Play(Both(), story);
  EXPECT_FALSE(mission->posterior_stale());
  const std::size_t applied = story.events().size();
  story.Read("a", 8, 1);
  ApplyAll(story.events(), applied, *mission);
  EXPECT_TRUE(mission->posterior_stale());
  EXPECT_TRUE(mission->refresh_due());
  EXPECT_TRUE(mission->epoch_possible());
  EXPECT_EQ(mission->epoch(), nullptr);
}

TEST(MissionSpeciesTest, MemoryCountsTheFieldsOfAllGases) {
  Story of_both;
  Story of_first(0);
  for (Story* story : {&of_both, &of_first}) {
    story->Register("a", kOneOfEach);
    for (int step = 0; step < 5; ++step) story->See("a", step);
    story->Add(PosteriorRefreshed{TimeOf(4)});
  }
  const auto together = Play(Both(), of_both);
  const auto alone = Play(Alone(0), of_first);
  const auto cells = static_cast<std::int64_t>(alone->Snapshot()->geometry().size());
  // Nothing was read: a field more, and rasters of it. 2 KB a free cell, of which the room has 7 m
  // x 5 m at 1 dm.
  const std::int64_t more_bytes = together->memory_bytes() - alone->memory_bytes();
  EXPECT_GT(more_bytes, kFurtherGasCellBytes * cells + 2000 * 3000);
  EXPECT_LT(more_bytes, alone->memory_bytes());
}

TEST(MissionSpeciesTest, AuditsAreOfOneGas) {
  Story story;
  story.Register("a", kOneOfEach);
  story.Drive(0, 30);
  const auto mission = Play(Both(), story);
  ASSERT_EQ(mission->species_count(), kGases);
  for (std::size_t species = 0; species < kGases; ++species) {
    const auto moment = mission->MakeAudit(species);
    ASSERT_NE(moment, nullptr);
    const auto finding = RunAudit(*moment);
    ASSERT_TRUE(finding.ok()) << finding.status();
    EXPECT_TRUE(finding->certified);
    EXPECT_EQ(finding->species, species);
  }
  mission->NoteAudits({.audits = 3, .alarms = 1}, 1);
  EXPECT_EQ(mission->Snapshot()->Gas(0).audits.audits, 0);
  EXPECT_EQ(mission->Snapshot()->Gas(1).audits.audits, 3);
}

TEST(MissionSpeciesTest, SensorsOfOtherGasesAreRefused) {
  const auto mission = Mission::Create(Both()).value();
  RobotRegistered robot{"a", 0.2, 1};
  robot.sensors = {{"pid", {}, 0.0, 0.0}, {"ox", {}, 0.0, 0.0, "ozone"}};
  const absl::Status refused = mission->Apply(robot).status();
  EXPECT_TRUE(absl::IsInvalidArgument(refused));
  EXPECT_THAT(std::string(refused.message()),
              HasSubstr("gas_sensors[1].species = \"ozone\" must be empty or one of \"methane\", "
                        "\"hydrogen-sulfide\""));
  EXPECT_EQ(mission->revision(), 0);
  EXPECT_TRUE(mission->RobotIds().empty());
  robot.sensors[1].species = "methane";
  EXPECT_TRUE(mission->Apply(robot).ok());
}

}  // namespace mission_species_test
}  // namespace plumescout
