// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/gas_validation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/grid/mask.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/formats/scene_folder.h"
#include "lab/report/palette.h"
#include "lab/sim/advection_diffusion.h"
#include "lab/sim/cell_wind.h"
#include "lab/sim/layout_generator.h"
#include "lab/sim/open_air.h"
#include "lab/trials/field_agreement.h"
#include "lab/worlds/bundled_layouts.h"
#include "lab/worlds/gaussian_plume.h"
#include "lab/worlds/plume_mean.h"

namespace plumescout::lab {
namespace {

constexpr double kBar = 0.85;  // least log-correlation of filaments and equation
constexpr int kBuildings = 2;

Grid<float> Total(const std::vector<Grid<float>>& layers) {
  Grid<float> total = layers.front();
  for (std::size_t s = 1; s < layers.size(); ++s) {
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += layers[s][i];
  }
  return total;
}

// One map of gas and where it is from.
struct NamedMap {
  std::string name;
  Grid<float> ppm;
};

MapPanel MakePanel(const NamedMap& map, const Grid<CellState>& occupancy,
                   const std::vector<GasSource>& sources) {
  const ColorScale scale{ColorMap::kGas, 0.1, 300.0, true};
  MapPanel panel;
  panel.title = map.name;
  panel.region = RegionOf(occupancy.geometry());
  panel.cells = PaintCells(occupancy.geometry(), panel.region, [&](Cell cell) {
    return occupancy[cell] == CellState::kFree ? scale(map.ppm[cell]) : kWallColor;
  });
  for (const GasSource& source : sources) {
    panel.marks.push_back({MarkShape::kCross, kSourceColor, {source.x_m, source.y_m}});
  }
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{"source", MarkShape::kCross, kSourceColor}};
  return panel;
}

// Everything that the checks share.
struct Run {
  const ExperimentOptions& options;
  Study study;
  double worst_correlation = 1.0;
  double done = 0.0;  // cases
  double cases = 1.0;

  FractionFn Progress() const {
    return [this](double share) {
      if (options.progress) options.progress((done + share) / cases);
    };
  }
  MeanWindow Window() const {
    constexpr MeanWindow kQuick{30.0, 40.0};
    constexpr MeanWindow kFull{120.0, 180.0};
    return options.quick ? kQuick : kFull;
  }
  void Record(const std::string& name, const FieldAgreement& agreement) {
    auto& figures = study.summary.figures;
    figures.emplace_back(name + "_log_correlation", agreement.log_correlation);
    figures.emplace_back(name + "_critical_overlap", agreement.overlap);
    figures.emplace_back(name + "_mean_ratio", agreement.mean_ratio);
    study.figures.key_numbers.emplace_back(
        name + ": log-correlation, overlap",
        absl::StrFormat("%.3f, %.2f", agreement.log_correlation, agreement.overlap));
  }
};

double Thousands(std::int64_t count) { return static_cast<double>(count) / 1000.0; }

Chart MakeMassChart(const std::vector<MassPoint>& mass) {
  Curve inside{"inside", {kLineColors[0], 2.0}, {}};
  Curve accounted{"in + out", {kLineColors[1], 2.0}, {}};
  Curve released{"released", {kInk, 1.2, 6.0}, {}};
  for (const MassPoint& point : mass) {
    inside.points.push_back({point.time_s, Thousands(point.inside)});
    accounted.points.push_back({point.time_s, Thousands(point.inside + point.left)});
    released.points.push_back({point.time_s, Thousands(point.released)});
  }
  return {
      "Filaments", "time, s (the mean begins at 0)", std::nullopt, {inside, accounted, released}};
}

std::int64_t LargestImbalance(const std::vector<MassPoint>& mass) {
  std::int64_t largest = 0;
  for (const MassPoint& point : mass) {
    largest = std::max(largest, std::abs(point.released - point.inside - point.left));
  }
  return largest;
}

// Filaments against the steady solution on the wind of a layout.
absl::Status CheckLayout(const std::string& name, const Layout& layout, bool shown, Run& run) {
  WindOptions wind_options;
  if (run.options.quick) wind_options.flow_s = 6.0;
  PLUMESCOUT_ASSIGN_OR_RETURN(const LayoutRaster raster, Rasterize(layout));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MacField wind, SolveWind(raster.flow, wind_options));
  const PlumeCase gas_case{raster, wind, layout.sources, layout.gas};
  const PlumeMean mean = MeanOfFilaments(gas_case, run.Window(), run.options.seed, run.Progress());
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<Grid<float>> layers,
      MeanConcentration(raster, wind, layout.sources, layout.gas, run.Window()));
  const Grid<float> expected = Total(layers);
  const FieldAgreement agreement =
      Compare(mean.ppm, expected, raster.occupancy, layout.critical_threshold_ppm);
  run.Record(name, agreement);
  run.worst_correlation = std::min(run.worst_correlation, agreement.log_correlation);
  run.study.summary.figures.emplace_back(name + "_mass_imbalance_filaments",
                                         static_cast<double>(LargestImbalance(mean.mass)));
  run.study.summary.about.emplace_back(name + "_filaments",
                                       absl::StrFormat("%.0f x real time", mean.times_real_time));
  if (!shown) return absl::OkStatus();
  auto& panels = run.study.figures.panels;
  panels.push_back(
      MakePanel({name + ": filaments, mean", mean.ppm}, raster.occupancy, layout.sources));
  panels.push_back(MakePanel({name + ": equation", expected}, raster.occupancy, layout.sources));
  if (run.study.figures.charts.empty()) {
    run.study.figures.charts.push_back(MakeMassChart(mean.mass));
  }
  return absl::OkStatus();
}

// Steady wind of 1 m/s over an open field, one source, far from the field's edges.
struct OpenField {
  GridGeometry geometry;
  GaussianPlume plume;
  MeanWindow window;
  Grid<float> mean_ppm;

  double Passed() const { return plume.gas.filaments_per_s * window.mean_s; }
  double Mean_ppm(double x_m, double y_m) const {
    return mean_ppm[geometry.CellAt({plume.source.x_m + x_m, plume.source.y_m + y_m})];
  }
};

OpenField BlowOverOpenField(Run& run) {
  OpenField field;
  field.geometry.width = 100;
  field.geometry.height = 50;
  field.plume.source = {0, 1.05, 2.55, 0.4, 1000.0};  // on the centre of a cell
  field.window = {12.0, run.options.quick ? 60.0 : 600.0};
  const PlumeCase gas_case{OpenAir(field.geometry),
                           UniformWind(field.geometry, {field.plume.wind_mps, 0.0}),
                           {field.plume.source},
                           field.plume.gas};
  field.mean_ppm = MeanOfFilaments(gas_case, field.window, run.options.seed, run.Progress()).ppm;
  return field;
}

constexpr double kProfilesAt_m[] = {1.0, 3.0, 7.0};

Chart MakeProfiles(const OpenField& field, Run& run) {
  Chart chart{"Across, ppm", "y, m (at x = 1, 3, 7 m; dashed: Gaussian)", std::nullopt, {}};
  constexpr double kHalfWidth_m = 1.6;
  std::size_t color = 0;
  for (const double x_m : kProfilesAt_m) {
    Curve mean{absl::StrFormat("%.0f m", x_m), {kLineColors[color++], 2.0}, {}};
    Curve exact{"", {kInk, 1.2, 5.0}, {}};
    for (double y_m = -kHalfWidth_m; y_m < kHalfWidth_m + 0.05; y_m += 0.1) {
      mean.points.push_back({y_m, field.Mean_ppm(x_m, y_m)});
      exact.points.push_back({y_m, field.plume.At_ppm(x_m, y_m)});
      run.study.table.rows.push_back(
          {x_m, y_m, mean.points.back().y, exact.points.back().y,
           field.plume.Tolerance(x_m, y_m, field.Passed()) * exact.points.back().y});
    }
    chart.curves.push_back(std::move(mean));
    chart.curves.push_back(std::move(exact));
  }
  return chart;
}

Chart MakeCentreLine(const OpenField& field) {
  Curve mean{"filaments", {kLineColors[0], 2.0}, {}};
  Curve exact{"Gaussian", {kInk, 1.2, 5.0}, {}};
  for (double x_m = 0.5; x_m < 8.5; x_m += 0.1) {
    mean.points.push_back({x_m, std::log10(field.Mean_ppm(x_m, 0.0))});
    exact.points.push_back({x_m, std::log10(field.plume.At_ppm(x_m, 0.0))});
  }
  return {"Along the wind, log10 of ppm", "x, m", std::nullopt, {mean, exact}};
}

// Largest deviation from the Gaussian plume within 2 sigma of its axis, in tolerances.
double LargestDeviation(const OpenField& field) {
  double largest = 0.0;
  for (double x_m = 1.0; x_m < 8.05; x_m += 0.5) {
    const double growth =
        field.plume.gas.growth_m2_per_s + 2.0 * field.plume.gas.diffusivity_m2_per_s;
    const double sigma_m = std::sqrt(0.01 + growth * x_m / field.plume.wind_mps);
    for (double y_m = -2.0 * sigma_m; y_m <= 2.0 * sigma_m; y_m += 0.1) {
      const double y_cell_m = 0.1 * std::round(y_m / 0.1);
      const double exact = field.plume.At_ppm(x_m, y_cell_m);
      const double deviation = std::abs(field.Mean_ppm(x_m, y_cell_m) / exact - 1.0);
      largest = std::max(largest, deviation / field.plume.Tolerance(x_m, y_cell_m, field.Passed()));
    }
  }
  return largest;
}

void CheckOpenField(Run& run) {
  const OpenField field = BlowOverOpenField(run);
  run.study.figures.charts.push_back(MakeProfiles(field, run));
  run.study.figures.charts.push_back(MakeCentreLine(field));
  const double deviation = LargestDeviation(field);
  run.study.summary.figures.emplace_back("gaussian_plume_largest_deviation_in_tolerances",
                                         deviation);
  run.study.figures.key_numbers.emplace_back("Gaussian plume: deviation / tolerance",
                                             absl::StrFormat("%.2f", deviation));
}

// Our gas on the wind of a scene made elsewhere, of which only a slice is known.
absl::Status CheckScene(const Scene& scene, Run& run) {
  PlumeCase gas_case;
  gas_case.raster.occupancy = scene.occupancy;
  gas_case.raster.flow.fluid = MaskOf(scene.occupancy, CellState::kFree);
  gas_case.sources = scene.sources;
  const MacField slice_wind = FaceWind(*scene.wind, scene.occupancy);
  PLUMESCOUT_ASSIGN_OR_RETURN(gas_case.wind, WithoutDivergence(slice_wind, scene.occupancy));
  const PlumeMean mean = MeanOfFilaments(gas_case, run.Window(), run.options.seed, run.Progress());
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<Grid<float>> layers,
      SteadyConcentration(gas_case.raster, slice_wind, scene.sources, gas_case.gas));
  const std::vector<NamedMap> maps = {{scene.name + ": its own mean", scene.conc_mean_ppm},
                                      {scene.name + ": steady, leaving upwards", Total(layers)},
                                      {scene.name + ": filaments, closed", mean.ppm}};
  for (const NamedMap& map : maps) {
    run.study.figures.panels.push_back(MakePanel(map, scene.occupancy, scene.sources));
  }
  const auto agreement = [&](const NamedMap& map) {
    return Compare(scene.conc_mean_ppm, map.ppm, scene.occupancy, scene.critical_threshold_ppm);
  };
  run.Record(scene.name + "_steady", agreement(maps[1]));
  run.Record(scene.name + "_filaments", agreement(maps[2]));
  return absl::OkStatus();
}

std::vector<std::string> MakeNotes(const ExperimentOptions& options) {
  std::vector<std::string> notes = {
      "Two models of the same gas on the same wind: filaments, blown and walking at random one by "
      "one, and the advection-diffusion equation, solved for the mean over the same time. Their "
      "maps agree if both are right. Log-correlation: of ln max(0.05 ppm, c) over free cells; 0.05 "
      "ppm is the least "
      "that a sensor detects, and below it the mean hangs on single filaments. At least 0.85 is "
      "asked for. Overlap: of the cells above 2.5 ppm, intersection over union.",
      "In the open, in uniform wind, the mean must be the Gaussian plume. The tolerance is 4 "
      "standard deviations of a mean of that many filaments, and the two known shares that the "
      "formula or the filaments leave out: 1 asks for nothing more than chance allows."};
  if (options.quick) notes.push_back("Quick: one small building and short means.");
  if (options.scenes.empty()) {
    notes.push_back("No scene folders were given (--scenes): none made elsewhere is compared.");
  } else {
    notes.push_back(
        "Scenes made elsewhere are slices of a flow in space. Steady: air that flows together "
        "leaves the slice upwards with its gas, and what comes from above is clean. Filaments: on "
        "the nearest wind that stays within the slice, which nothing leaves, so the level rises "
        "with time. Nothing is fitted, and nothing asked for.");
  }
  return notes;
}

// All of them, before anything runs.
absl::StatusOr<std::vector<Scene>> ReadScenes(const std::vector<std::string>& folders) {
  std::vector<Scene> scenes;
  for (const std::string& folder : folders) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(folder));
    if (!scene.wind) {
      return absl::InvalidArgumentError(absl::StrCat(folder, ": the scene has no wind"));
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

absl::Status CheckLayouts(Run& run) {
  GeneratorOptions generator;
  if (run.options.quick) {
    generator.max_size_x_m = generator.max_size_y_m = generator.min_size_m;
    return CheckLayout("building", GenerateLayout(run.options.seed, generator), true, run);
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout hall, BundledLayout("industrial_16x20"));
  PLUMESCOUT_RETURN_IF_ERROR(CheckLayout("hall", hall, true, run));
  run.done += 1.0;
  for (int i = 0; i < kBuildings; ++i) {
    const Layout layout =
        GenerateLayout(run.options.seed + static_cast<std::uint64_t>(i), generator);
    PLUMESCOUT_RETURN_IF_ERROR(CheckLayout(absl::StrCat("building_", i + 1), layout, i == 0, run));
    run.done += 1.0;
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Study> RunGasValidation(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Scene> scenes, ReadScenes(options.scenes));
  Run run{options, {}};
  const double layouts = options.quick ? 1.0 : 1.0 + kBuildings;
  run.cases = layouts + 1.0 + static_cast<double>(options.scenes.size());
  run.study.table.columns = {"x_m", "y_m", "filaments_ppm", "gaussian_plume_ppm", "tolerance_ppm"};
  PLUMESCOUT_RETURN_IF_ERROR(CheckLayouts(run));
  run.done = layouts;
  CheckOpenField(run);
  for (const Scene& scene : scenes) {
    run.done += 1.0;
    PLUMESCOUT_RETURN_IF_ERROR(CheckScene(scene, run));
  }
  Study& study = run.study;
  study.figures.title = "Can the simulated gas be believed?";
  study.figures.notes = MakeNotes(options);
  study.figures.key_numbers.emplace(
      study.figures.key_numbers.begin(), "least log-correlation (asked: 0.85)",
      absl::StrFormat("%.3f%s", run.worst_correlation, run.worst_correlation < kBar ? " !" : ""));
  study.summary.figures.emplace_back("least_log_correlation", run.worst_correlation);
  for (auto& entry : AboutThisRun(options.seed)) study.summary.about.push_back(std::move(entry));
  return std::move(run.study);
}

}  // namespace plumescout::lab
