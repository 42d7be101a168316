// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// States of missions that were damaged, or made up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

#include "core/mission/mission.h"
#include "core/types/byte_archive.h"
#include "core/types/rng.h"
#include "tests/core/mission/random_mission.h"
#include "tests/support/rounds.h"

namespace plumescout {
namespace mission_state_damage_test {

// A mission with something of everything, at a revision at which it can be saved.
std::unique_ptr<Mission> RichMission(const MissionOptions& options) {
  auto mission = Mission::Create(options).value();
  RandomMission random(5, 3.0, 3.0);
  for (const char* robot : {"a", "b", "c"}) {
    EXPECT_TRUE(mission->Apply(RobotRegistered{robot, 0.2, 0, 7}).ok());
  }
  for (int i = 0; i < 200; ++i) {
    const EventBody body = random.Next(*mission);
    random.Learn(body, mission->Apply(body));
  }
  mission->Apply(EpochBegun{mission->sample_time_ns()}).IgnoreError();
  EXPECT_TRUE(mission->Apply(EpochAdopted{}).ok());
  EXPECT_TRUE(mission->can_be_saved());
  return mission;
}

MissionOptions Ageing() {
  MissionOptions options;
  options.gas.ageing_half_life_s = 20.0;
  return options;
}

// The bytes with a hash that fits them: what nobody but a forger writes.
std::string Forged(std::string bytes) {
  Hash64 hash;
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  hash.Add(absl::string_view(bytes).substr(0, size));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + size, &value, sizeof(value));
  return bytes;
}

void Flip(std::string& bytes, std::size_t byte, std::uint64_t bit) {
  bytes[byte] = static_cast<char>(static_cast<unsigned char>(bytes[byte]) ^ (1U << bit));
}

TEST(MissionStateDamage, AnyFlippedBitIsFound) {
  const std::string state = RichMission(Ageing())->SaveState().value();
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = state;
    Flip(damaged, rng.Below(state.size()), rng.Below(8));
    EXPECT_EQ(Mission::Restore(Ageing(), damaged).status().code(), absl::StatusCode::kDataLoss);
  }
}

TEST(MissionStateDamage, AnyTruncationIsFound) {
  const std::string state = RichMission(Ageing())->SaveState().value();
  Rng rng(2);
  for (std::size_t size = 0; size < 100; ++size) {
    EXPECT_EQ(Mission::Restore(Ageing(), state.substr(0, size)).status().code(),
              absl::StatusCode::kDataLoss);
    EXPECT_EQ(Mission::Restore(Ageing(), state.substr(0, rng.Below(state.size()))).status().code(),
              absl::StatusCode::kDataLoss);
  }
  EXPECT_EQ(Mission::Restore(Ageing(), state + "x").status().code(), absl::StatusCode::kDataLoss);
}

// What a mission becomes when its field is refreshed and made anew.
std::uint64_t DigestAfterAnEpoch(Mission& mission, std::int64_t time_ns) {
  mission.Snapshot();
  for (const EventBody& body : {EventBody(PosteriorRefreshed{time_ns}),
                                EventBody(EpochBegun{time_ns}), EventBody(EpochAdopted{})}) {
    mission.Apply(body).IgnoreError();
  }
  return mission.Digest();
}

// With a hash that fits, damage comes to the decoder. Whatever that takes, it is refused, or makes
// a mission that is not taken for the one that was saved, or makes no difference: evidence that the
// field was made from, and that it was told otherwise before it was saved. And nothing crashes, now
// or later. What is kept for corrections is hashed only once it was used, so here nothing is.
TEST(MissionStateDamage, WhatIsReadIsHashedToo) {
  for (MissionOptions options : {MissionOptions(), Ageing()}) {
    options.keep_scans = false;
    const auto mission = RichMission(options);
    const std::uint64_t digest = mission->Digest();
    const std::string state = mission->SaveState().value();
    const std::uint64_t later = DigestAfterAnEpoch(*mission, mission->sample_time_ns());
    Rng rng(3);
    int refused = 0;
    int other = 0;
    for (int i = 0; i < support::Rounds(600); ++i) {
      std::string forged = state;
      Flip(forged, sizeof(std::uint32_t) + rng.Below(state.size() - 12), rng.Below(8));
      const auto restored = Mission::Restore(options, Forged(forged));
      if (!restored.ok()) {
        EXPECT_EQ(restored.status().code(), absl::StatusCode::kDataLoss) << restored.status();
        ++refused;
        continue;
      }
      const bool is_same = (*restored)->Digest() == digest;
      other += is_same ? 0 : 1;
      const std::uint64_t then = DigestAfterAnEpoch(**restored, mission->sample_time_ns());
      if (is_same) {
        EXPECT_EQ(then, later) << "flip " << i;
      }
    }
    EXPECT_GT(refused, support::Rounds(50));
    EXPECT_GT(other, support::Rounds(300));
  }
}

TEST(MissionStateDamage, MadeUpBytesAreRefused) {
  const std::string state = RichMission(MissionOptions())->SaveState().value();
  Rng rng(4);
  for (int i = 0; i < 2000; ++i) {
    std::string forged = state.substr(0, 20 + rng.Below(2000));
    const std::size_t first = sizeof(std::uint32_t) + rng.Below(forged.size() - 12);
    for (std::size_t k = first; k + 8 < forged.size(); ++k) {
      forged[k] = static_cast<char>(rng.Below(256));
    }
    const auto restored = Mission::Restore(MissionOptions(), Forged(forged));
    EXPECT_EQ(restored.status().code(), absl::StatusCode::kDataLoss);
  }
}

TEST(MissionStateDamage, AnUnknownVersionIsNamed) {
  std::string state = RichMission(MissionOptions())->SaveState().value();
  state[0] = 77;
  const absl::Status status = Mission::Restore(MissionOptions(), Forged(state)).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr("version 77"));
}

TEST(MissionStateDamage, OtherOptionsAreNoticedIfTheMapCannotBeTheirs) {
  const std::string state = RichMission(MissionOptions())->SaveState().value();
  MissionOptions options;
  options.occupancy.resolution_m = 0.2;
  EXPECT_EQ(Mission::Restore(options, state).status().code(), absl::StatusCode::kDataLoss);
  options = {};
  options.occupancy.max_cell_count = 64;
  EXPECT_FALSE(Mission::Restore(options, state).ok());
  options = {};
  options.gas.lattice_factor = 99;
  EXPECT_EQ(Mission::Restore(options, state).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace mission_state_damage_test
}  // namespace plumescout
