// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::lab {

// A puff of gas: a three-dimensional Gaussian.
struct GadenFilament {
  std::array<double, 3> position_m{};
  double sigma_cm = 0.0;  // > 0

  friend bool operator==(const GadenFilament&, const GadenFilament&) = default;
};

// One saved instant of a GADEN simulation, which has one source: its gas as filaments or, if the
// simulation precomputed them, as concentrations.
struct GadenFrame {
  int version_major = 0;
  int version_minor = 0;
  std::array<int, 3> cells{};  // of the environment it belongs to
  std::array<double, 3> source_m{};
  double moles_per_filament = 0.0;
  double moles_per_cm3 = 0.0;  // of all gases: what makes moles of gas a concentration; > 0
  int wind_index = 0;          // number of the wind file of this instant, >= 0
  std::vector<GadenFilament> filaments;
  std::vector<float> concentrations_ppm;  // by cell, x fastest; empty if there are filaments

  // At the centre of the filament.
  double PeakPpm(const GadenFilament& filament) const;
};

// Reads a file iteration_N: one zlib stream of little-endian numbers without padding between
// fields (i32: int32; f32, f64: floats; u64: length; text: u64 and as many characters).
//
//   version 3         i32 major, i32 minor; i32[3] cells, f32[3] min, f32[3] max, f32 cell size;
//                     text source type, f32 size of the source (box, line: 3; cylinder: 2;
//                     sphere: 1; point: none), f32[3] position, i32 gas; f32 moles per filament,
//                     f32 moles per cm3; i32 wind index; text mode; u64 count, then by mode
//                     "filaments": f32[3] position, f32 sigma, u8 active, 3 bytes of padding each;
//                     "concentrations": f32 ppm each
//   version 2.0-2.5   i32 major, i32 minor; the same box; f32[3] position, i32 gas; f64 moles per
//                     filament, f64 moles per cm3; i32 wind index; to the end: i32 index,
//                     f64[3] position, f64 sigma
//
// Other versions are refused: version 2.6 does not tell where its source is, version 1 predates the
// header (GADEN itself asks to run such simulations again).
//
// Errors, naming the file: those of ReadFile; kDataLoss if it is no such stream or ends early or
// late; kInvalidArgument for another version, mode or source, or a number out of range.
absl::StatusOr<GadenFrame> ReadGadenFrame(const std::string& path);

// The same from the unpacked bytes.
absl::StatusOr<GadenFrame> ParseGadenFrame(absl::string_view bytes);

}  // namespace plumescout::lab
