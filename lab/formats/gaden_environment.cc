// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_environment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
constexpr double kMaxCells = 1e8;
constexpr double kMaxMeters = 1e6;

// Lines of a file with their number, for errors.
class LineReader {
 public:
  LineReader(std::string path, absl::string_view text) : path_(std::move(path)), rest_(text) {}

  absl::StatusOr<absl::string_view> Next() {
    if (rest_.empty()) {
      return absl::DataLossError(absl::StrCat(path_, ": ends after line ", number_));
    }
    ++number_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const absl::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return absl::StripSuffix(line, "\r");
  }

  absl::Status Error(absl::string_view what) const {
    return absl::InvalidArgumentError(absl::StrCat(path_, ":", number_, ": ", what));
  }

  absl::Status ExpectEnd() const {
    if (rest_.find_first_not_of(" \r\n") == absl::string_view::npos) return absl::OkStatus();
    return absl::DataLossError(
        absl::StrCat(path_, ": goes on after the last cell, line ", number_));
  }

 private:
  std::string path_;
  absl::string_view rest_;
  int number_ = 0;
};

// "#name(unit) a b c" with as many finite numbers as `values` holds.
template <std::size_t kCount>
absl::Status ReadHeader(LineReader& lines, absl::string_view name,
                        std::array<double, kCount>& values) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const absl::string_view line, lines.Next());
  const std::vector<absl::string_view> words = absl::StrSplit(line, ' ', absl::SkipEmpty());
  bool good = words.size() == kCount + 1 && absl::StartsWith(words[0], name);
  for (std::size_t i = 0; good && i < kCount; ++i) {
    good = absl::SimpleAtod(words[i + 1], &values[i]) && std::abs(values[i]) <= kMaxMeters;
  }
  if (good) return absl::OkStatus();
  return lines.Error(
      absl::StrCat("\"", line.substr(0, 60), "\" must be ", name, " and ", kCount, " numbers"));
}

absl::StatusOr<GadenEnvironment> ReadBox(LineReader& lines) {
  GadenEnvironment environment;
  std::array<double, 3> max{};
  std::array<double, 3> cells{};
  std::array<double, 1> cell_size{};
  PLUMESCOUT_RETURN_IF_ERROR(ReadHeader(lines, "#env_min", environment.min));
  PLUMESCOUT_RETURN_IF_ERROR(ReadHeader(lines, "#env_max", max));
  PLUMESCOUT_RETURN_IF_ERROR(ReadHeader(lines, "#num_cells", cells));
  double product = 1.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!(cells[i] >= 1.0 && cells[i] <= kMaxCells && cells[i] == std::floor(cells[i]))) {
      return lines.Error(absl::StrCat("num_cells ", cells[i], " must be a whole number >= 1"));
    }
    environment.cells[i] = static_cast<int>(cells[i]);
    product *= cells[i];
  }
  if (product > kMaxCells) return lines.Error(absl::StrCat(product, " cells, the limit is 1e8"));
  PLUMESCOUT_RETURN_IF_ERROR(ReadHeader(lines, "#cell_size", cell_size));
  environment.cell_size_m = cell_size[0];
  if (cell_size[0] > 0.0) return environment;
  return lines.Error(absl::StrCat("cell_size ", cell_size[0], " must be > 0"));
}

// States of the cells (x, *, z).
absl::Status ReadColumn(LineReader& lines, int x, int z, GadenEnvironment& environment) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const absl::string_view line, lines.Next());
  int y = 0;
  for (const char c : line) {
    if (c == ' ') continue;
    if (c < '0' || c > '2') {
      return lines.Error(absl::StrCat("cell \"", absl::string_view(&c, 1),
                                      "\" must be 0 (free), 1 (obstacle) or 2 (outlet)"));
    }
    if (y < environment.cells[1]) {
      environment.states[environment.Index(x, y, z)] = static_cast<GadenCell>(c - '0');
    }
    ++y;
  }
  if (y == environment.cells[1]) return absl::OkStatus();
  return lines.Error(absl::StrCat(y, " cells, num_cells says ", environment.cells[1]));
}

}  // namespace

bool GadenEnvironment::IsFree(double x_m, double y_m, double z_m) const {
  const std::array<double, 3> point = {x_m, y_m, z_m};
  std::array<int, 3> cell{};
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double at = (point[i] - min[i]) / cell_size_m;
    if (!(at >= 0.0 && at < cells[i])) return false;
    cell[i] = static_cast<int>(at);
  }
  return states[Index(cell[0], cell[1], cell[2])] == GadenCell::kFree;
}

absl::StatusOr<GadenEnvironment> ReadGadenEnvironment(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMaxBytes));
  LineReader lines(path, text);
  PLUMESCOUT_ASSIGN_OR_RETURN(GadenEnvironment environment, ReadBox(lines));
  environment.states.resize(environment.size(), GadenCell::kObstacle);
  for (int z = 0; z < environment.cells[2]; ++z) {
    for (int x = 0; x < environment.cells[0]; ++x) {
      PLUMESCOUT_RETURN_IF_ERROR(ReadColumn(lines, x, z, environment));
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(const absl::string_view line, lines.Next());
    if (line != ";") return lines.Error("a layer must end with a line \";\"");
  }
  PLUMESCOUT_RETURN_IF_ERROR(lines.ExpectEnd());
  return environment;
}

}  // namespace plumescout::lab
