// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What a snapshot of a mission takes: bytes, CPU time of the writer to make it and its digest, and
// of whoever restores it, beside that of replaying the events. Four robots drive straight ways
// through a building, scan once and read twice a second.

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "formats/zlib_codec.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kRobots = 4;
constexpr int kRepeats = 15;

struct Case {
  std::string name;
  int width_cells = 0;
  int height_cells = 0;
  int seconds = 0;
  double half_life_s = 0.0;
};

// Keeps the events, and the state of the mission after each adoption.
class Recorder final : public ConductObserver {
 public:
  void Watch(const Mission& mission) { mission_ = &mission; }
  void OnEvent(const Event& event, const Applied&) override {
    events.push_back(event.body);
    if (!std::holds_alternative<EpochAdopted>(event.body)) return;
    state = mission_->SaveState().value_or("");
    digest = mission_->Digest();
    save_ms = MedianCpu_ms(kRepeats, [&] { mission_->SaveState().IgnoreError(); });
    digest_ms = MedianCpu_ms(kRepeats, [&] { mission_->Digest(); });
  }

  std::vector<EventBody> events;
  std::string state;
  std::uint64_t digest = 0;
  double save_ms = 0.0;
  double digest_ms = 0.0;

 private:
  const Mission* mission_ = nullptr;
};

absl::Status RunMission(const Case& c, std::uint64_t seed, MissionConduct& conduct) {
  constexpr double kStep_m = 0.5;   // 1 m/s
  constexpr double kClear_m = 0.3;  // ahead of a step, to walls
  const Grid<std::uint8_t> walls = MakeBuilding(c.width_cells, c.height_cells, seed);
  std::vector<Pose2> poses = FreePoses(walls, kRobots, seed);
  std::vector<std::int64_t> sequences(kRobots, 0);
  Rng rng(seed);
  const auto robot = [](std::size_t i) { return std::string(1, static_cast<char>('a' + i)); };
  for (std::size_t i = 0; i < kRobots; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(conduct.Register(RobotRegistered{robot(i), 0.2, 1, 1}).status());
  }
  for (int half = 0; half < 2 * c.seconds; ++half) {
    // So that one is adopted at the end.
    if (half == 2 * c.seconds - 4) conduct.BeginEpoch().IgnoreError();
    for (std::size_t i = 0; i < kRobots; ++i) {
      DriveOn(walls, kStep_m, kClear_m, rng, poses[i]);
      const std::int64_t now_ns = (half + 1) * kSecond_ns / 2;
      std::vector<IncomingObservation> batch(1);
      batch[0].observation = {++sequences[i], now_ns, poses[i],
                              GasReading{rng.Uniform(0.0, 20.0), 0.0}};
      if (half % 2 == 0) {
        batch.emplace_back().observation = {++sequences[i], now_ns, poses[i],
                                            ScanBuilding(walls, poses[i])};
      }
      const IngestResult result = conduct.Ingest(robot(i), 1, std::move(batch));
      PLUMESCOUT_RETURN_IF_ERROR(result.status);
    }
  }
  return absl::OkStatus();
}

absl::Status Measure(const Case& c, BenchSummary& summary) {
  MissionOptions options;
  options.gas.ageing_half_life_s = c.half_life_s;
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  Recorder recorder;
  recorder.Watch(*mission);
  MissionConduct conduct(std::move(mission), &recorder);
  PLUMESCOUT_RETURN_IF_ERROR(RunMission(c, summary.seed(), conduct));
  if (recorder.state.empty()) return absl::InternalError("no epoch was adopted");
  summary.Set(c.name + "_events", static_cast<double>(recorder.events.size()));
  summary.Set(c.name + "_state_bytes", static_cast<double>(recorder.state.size()));
  std::string packed;
  summary.Set(c.name + "_pack_ms",
              MedianCpu_ms(kRepeats, [&] { packed = CompressZlib(recorder.state, 1); }));
  summary.Set(c.name + "_packed_bytes", static_cast<double>(packed.size()));
  summary.Set(c.name + "_save_ms", recorder.save_ms);
  summary.Set(c.name + "_digest_ms", recorder.digest_ms);
  bool same = true;
  summary.Set(c.name + "_restore_ms", MedianCpu_ms(3, [&] {
                const auto restored = Mission::Restore(options, recorder.state);
                same = same && restored.ok() && (*restored)->Digest() == recorder.digest;
              }));
  if (!same) return absl::InternalError("the restored mission is another");
  const double begin_ms = ThreadCpu_ms();
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto replay, Mission::Create(options));
  for (const EventBody& event : recorder.events) {
    PLUMESCOUT_RETURN_IF_ERROR(replay->Apply(event).status());
  }
  summary.Set(c.name + "_replay_ms", ThreadCpu_ms() - begin_ms);
  if (replay->Digest() != conduct.mission().Digest()) {
    return absl::InternalError("the replayed mission is another");
  }
  return absl::OkStatus();
}

absl::Status Run(int seconds, const std::string& only, BenchSummary& summary) {
  for (const Case& c :
       {Case{"16x20m", 160, 200, seconds, 0.0}, Case{"16x20m_ageing", 160, 200, seconds, 300.0},
        Case{"96x120m", 960, 1200, seconds, 0.0}}) {
    if (only.empty() || only == c.name) PLUMESCOUT_RETURN_IF_ERROR(Measure(c, summary));
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  int seconds = 1200;
  std::string only;
  return plumescout::lab::BenchProgram(
             "What snapshots of missions take, and what restoring them saves")
      .AddCount("--seconds", seconds, "Of sample time")
      .AddText("--only", only, "One case: 16x20m, 16x20m_ageing or 96x120m")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::Run(seconds, only, summary);
      });
}
