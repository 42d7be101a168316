// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gas_sensor.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxTimeConstant_s = 3600.0;
constexpr double kMaxConcentration_ppm = 1e6;

}  // namespace

absl::Status Validate(const GasSensorOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("gas_sensor.time_constant_s", options.time_constant_s, 0.0, kMaxTimeConstant_s)
          .InRange("gas_sensor.noise_sigma_ppm", options.noise_sigma_ppm, 0.0,
                   kMaxConcentration_ppm)
          .InRange("gas_sensor.noise_share", options.noise_share, 0.0, 1.0)
          .InRange("gas_sensor.detection_limit_ppm", options.detection_limit_ppm, 0.0,
                   kMaxConcentration_ppm)
          .InRange("gas_sensor.saturation_ppm", options.saturation_ppm, 0.0, kMaxConcentration_ppm)
          .InRange("gas_sensor.resolution_ppm", options.resolution_ppm, 0.0, kMaxConcentration_ppm)
          .status());
  if (options.saturation_ppm > options.detection_limit_ppm) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("gas_sensor.saturation_ppm = ", options.saturation_ppm,
                   " must be > gas_sensor.detection_limit_ppm = ", options.detection_limit_ppm));
}

GasSensorOptions PhotoIonisationDetector() { return {}; }

GasSensorOptions CarbonDioxideCell() {
  return {.time_constant_s = 4.0,
          .noise_sigma_ppm = 10.0,
          .noise_share = 0.01,
          .detection_limit_ppm = 0.0,
          .saturation_ppm = 10'000.0,
          .resolution_ppm = 10.0};
}

GasSensor::GasSensor(const GasSensorOptions& options, std::uint64_t seed, double ambient_ppm)
    : options_(options), rng_(seed), cell_ppm_(ambient_ppm) {}

void GasSensor::Step(double true_ppm, double duration_s) {
  if (options_.time_constant_s == 0.0) {
    cell_ppm_ = true_ppm;
    return;
  }
  cell_ppm_ += (true_ppm - cell_ppm_) * -std::expm1(-duration_s / options_.time_constant_s);
}

double GasSensor::Read_ppm() {
  const double sigma_ppm = std::hypot(options_.noise_sigma_ppm, options_.noise_share * cell_ppm_);
  double reading_ppm = cell_ppm_ + sigma_ppm * rng_.Gaussian();
  if (reading_ppm < options_.detection_limit_ppm || reading_ppm < 0.0) return 0.0;
  if (options_.resolution_ppm > 0.0) {
    reading_ppm = options_.resolution_ppm * std::round(reading_ppm / options_.resolution_ppm);
  }
  return std::min(reading_ppm, options_.saturation_ppm);
}

}  // namespace plumescout::lab
