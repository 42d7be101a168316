// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/coarse_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/gas/gas_map.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// Places are judged within this of a reading, and from this on away from all.
constexpr double kNear_m = 1.0;
constexpr double kFar_m = 2.5;

struct Read {
  Point2 place;
  double concentration_ppm = 0.0;
};

// Three plumes, from a narrow to a wide one.
double Truth_ppm(Point2 place) {
  struct Plume {
    Point2 middle;
    double spread_m;
    double most_ppm;
  };
  double sum_ppm = 0.0;
  for (const Plume& plume :
       {Plume{{12.0, 10.0}, 2.0, 30.0}, {{25.0, 22.0}, 4.0, 12.0}, {{20.0, 8.0}, 1.0, 20.0}}) {
    const double share = Distance_m(place, plume.middle) / plume.spread_m;
    sum_ppm += plume.most_ppm * std::exp(-0.5 * share * share);
  }
  return sum_ppm;
}

// Rows 4 m apart through two thirds of the ground, twice a second at 1.25 m/s, in gusts.
std::vector<Read> Drive(double side_m, std::uint64_t seed) {
  constexpr double kMargin_m = 2.0;
  constexpr double kRows_m = 4.0;
  constexpr double kApart_m = 0.625;
  constexpr double kRead = 2.0 / 3.0;
  constexpr double kGust = 0.3;
  constexpr double kNoise_ppm = 0.1;
  Rng rng(seed);
  std::vector<Read> reads;
  for (double y_m = kMargin_m; y_m < kRead * side_m; y_m += kRows_m) {
    for (double x_m = kMargin_m; x_m < side_m - kMargin_m; x_m += kApart_m) {
      const Point2 place{x_m, y_m};
      const double gusts = 1.0 + kGust * rng.Gaussian();
      const double noise_ppm = kNoise_ppm * rng.Gaussian();
      reads.push_back({place, std::max(0.0, gusts * Truth_ppm(place) + noise_ppm)});
    }
  }
  return reads;
}

absl::StatusOr<std::unique_ptr<GasMap>> MapOf(const GasOptions& options,
                                              const Grid<CellState>& states,
                                              const std::vector<Read>& reads) {
  auto map = std::make_unique<GasMap>(options);
  for (const Read& read : reads) map->Add(0, read.place, {read.concentration_ppm});
  PLUMESCOUT_RETURN_IF_ERROR(map->Refresh(states, 0));
  return map;
}

Grid<double> Distances(const Grid<CellState>& states, const std::vector<Read>& reads) {
  Grid<double> nearest_m(states.geometry(), states.width() * states.geometry().resolution_m);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Point2 place = states.geometry().Center(states.geometry().CellAtIndex(i));
    for (const Read& read : reads) {
      nearest_m[i] = std::min(nearest_m[i], Distance_m(place, read.place));
    }
  }
  return nearest_m;
}

// Root mean squares over some places.
class Difference {
 public:
  void Add(const GasMap& full, const GasMap& coarse, std::size_t i, Point2 place) {
    const double mean_ppm = full.mean_ppm()[i];
    const double truth_ppm = Truth_ppm(place);
    const double stddev_ppm = std::sqrt(full.error_variance_ppm2()[i]);
    Square(mean_, coarse.mean_ppm()[i] - mean_ppm);
    Square(stddev_, std::sqrt(coarse.error_variance_ppm2()[i]) - stddev_ppm);
    Square(full_stddev_, stddev_ppm);
    Square(full_error_, mean_ppm - truth_ppm);
    Square(coarse_error_, coarse.mean_ppm()[i] - truth_ppm);
    model_ += coarse.variance_ppm2()[i] / full.variance_ppm2()[i] - 1.0;
    ++cells_;
  }

  void Tell(const std::string& name, BenchSummary& summary) const {
    summary.Set(name + "_mean_off_ppm", Root(mean_));
    summary.Set(name + "_stddev_off_ppm", Root(stddev_));
    summary.Set(name + "_full_stddev_ppm", Root(full_stddev_));
    summary.Set(name + "_error_ppm", Root(coarse_error_));
    summary.Set(name + "_full_error_ppm", Root(full_error_));
    summary.Set(name + "_model_variance_off_ratio", model_ / cells_);
  }

 private:
  static void Square(double& sum, double value) { sum += value * value; }
  double Root(double sum) const { return std::sqrt(sum / cells_); }

  double mean_ = 0.0;
  double stddev_ = 0.0;
  double full_stddev_ = 0.0;
  double full_error_ = 0.0;
  double coarse_error_ = 0.0;
  double model_ = 0.0;
  int cells_ = 0;
};

void Compare(const GasMap& full, const GasMap& coarse, const Grid<double>& nearest_m,
             const std::string& name, BenchSummary& summary) {
  Difference near;
  Difference between;
  Difference far;
  for (std::size_t i = 0; i < nearest_m.size(); ++i) {
    const Point2 place = nearest_m.geometry().Center(nearest_m.geometry().CellAtIndex(i));
    Difference& where = nearest_m[i] <= kNear_m ? near : nearest_m[i] < kFar_m ? between : far;
    where.Add(full, coarse, i, place);
  }
  near.Tell(name + "_near", summary);
  between.Tell(name + "_between", summary);
  far.Tell(name + "_far", summary);
}

}  // namespace

absl::Status MeasureCoarseFields(double side_m, BenchSummary& summary) {
  constexpr double kCell_m = 0.1;
  const int side = static_cast<int>(std::lround(side_m / kCell_m));
  const Grid<CellState> states(GridGeometry{0.0, 0.0, kCell_m, side, side}, CellState::kFree);
  const std::vector<Read> reads = Drive(side_m, summary.seed());
  const Grid<double> nearest_m = Distances(states, reads);
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto full, MapOf(GasOptions(), states, reads));
  for (const int factor : {2, 4, 8}) {
    for (const bool by_area : {true, false}) {
      GasOptions options;
      options.lattice_factor = factor;
      options.background_by_area = by_area;
      PLUMESCOUT_ASSIGN_OR_RETURN(const auto coarse, MapOf(options, states, reads));
      const char* const rule = by_area ? "" : "_by_cell";
      Compare(*full, *coarse, nearest_m, absl::StrCat("coarse_", side_m, "m_", factor, rule),
              summary);
    }
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
