// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/sensor_bridge.h"

#include <cmath>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
// A clock set back by more than this many periods starts the schedule anew; less is jitter.
constexpr double kClockStepPeriods = 2.0;
// Asked so little early, a reading is due: a clock that rounds must not cost every other one.
constexpr std::int64_t kEarly_ns = 1'000'000;

}  // namespace

SampleSchedule::SampleSchedule(std::int64_t start_ns, double rate_hz)
    : start_ns_(start_ns), rate_hz_(rate_hz) {}

bool SampleSchedule::Due(std::int64_t now_ns) {
  if (!(rate_hz_ > 0.0)) return false;
  const std::int64_t early_ns = TimeOf_ns(next_count_) - now_ns;
  const double early_periods = static_cast<double>(early_ns) * rate_hz_ / kNanosecondsPerSecond;
  if (early_periods > kClockStepPeriods) {
    start_ns_ = now_ns;
  } else if (early_ns > kEarly_ns) {
    return false;
  }
  PlaceAfter(now_ns);
  return true;
}

std::optional<std::int64_t> SampleSchedule::next_ns() const {
  if (!(rate_hz_ > 0.0)) return std::nullopt;
  return TimeOf_ns(next_count_);
}

std::int64_t SampleSchedule::TimeOf_ns(std::int64_t count) const {
  const double offset_ns = static_cast<double>(count) * kNanosecondsPerSecond / rate_hz_;
  return start_ns_ + std::llround(offset_ns);
}

void SampleSchedule::PlaceAfter(std::int64_t now_ns) {
  const std::int64_t elapsed_ns = now_ns + kEarly_ns - start_ns_;
  const double periods = static_cast<double>(elapsed_ns) / kNanosecondsPerSecond * rate_hz_;
  next_count_ = static_cast<std::int64_t>(std::floor(periods)) + 1;
}

SensorBridge::SensorBridge(RobotDriver& driver, const SensorRates& rates,
                           const GasSampling& gas_sampling, Sink sink)
    : driver_(driver),
      sink_(std::move(sink)),
      scan_schedule_(driver.now_ns(), rates.scan_hz),
      gas_schedule_(driver.now_ns(), rates.gas_hz),
      gas_rate_hz_(rates.gas_hz),
      gas_sampling_(gas_sampling),
      lag_correction_(gas_sampling.settling_s > 0.0 ? 0.0 : gas_sampling.time_constant_s) {}

absl::Status SensorBridge::Poll(bool standing) {
  const std::int64_t now_ns = driver_.now_ns();
  PollCorrection();
  if (gas_sampling_.settling_s > 0.0) NoteStanding(standing, now_ns);
  lag_correction_.NotePose(now_ns, driver_.pose());
  if (scan_schedule_.Due(now_ns)) PLUMESCOUT_RETURN_IF_ERROR(PollScan());
  if (gas_schedule_.Due(now_ns)) PLUMESCOUT_RETURN_IF_ERROR(PollGas());
  return absl::OkStatus();
}

// What was remembered of the way before lies elsewhere now: lags are undone from anew.
void SensorBridge::PollCorrection() {
  std::optional<PoseCorrection> correction = driver_.TakeCorrection();
  if (!correction || correction->anchors.empty()) return;
  const double time_constant_s =
      gas_sampling_.settling_s > 0.0 ? 0.0 : gas_sampling_.time_constant_s;
  lag_correction_ = LagCorrection(time_constant_s);
  sink_(driver_.now_ns(), driver_.pose(), *std::move(correction));
}

absl::Status SensorBridge::PollScan() {
  absl::StatusOr<Scan> scan = driver_.TakeScan();
  if (!scan.ok()) return Missed(scan.status());
  latest_scan_ = *scan;
  latest_scan_pose_ = driver_.sample_pose();
  ++scans_taken_;
  sink_(driver_.sample_time_ns(), latest_scan_pose_, *std::move(scan));
  return absl::OkStatus();
}

absl::Status SensorBridge::PollGas() {
  const absl::StatusOr<GasReading> reading = driver_.ReadGas();
  if (!reading.ok()) return Missed(reading.status());
  const GasSample measured{driver_.sample_time_ns(), driver_.sample_pose(), *reading};
  if (gas_sampling_.settling_s > 0.0) {
    HandOnSettled(measured);
    return absl::OkStatus();
  }
  const GasSample air = lag_correction_.Correct(measured);
  sink_(air.time_ns, air.pose, air.reading);
  return absl::OkStatus();
}

// A stop begins with a reading.
void SensorBridge::NoteStanding(bool standing, std::int64_t now_ns) {
  if (standing == standing_since_ns_.has_value()) return;
  standing_since_ns_.reset();
  first_of_stop_.reset();
  if (!standing) return;
  standing_since_ns_ = now_ns;
  gas_schedule_ = SampleSchedule(now_ns, gas_rate_hz_);
}

void SensorBridge::HandOnSettled(const GasSample& measured) {
  if (!standing_since_ns_) return;
  if (!first_of_stop_) first_of_stop_ = measured;
  const std::int64_t stood_ns = measured.time_ns - *standing_since_ns_ + kEarly_ns;
  if (static_cast<double>(stood_ns) < gas_sampling_.settling_s * kNanosecondsPerSecond) return;
  GasReading air = measured.reading;
  const double elapsed_s =
      static_cast<double>(measured.time_ns - first_of_stop_->time_ns) / kNanosecondsPerSecond;
  if (gas_sampling_.time_constant_s > 0.0 && elapsed_s > 0.0) {
    air = UndoLag(first_of_stop_->reading, air, elapsed_s, gas_sampling_.time_constant_s);
  }
  sink_(measured.time_ns, measured.pose, air);
}

absl::Status SensorBridge::Missed(const absl::Status& status) {
  if (!absl::IsUnavailable(status)) return status;
  ++readings_missed_;
  return absl::OkStatus();
}

}  // namespace plumescout::client
