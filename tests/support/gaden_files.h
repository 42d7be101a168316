// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "absl/strings/str_cat.h"
#include "lab/formats/gaden_environment.h"
#include "lab/formats/gaden_frame.h"

namespace plumescout::support {

using lab::GadenCell;
using lab::GadenEnvironment;
using lab::GadenFilament;
using lab::GadenFrame;

// Files as GADEN lays them out, byte by byte.
template <typename T>
void Append(std::string& bytes, std::type_identity_t<T> value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <typename T>
void AppendPoint(std::string& bytes, const std::array<double, 3>& point) {
  for (const double coordinate : point) Append<T>(bytes, static_cast<T>(coordinate));
}

inline void AppendText(std::string& bytes, const std::string& text) {
  Append<std::uint64_t>(bytes, text.size());
  bytes += text;
}

// A room of 6 x 5 x 4 cells of 0.5 m from (-1, 2, 0): free within one layer of obstacles, with an
// outlet in the eastern wall at the height of layer 1.
inline GadenEnvironment GadenRoom() {
  GadenEnvironment room;
  room.cells = {6, 5, 4};
  room.min = {-1.0, 2.0, 0.0};
  room.cell_size_m = 0.5;
  room.states.assign(room.size(), GadenCell::kObstacle);
  for (int z = 1; z < 3; ++z) {
    for (int y = 1; y < 4; ++y) {
      for (int x = 1; x < 5; ++x) room.states[room.Index(x, y, z)] = GadenCell::kFree;
    }
  }
  room.states[room.Index(5, 2, 1)] = GadenCell::kOutlet;
  return room;
}

inline std::string EnvironmentText(const GadenEnvironment& environment) {
  std::array<double, 3> max{};
  for (std::size_t i = 0; i < max.size(); ++i) {
    max[i] = environment.min[i] + environment.cells[i] * environment.cell_size_m;
  }
  const auto triple = [](const auto& values) {
    return absl::StrCat(values[0], " ", values[1], " ", values[2], "\n");
  };
  std::string text = absl::StrCat("#env_min(m) ", triple(environment.min), "#env_max(m) ",
                                  triple(max), "#num_cells ", triple(environment.cells),
                                  "#cell_size(m) ", environment.cell_size_m, "\n");
  for (int z = 0; z < environment.cells[2]; ++z) {
    for (int x = 0; x < environment.cells[0]; ++x) {
      for (int y = 0; y < environment.cells[1]; ++y) {
        absl::StrAppend(&text, static_cast<int>(environment.states[environment.Index(x, y, z)]),
                        " ");
      }
      text += "\n";
    }
    text += ";\n";
  }
  return text;
}

inline void AppendBox(std::string& bytes, const GadenFrame& frame) {
  for (const int cells : frame.cells) Append<std::int32_t>(bytes, cells);
  AppendPoint<float>(bytes, {-1.0, 2.0, 0.0});
  AppendPoint<float>(bytes, {2.0, 4.5, 2.0});
  Append<float>(bytes, 0.5F);
}

constexpr std::int32_t kAcetone = 6;

// What comes before the filaments or concentrations, from a point source.
inline std::string FrameHead3(const GadenFrame& frame, const std::string& mode) {
  std::string bytes;
  Append<std::int32_t>(bytes, 3);
  Append<std::int32_t>(bytes, 0);
  AppendBox(bytes, frame);
  AppendText(bytes, "point");
  AppendPoint<float>(bytes, frame.source_m);
  Append<std::int32_t>(bytes, kAcetone);
  Append<float>(bytes, static_cast<float>(frame.moles_per_filament));
  Append<float>(bytes, static_cast<float>(frame.moles_per_cm3));
  Append<std::int32_t>(bytes, frame.wind_index);
  AppendText(bytes, mode);
  return bytes;
}

inline std::string FrameBytes3(const GadenFrame& frame) {
  if (!frame.concentrations_ppm.empty()) {
    std::string bytes = FrameHead3(frame, "concentrations");
    Append<std::uint64_t>(bytes, frame.concentrations_ppm.size());
    for (const float ppm : frame.concentrations_ppm) Append<float>(bytes, ppm);
    return bytes;
  }
  std::string bytes = FrameHead3(frame, "filaments");
  Append<std::uint64_t>(bytes, frame.filaments.size());
  for (const GadenFilament& filament : frame.filaments) {
    AppendPoint<float>(bytes, filament.position_m);
    Append<float>(bytes, static_cast<float>(filament.sigma_cm));
    bytes += std::string("\1\xAA\xAA\xAA", 4);  // active; what padding holds is chance
  }
  return bytes;
}

inline std::string FrameBytes2(const GadenFrame& frame, int minor = 4) {
  std::string bytes;
  Append<std::int32_t>(bytes, 2);
  Append<std::int32_t>(bytes, minor);
  AppendBox(bytes, frame);
  AppendPoint<float>(bytes, frame.source_m);
  Append<std::int32_t>(bytes, kAcetone);
  Append<double>(bytes, frame.moles_per_filament);
  Append<double>(bytes, frame.moles_per_cm3);
  Append<std::int32_t>(bytes, frame.wind_index);
  std::int32_t index = 17;
  for (const GadenFilament& filament : frame.filaments) {
    Append<std::int32_t>(bytes, index++);
    AppendPoint<double>(bytes, filament.position_m);
    Append<double>(bytes, filament.sigma_cm);
  }
  return bytes;
}

// The same wind in all cells.
inline std::string WindBytes3(const GadenEnvironment& environment, float u, float v) {
  std::string bytes;
  Append<std::int32_t>(bytes, 3);
  Append<std::int32_t>(bytes, 0);
  for (std::size_t i = 0; i < environment.size(); ++i) {
    Append<float>(bytes, u);
    Append<float>(bytes, v);
    Append<float>(bytes, 9.0F);
  }
  return bytes;
}

// Numbers that are exact in float, so that they survive version 3 as well.
inline GadenFrame SampleFrame() {
  GadenFrame frame;
  frame.cells = {6, 5, 4};
  frame.source_m = {0.25, 3.25, 0.75};
  frame.moles_per_filament = 0x1p-21;
  frame.moles_per_cm3 = 0x1p-14;
  frame.wind_index = 2;
  frame.filaments = {{{0.5, 3.0, 0.75}, 12.0}, {{1.0, 3.5, 1.25}, 20.5}};
  return frame;
}

}  // namespace plumescout::support
