// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What keeping missions costs: events a second through SQLite or PostgreSQL, how long robots wait
// until one is durable, and reading, each beside a plain file that is synced as often.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/synchronization/blocking_counter.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/quantile.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/bench/bars.h"
#include "lab/bench/bench_summary.h"
#include "server/store/sqlite_store.h"

#ifdef PLUMESCOUT_POSTGRESQL
#include "server/store/postgres_store.h"
#endif

namespace plumescout::lab {
namespace {

using server::MissionStore;
using server::SqliteStore;
using StorePtr = std::unique_ptr<MissionStore>;

constexpr int kMissions = 100;
constexpr int kRecordsPerAppend = 4;
constexpr std::int64_t kMaxBacklogRecords = 4000;  // as credit bounds it for robots

struct StoreFlags {
  std::string folder = std::filesystem::temp_directory_path().string();
  std::string url;  // of a database in PostgreSQL; empty: SQLite
  int events = 60'000;
  double paced_s = 10.0;
  bool quick = false;
  bool strict = false;
};

// Sizes of records, in bytes.
using Sizes = std::vector<std::size_t>;

Sizes EqualSizes(int events, std::size_t bytes) {
  return Sizes(static_cast<std::size_t>(events), bytes);
}

// As a fleet has them: of 64 events 51 scans, delta-coded, 10 readings and reports, 2 refreshes,
// and a plan.
Sizes FleetSizes(int events, Rng& rng) {
  constexpr double kScans = 51.0 / 64.0;
  constexpr double kSmall = 63.0 / 64.0;
  Sizes sizes;
  for (int i = 0; i < events; ++i) {
    const double kind = rng.Uniform01();
    const double bytes = kind < kScans   ? rng.Uniform(380.0, 500.0)
                         : kind < kSmall ? rng.Uniform(30.0, 90.0)
                                         : rng.Uniform(800.0, 2500.0);
    sizes.push_back(static_cast<std::size_t>(bytes));
  }
  return sizes;
}

std::string RandomBytes(std::size_t size, Rng& rng) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(rng.Next() & 0xFFU);
  return bytes;
}

std::string MissionKeyOf(int mission) { return absl::StrCat("mission-", mission); }

// Times until what was appended is durable, and how much is not yet.
class Durability {
 public:
  MissionStore::Done Note(std::int64_t records) {
    absl::MutexLock lock(&mutex_);
    pending_ += records;
    return [this, records, begin = absl::Now()](const absl::Status& status) {
      absl::MutexLock told(&mutex_);
      pending_ -= records;
      waits_ms_.push_back(absl::ToDoubleMilliseconds(absl::Now() - begin));
      status_.Update(status);
    };
  }

  absl::Status AwaitAtMost(std::int64_t records) {
    absl::MutexLock lock(&mutex_);
    const auto has_room = [this, records]()
                              ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return pending_ <= records; };
    mutex_.Await(absl::Condition(&has_room));
    return status_;
  }

  std::vector<double> waits_ms() const {
    absl::MutexLock lock(&mutex_);
    return waits_ms_;
  }

 private:
  mutable absl::Mutex mutex_;
  std::int64_t pending_ ABSL_GUARDED_BY(mutex_) = 0;
  std::vector<double> waits_ms_ ABSL_GUARDED_BY(mutex_);
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
};

absl::StatusOr<StorePtr> OpenShared([[maybe_unused]] const std::string& url) {
#ifdef PLUMESCOUT_POSTGRESQL
  server::PostgresStoreOptions options;
  options.url = url;
  options.cluster = "store_bench";
  options.node = {"store_bench", "nowhere"};
  PLUMESCOUT_ASSIGN_OR_RETURN(StorePtr store, server::PostgresStore::Open(options));
  return store;
#else
  return absl::UnimplementedError("built without PostgreSQL");
#endif
}

// A fresh store below the folder, or missions in a database, that have no events; gone afterwards.
class BenchStore {
 public:
  static absl::StatusOr<std::unique_ptr<BenchStore>> Make(const StoreFlags& flags, int missions) {
    auto made = std::make_unique<BenchStore>();
    made->folder_ = absl::StrCat(flags.folder, "/plumescout-store-bench-", getpid());
    if (flags.url.empty()) {
      server::StoreOptions options;
      options.folder = made->folder_;
      PLUMESCOUT_ASSIGN_OR_RETURN(made->store_, SqliteStore::Open(options));
    } else {
      PLUMESCOUT_ASSIGN_OR_RETURN(made->store_, OpenShared(flags.url));
    }
    for (int i = 0; i < missions; ++i) {
      PLUMESCOUT_RETURN_IF_ERROR(made->store_->Create(MissionKeyOf(i), "header").status());
    }
    made->heads_.resize(static_cast<std::size_t>(missions));
    return made;
  }
  BenchStore() = default;
  ~BenchStore() {
    absl::BlockingCounter removed(static_cast<int>(heads_.size()));
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      store_->Remove(MissionKeyOf(static_cast<int>(i)), 1,
                     [&removed](const absl::Status&) { removed.DecrementCount(); });
    }
    removed.Wait();
    store_ = nullptr;
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  BenchStore(const BenchStore&) = delete;
  BenchStore& operator=(const BenchStore&) = delete;

  MissionStore& store() { return *store_; }
  void Append(int mission, std::vector<std::string> records, Durability& durability) {
    const auto count = static_cast<std::int64_t>(records.size());
    std::int64_t& head = heads_[static_cast<std::size_t>(mission)];
    store_->Append(MissionKeyOf(mission), 1, head + 1, std::move(records), durability.Note(count));
    head += count;
  }

 private:
  std::string folder_;
  StorePtr store_;
  std::vector<std::int64_t> heads_;
};

struct PlainFile {
  double events_per_s = 0.0;
  std::vector<double> syncs_ms;
};

// The same bytes in as many pieces, each synced.
absl::StatusOr<PlainFile> WritePlainFile(const std::string& below, const Sizes& sizes,
                                         std::int64_t commits) {
  const std::string path = absl::StrCat(below, "/plumescout-plain-", getpid());
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) return absl::UnavailableError(absl::StrCat(path, ": ", strerror(errno)));
  const std::size_t bytes = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  const std::string piece(bytes / static_cast<std::size_t>(std::max<std::int64_t>(commits, 1)),
                          'x');
  PlainFile plain;
  bool is_good = true;
  const absl::Time begin = absl::Now();
  for (std::int64_t i = 0; i < commits; ++i) {
    const absl::Time piece_begin = absl::Now();
    is_good = is_good &&
              write(descriptor, piece.data(), piece.size()) == static_cast<ssize_t>(piece.size());
    is_good = is_good && fdatasync(descriptor) == 0;
    plain.syncs_ms.push_back(absl::ToDoubleMilliseconds(absl::Now() - piece_begin));
  }
  plain.events_per_s =
      static_cast<double>(sizes.size()) / absl::ToDoubleSeconds(absl::Now() - begin);
  close(descriptor);
  unlink(path.c_str());
  if (!is_good) return absl::UnavailableError(absl::StrCat(path, ": ", strerror(errno)));
  return plain;
}

absl::StatusOr<double> ReadEventsPerSecond(BenchStore& bench) {
  std::int64_t records = 0;
  const absl::Time begin = absl::Now();
  for (int mission = 0; mission < kMissions; ++mission) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto reader, bench.store().Read(MissionKeyOf(mission), 1));
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const auto record, reader->Next());
      if (!record.has_value()) break;
      ++records;
    }
  }
  return static_cast<double>(records) / absl::ToDoubleSeconds(absl::Now() - begin);
}

// As fast as it goes, from all missions in turns.
absl::StatusOr<std::vector<Bar>> MeasureThroughput(const std::string& name, const StoreFlags& flags,
                                                   const Sizes& sizes, Rng& rng) {
  constexpr double kMostMs = 1000.0;  // 10,000 events a second
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bench, BenchStore::Make(flags, kMissions));
  const std::string bytes = RandomBytes(1 << 20, rng);
  Durability durability;
  const std::int64_t commits_before = bench->store().state().commits;
  const absl::Time begin = absl::Now();
  std::size_t next = 0;
  for (int turn = 0; next < sizes.size(); ++turn) {
    std::vector<std::string> records;
    for (int i = 0; i < kRecordsPerAppend && next < sizes.size(); ++i, ++next) {
      records.push_back(bytes.substr((next * 997) % (bytes.size() / 2), sizes[next]));
    }
    bench->Append(turn % kMissions, std::move(records), durability);
    PLUMESCOUT_RETURN_IF_ERROR(durability.AwaitAtMost(kMaxBacklogRecords));
  }
  PLUMESCOUT_RETURN_IF_ERROR(durability.AwaitAtMost(0));
  const double events_per_s =
      static_cast<double>(sizes.size()) / absl::ToDoubleSeconds(absl::Now() - begin);
  const std::int64_t commits = bench->store().state().commits - commits_before;
  PLUMESCOUT_ASSIGN_OR_RETURN(const double read_per_s, ReadEventsPerSecond(*bench));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlainFile plain, WritePlainFile(flags.folder, sizes, commits));
  return std::vector<Bar>{
      {name + "_events_per_s", events_per_s},
      {name + "_ms_per_10000_events", 1e7 / events_per_s, kMostMs},
      {name + "_events_per_commit",
       static_cast<double>(sizes.size()) / static_cast<double>(commits)},
      {name + "_plain_file_events_per_s", plain.events_per_s},
      {name + "_read_events_per_s", read_per_s},
  };
}

// Eight robots at 20 events a second each: how long until one is durable.
absl::StatusOr<std::vector<Bar>> MeasureWaits(const StoreFlags& flags, Rng& rng) {
  constexpr int kRobots = 8;
  constexpr double kRate_hz = 20.0;
  constexpr double kMostMs = 50.0;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bench, BenchStore::Make(flags, 1));
  const auto events = static_cast<int>(flags.paced_s * kRate_hz * kRobots);
  const Sizes sizes = FleetSizes(events, rng);
  Durability durability;
  std::vector<double> commits_ms;
  const absl::Duration between = absl::Seconds(1) / (kRate_hz * kRobots);
  absl::Time due = absl::Now();
  for (const std::size_t size : sizes) {
    bench->Append(0, {std::string(size, 'x')}, durability);
    commits_ms.push_back(absl::ToDoubleMilliseconds(bench->store().state().last_commit));
    due += between;
    absl::SleepFor(due - absl::Now());
  }
  PLUMESCOUT_RETURN_IF_ERROR(durability.AwaitAtMost(0));
  const std::vector<double> waits_ms = durability.waits_ms();
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlainFile plain, WritePlainFile(flags.folder, sizes, events));
  constexpr double kTail = 0.99;
  return std::vector<Bar>{
      {"durable_p50_ms", Median(waits_ms)},
      {"durable_p99_ms", Quantile(waits_ms, kTail), kMostMs},
      {"commit_p50_ms", Median(commits_ms)},
      {"commit_p99_ms", Quantile(commits_ms, kTail)},
      {"plain_file_sync_p50_ms", Median(plain.syncs_ms)},
      {"plain_file_sync_p99_ms", Quantile(plain.syncs_ms, kTail)},
  };
}

absl::Status Run(const StoreFlags& flags, BenchSummary& summary) {
  Rng rng(summary.seed());
  constexpr std::size_t kLargeBytes = 1536;
  std::vector<Bar> bars;
  const auto measure = [&](absl::StatusOr<std::vector<Bar>> measured) {
    if (measured.ok()) bars.insert(bars.end(), measured->begin(), measured->end());
    return measured.status();
  };
  PLUMESCOUT_RETURN_IF_ERROR(
      measure(MeasureThroughput("large", flags, EqualSizes(flags.events, kLargeBytes), rng)));
  PLUMESCOUT_RETURN_IF_ERROR(
      measure(MeasureThroughput("fleet", flags, FleetSizes(flags.events, rng), rng)));
  PLUMESCOUT_RETURN_IF_ERROR(measure(MeasureWaits(flags, rng)));
  for (const Bar& bar : bars) {
    summary.Set(bar.name, bar.value);
    if (bar.limit.has_value()) std::cout << "  " << ToString(bar) << std::endl;
  }
  if (flags.strict && !AllMet(bars)) return absl::FailedPreconditionError("a bar is missed");
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::StoreFlags flags;
  CLI::App app("What keeping missions costs, in SQLite or PostgreSQL, beside a plain file");
  app.add_option("--folder", flags.folder, "where the files are written, and removed again")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_option("--url", flags.url, "of a database of its own in PostgreSQL, instead of SQLite")
      ->type_name("postgresql://USER@HOST:PORT/DATABASE");
  app.add_option("--events", flags.events, "of each measurement")
      ->check(CLI::Range(100, 10'000'000))
      ->capture_default_str();
  app.add_flag("--quick", flags.quick, "a sixth of the events, a fifth of the time");
  app.add_flag("--strict", flags.strict, "fail if a bar is missed");
  return plumescout::lab::RunBench(app, argc, argv,
                                   [&flags](plumescout::lab::BenchSummary& summary) {
                                     if (flags.quick) {
                                       flags.events /= 6;
                                       flags.paced_s /= 5;
                                     }
                                     return plumescout::lab::Run(flags, summary);
                                   });
}
