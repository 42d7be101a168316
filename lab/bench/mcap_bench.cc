// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What it takes to record a mission as MCAP while it runs: CPU time of the mission's writer, which
// says what happened, and of the thread that writes the file; bytes beside those of the journal.
// Four robots drive straight ways through a building, scan and read twice a second.

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "formats/journal/journal_file_encoder.h"
#include "formats/view/mission_view.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bars.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kRobots = 4;
constexpr double kMostCores = 0.02;
constexpr double kMapPeriod_s = 10.0;

struct McapFlags {
  int seconds = 300;
  int scans_per_s = 10;
  int chunk_s = 10;
  int map_percent = static_cast<int>(std::lround(100.0 * MissionView::kMapShare));
};

// As plumescout-server records, on one thread.
class Recorder final : public ConductObserver {
 public:
  Recorder(int chunk_s, double map_share)
      : chunk_ns_(chunk_s * kSecond_ns), view_({.mission = "bench"}, map_share) {
    journal_bytes_ = std::ssize(journal_.Begin({.mission = "bench"}));
  }

  void Watch(const Mission& mission) { mission_ = &mission; }

  void OnEvent(const Event& event, const Applied& applied) override {
    double begin_ms = ThreadCpu_ms();
    MissionMoment moment = MomentAfter(event, applied, *mission_, timer_);
    note_ms_ += ThreadCpu_ms() - begin_ms;
    begin_ms = ThreadCpu_ms();
    moment.record = EncodeEvent(event, PlanDetail::kForReplay);
    const std::string record = moment.record;
    status_.Update(view_.Add(std::move(moment)));
    if (mission_->sample_time_ns() >= chunk_end_ns_) {
      status_.Update(view_.EndChunk());
      chunk_end_ns_ = mission_->sample_time_ns() + chunk_ns_;
    }
    mcap_bytes_ += std::ssize(view_.Take());
    write_ms_ += ThreadCpu_ms() - begin_ms;
    journal_bytes_ += std::ssize(journal_.Record(record));
  }

  absl::Status Finish() {
    status_.Update(view_.Finish(mission_->Snapshot()));
    mcap_bytes_ += std::ssize(view_.Take());
    return status_;
  }

  double note_ms() const { return note_ms_; }
  double write_ms() const { return write_ms_; }
  double mcap_bytes() const { return static_cast<double>(mcap_bytes_); }
  double journal_bytes() const { return static_cast<double>(journal_bytes_); }

 private:
  const std::int64_t chunk_ns_;
  const Mission* mission_ = nullptr;
  MapTimer timer_{kMapPeriod_s};
  MissionView view_;
  JournalFileEncoder journal_;
  absl::Status status_;
  std::int64_t chunk_end_ns_ = 0;
  double note_ms_ = 0.0;
  double write_ms_ = 0.0;
  std::int64_t mcap_bytes_ = 0;
  std::int64_t journal_bytes_ = 0;
};

absl::Status Drive(const McapFlags& flags, std::uint64_t seed, MissionConduct& conduct) {
  constexpr int kWidth_cells = 160;
  constexpr int kHeight_cells = 200;
  constexpr double kSpeed_m_s = 0.5;
  constexpr double kClear_m = 0.3;  // ahead of a step, to walls
  const Grid<std::uint8_t> walls = MakeBuilding(kWidth_cells, kHeight_cells, seed);
  std::vector<Pose2> poses = FreePoses(walls, kRobots, seed);
  std::vector<std::int64_t> sequences(kRobots, 0);
  Rng rng(seed);
  const auto robot = [](std::size_t i) { return std::string(1, static_cast<char>('a' + i)); };
  for (std::size_t i = 0; i < kRobots; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(conduct.Register(RobotRegistered{robot(i), 0.2, 1, 1}).status());
  }
  const int reading_every = std::max(1, flags.scans_per_s / 2);
  for (int step = 0; step < flags.seconds * flags.scans_per_s; ++step) {
    const std::int64_t now_ns = (step + 1) * kSecond_ns / flags.scans_per_s;
    for (std::size_t i = 0; i < kRobots; ++i) {
      DriveOn(walls, kSpeed_m_s / flags.scans_per_s, kClear_m, rng, poses[i]);
      std::vector<IncomingObservation> batch(1);
      batch[0].observation = {++sequences[i], now_ns, poses[i], ScanBuilding(walls, poses[i])};
      if (step % reading_every == 0) {
        batch.emplace_back().observation = {++sequences[i], now_ns, poses[i],
                                            GasReading{rng.Uniform(0.0, 20.0), 0.0}};
      }
      PLUMESCOUT_RETURN_IF_ERROR(conduct.Ingest(robot(i), 1, std::move(batch)).status);
    }
  }
  return absl::OkStatus();
}

absl::Status Run(const McapFlags& flags, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(MissionOptions()));
  Recorder recorder(flags.chunk_s, 0.01 * flags.map_percent);
  recorder.Watch(*mission);
  MissionConduct conduct(std::move(mission), &recorder);
  PLUMESCOUT_RETURN_IF_ERROR(Drive(flags, summary.seed(), conduct));
  PLUMESCOUT_RETURN_IF_ERROR(recorder.Finish());
  const double sample_ms = 1000.0 * flags.seconds;
  const double cores = (recorder.note_ms() + recorder.write_ms()) / sample_ms;
  const std::vector<Bar> bars = {
      {"recording, CPU of a core, percent", 100.0 * cores, 100.0 * kMostCores},
      {"recording, CPU seconds per hour", 3600.0 * cores, 3600.0 * kMostCores},
      {"of it the mission's writer, CPU seconds per hour", 3600.0 * recorder.note_ms() / sample_ms},
      {"journal, MB", recorder.journal_bytes() / 1e6},
      {"MCAP, MB", recorder.mcap_bytes() / 1e6},
      {"MCAP over journal", recorder.mcap_bytes() / recorder.journal_bytes(), 1.2},
  };
  for (const Bar& bar : bars) std::printf("%s\n", ToString(bar).c_str());
  summary.Set("cores", cores);
  summary.Set("journal_bytes", recorder.journal_bytes());
  summary.Set("mcap_bytes", recorder.mcap_bytes());
  return AllMet(bars) ? absl::OkStatus() : absl::FailedPreconditionError("a limit is missed");
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::McapFlags flags;
  return plumescout::lab::BenchProgram("What it takes to record missions as MCAP while they run")
      .AddCount("--seconds", flags.seconds, "Of sample time")
      .AddCount("--scans-per-s", flags.scans_per_s, "Of each robot")
      .AddCount("--chunk", flags.chunk_s, "Chunks end after so many seconds of sample time")
      .AddCount("--map-percent", flags.map_percent, "Of the journal's bytes that maps may take")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::Run(flags, summary);
      });
}
