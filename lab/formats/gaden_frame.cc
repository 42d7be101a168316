// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/little_endian.h"
#include "formats/zlib_codec.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;  // unpacked
constexpr std::size_t kFilamentBytes3 = 20;                  // four f32, a flag, padding
constexpr std::size_t kFilamentBytes2 = 36;                  // an i32, four f64
constexpr double kMaxMagnitude = 1e6;                        // of metres, centimetres and ppm

// Takes numbers from the front of some bytes. After a failure all further ones are 0.
class ByteReader {
 public:
  explicit ByteReader(absl::string_view bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t left() const { return rest_.size(); }

  absl::string_view Bytes(std::uint64_t count) {
    ok_ = ok_ && count <= rest_.size();
    if (!ok_) return {};
    const absl::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  template <typename T>
  T Number() {
    const absl::string_view bytes = Bytes(sizeof(T));
    return ok_ ? LoadLittleEndian<T>(bytes.data()) : T{};
  }
  template <typename T>
  std::array<double, 3> Point() {
    std::array<double, 3> point{};
    for (double& coordinate : point) coordinate = Number<T>();
    return point;
  }
  std::string Text() { return std::string(Bytes(Number<std::uint64_t>())); }

 private:
  absl::string_view rest_;
  bool ok_ = true;
};

absl::Status EndsEarly() { return absl::DataLossError("the frame ends early"); }

// Box of the environment; its corners and cell size are those of OccupancyGrid3D.csv.
void ReadBox(ByteReader& reader, GadenFrame& frame) {
  for (int& count : frame.cells) count = reader.Number<std::int32_t>();
  reader.Point<float>();
  reader.Point<float>();
  reader.Number<float>();
}

absl::Status CheckFilament(const GadenFilament& filament) {
  Checker checker;
  for (const double coordinate : filament.position_m) {
    checker.InRange("filament position", coordinate, -kMaxMagnitude, kMaxMagnitude);
  }
  return checker.InRangeAbove("filament sigma", filament.sigma_cm, 0.0, kMaxMagnitude).status();
}

absl::Status CheckHeader(const GadenFrame& frame) {
  Checker checker;
  for (const double coordinate : frame.source_m) {
    checker.InRange("source position", coordinate, -kMaxMagnitude, kMaxMagnitude);
  }
  return checker.NotNegative("moles per filament", frame.moles_per_filament)
      .Positive("moles per cm3", frame.moles_per_cm3)
      .AtLeast("wind index", frame.wind_index, 0)
      .status();
}

absl::Status SkipSourceSize(ByteReader& reader) {
  static const std::map<std::string, int> kNumbers = {
      {"point", 0}, {"sphere", 1}, {"cylinder", 2}, {"box", 3}, {"line", 3}};
  const std::string type = reader.Text();
  if (!reader.ok()) return EndsEarly();
  const auto numbers = kNumbers.find(type);
  if (numbers == kNumbers.end()) {
    return absl::InvalidArgumentError(
        absl::StrCat("source type \"", type.substr(0, 20), "\" is not known"));
  }
  for (int i = 0; i < numbers->second; ++i) reader.Number<float>();
  return absl::OkStatus();
}

absl::Status ReadFilaments3(ByteReader& reader, GadenFrame& frame) {
  const auto count = reader.Number<std::uint64_t>();
  if (!reader.ok() || count > reader.left() / kFilamentBytes3) return EndsEarly();
  for (std::uint64_t i = 0; i < count; ++i) {
    ByteReader record(reader.Bytes(kFilamentBytes3));
    GadenFilament filament;
    filament.position_m = record.Point<float>();
    filament.sigma_cm = record.Number<float>();
    const bool active = record.Number<std::uint8_t>() != 0;
    PLUMESCOUT_RETURN_IF_ERROR(CheckFilament(filament));
    if (active) frame.filaments.push_back(filament);
  }
  return absl::OkStatus();
}

absl::Status ReadConcentrations3(ByteReader& reader, GadenFrame& frame) {
  const auto count = reader.Number<std::uint64_t>();
  if (!reader.ok() || count > reader.left() / sizeof(float)) return EndsEarly();
  double expected = 1.0;
  for (const int cells : frame.cells) expected *= cells;
  if (static_cast<double>(count) != expected) {
    return absl::InvalidArgumentError(
        absl::StrCat(count, " concentrations for ", expected, " cells"));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const float ppm = reader.Number<float>();
    PLUMESCOUT_RETURN_IF_ERROR(Checker().NotNegative("concentration", ppm).status());
    frame.concentrations_ppm.push_back(ppm);
  }
  return absl::OkStatus();
}

absl::Status ReadVersion3(ByteReader& reader, GadenFrame& frame) {
  ReadBox(reader, frame);
  PLUMESCOUT_RETURN_IF_ERROR(SkipSourceSize(reader));
  frame.source_m = reader.Point<float>();
  reader.Number<std::int32_t>();  // the gas
  frame.moles_per_filament = reader.Number<float>();
  frame.moles_per_cm3 = reader.Number<float>();
  frame.wind_index = reader.Number<std::int32_t>();
  const std::string mode = reader.Text();
  if (!reader.ok()) return EndsEarly();
  PLUMESCOUT_RETURN_IF_ERROR(CheckHeader(frame));
  if (mode == "concentrations") return ReadConcentrations3(reader, frame);
  if (mode == "filaments") return ReadFilaments3(reader, frame);
  return absl::InvalidArgumentError(absl::StrCat("mode \"", mode.substr(0, 20),
                                                 "\" must be \"filaments\" or \"concentrations\""));
}

absl::Status ReadVersion2(ByteReader& reader, GadenFrame& frame) {
  ReadBox(reader, frame);
  frame.source_m = reader.Point<float>();
  reader.Number<std::int32_t>();  // the gas
  frame.moles_per_filament = reader.Number<double>();
  frame.moles_per_cm3 = reader.Number<double>();
  frame.wind_index = reader.Number<std::int32_t>();
  if (!reader.ok()) return EndsEarly();
  PLUMESCOUT_RETURN_IF_ERROR(CheckHeader(frame));
  while (reader.left() >= kFilamentBytes2) {
    reader.Number<std::int32_t>();
    GadenFilament filament;
    filament.position_m = reader.Point<double>();
    filament.sigma_cm = reader.Number<double>();
    PLUMESCOUT_RETURN_IF_ERROR(CheckFilament(filament));
    frame.filaments.push_back(filament);
  }
  return absl::OkStatus();
}

}  // namespace

double GadenFrame::PeakPpm(const GadenFilament& filament) const {
  const double volume_cm3 = std::pow(2.0 * M_PI, 1.5) * std::pow(filament.sigma_cm, 3);
  return 1e6 * moles_per_filament / volume_cm3 / moles_per_cm3;
}

absl::StatusOr<GadenFrame> ParseGadenFrame(absl::string_view bytes) {
  ByteReader reader(bytes);
  GadenFrame frame;
  frame.version_major = reader.Number<std::int32_t>();
  frame.version_minor = reader.Number<std::int32_t>();
  if (!reader.ok()) return EndsEarly();
  if (frame.version_major == 3) {
    PLUMESCOUT_RETURN_IF_ERROR(ReadVersion3(reader, frame));
  } else if (frame.version_major == 2 && frame.version_minor >= 0 && frame.version_minor <= 5) {
    PLUMESCOUT_RETURN_IF_ERROR(ReadVersion2(reader, frame));
  } else {
    // Version 1 had no minor number.
    const std::string version = frame.version_major == 1
                                    ? "1"
                                    : absl::StrCat(frame.version_major, ".", frame.version_minor);
    return absl::InvalidArgumentError(absl::StrCat(
        "written by GADEN ", version, "; versions 2.0 to 2.5 and 3 can be read, run it again"));
  }
  if (reader.left() == 0) return frame;
  return absl::DataLossError(absl::StrCat(reader.left(), " bytes follow the frame"));
}

absl::StatusOr<GadenFrame> ReadGadenFrame(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string packed, ReadFile(path, kMaxBytes));
  const absl::StatusOr<std::string> bytes = DecompressZlib(packed, kMaxBytes);
  absl::StatusOr<GadenFrame> frame =
      bytes.ok() ? ParseGadenFrame(*bytes) : absl::StatusOr<GadenFrame>(bytes.status());
  if (frame.ok()) return frame;
  return absl::Status(frame.status().code(), absl::StrCat(path, ": ", frame.status().message()));
}

}  // namespace plumescout::lab
