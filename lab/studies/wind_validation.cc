// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/wind_validation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/trials/flow_pictures.h"
#include "lab/trials/flow_runs.h"
#include "lab/worlds/flow_cases.h"
#include "lab/worlds/published_flows.h"

namespace plumescout::lab {
namespace {

// Code of a flow in the table.
enum Flow { kCavityU = 1, kCavityV = 2, kChannel = 3, kStep = 4 };

// Observed order of convergence from three rasters, each twice as fine as the one before.
double Order(double coarse, double middle, double fine) {
  return std::log2(std::abs((coarse - middle) / (middle - fine)));
}

double OrderOfCavity(const CavityStudy& study) {
  return Order(study.runs[0].least_u, study.runs[1].least_u, study.runs[2].least_u);
}

// J. Fluids Eng. 127 (2005) 1154-1160, F. Durst et al.: The development lengths of laminar pipe and
// channel flows, for the plane channel.
double DurstEntrance(double reynolds) {
  constexpr double kPower = 1.6;
  return std::pow(std::pow(0.631, kPower) + std::pow(0.0442 * reynolds, kPower), 1.0 / kPower);
}

Curve Line(const std::string& name, const Stroke& stroke, const std::vector<LineSample>& samples) {
  Curve curve{name, stroke, {}};
  for (const LineSample& sample : samples) curve.points.push_back({sample.at, sample.speed});
  return curve;
}

// Both centre lines; the coarsest raster dashed.
Chart CavityChart(const CavityStudy& study) {
  constexpr double kDash_px = 4.0;
  const CavityRun& coarse = study.runs.front();
  const CavityRun& fine = study.runs.back();
  Curve ghia{"Ghia 1982", {kSourceColor, 6.0}, {}, CurveKind::kDots};
  for (const auto& points : {study.ghia.u, study.ghia.v}) {
    for (const ProfilePoint& point : points) ghia.points.push_back({point.at, point.speed});
  }
  return {
      absl::StrFormat("Cavity, Re %.0f", study.ghia.reynolds),
      absl::StrFormat("y or x on the centre line; %d cells, dashed %d", fine.cells, coarse.cells),
      std::nullopt,
      {Line("", {kLineColors[0], 1.2, kDash_px}, coarse.u),
       Line("", {kLineColors[1], 1.2, kDash_px}, coarse.v),
       Line("u over y", {kLineColors[0], 1.8}, fine.u),
       Line("v over x", {kLineColors[1], 1.8}, fine.v), ghia}};
}

// Errors whose truth is known to many digits; slopes of -1 and -2 are first and second order.
Chart ConvergenceChart(const FlowRuns& results) {
  Curve cavity{"cavity", {kLineColors[0], 2.0}, {}};
  for (const CavityRun& run : results.cavities.front().runs) {
    cavity.points.push_back(
        {std::log2(run.cells), std::log2(std::abs(run.least_u - kCavityLeastU100))});
  }
  Curve channel{"channel", {kLineColors[1], 2.0}, {}};
  for (const ChannelRun& run : results.channels) {
    channel.points.push_back({std::log2(run.cells), std::log2(run.largest_error)});
  }
  Curve second{"order 2", {kFaintInk, 1.2, 4.0}, {}};
  const double from = channel.points.front().x;
  const double to = cavity.points.back().x;
  const double start = channel.points.front().y;
  second.points = {{from, start}, {to, start - 2.0 * (to - from)}};
  return {"log2 error", "log2 of the cells across", std::nullopt, {cavity, channel, second}};
}

std::string Percent(double ours, double reference) {
  return absl::StrFormat("%+.1f %%", 100.0 * (ours / reference - 1.0));
}

void AddCavity(const CavityStudy& study, Study& result) {
  const CavityRun& fine = study.runs.back();
  const std::string name = absl::StrFormat("cavity Re %.0f", study.ghia.reynolds);
  result.figures.key_numbers.emplace_back(name + ": rms off Ghia, u | v",
                                          absl::StrFormat("%.4f | %.4f", fine.u_rms, fine.v_rms));
  result.figures.key_numbers.emplace_back(name + ": order of convergence",
                                          absl::StrFormat("%.2f", OrderOfCavity(study)));
  const std::string key = absl::StrFormat("cavity_re%.0f", study.ghia.reynolds);
  for (const CavityRun& run : study.runs) {
    const std::string prefix = absl::StrCat(key, "_n", run.cells);
    result.summary.figures.emplace_back(prefix + "_u_rms_off_ghia", run.u_rms);
    result.summary.figures.emplace_back(prefix + "_v_rms_off_ghia", run.v_rms);
    result.summary.figures.emplace_back(prefix + "_least_u", run.least_u);
    result.summary.figures.emplace_back(prefix + "_least_v", run.least_v);
    result.summary.figures.emplace_back(prefix + "_greatest_v", run.greatest_v);
    for (std::size_t i = 0; i < study.ghia.u.size(); ++i) {
      const auto& [u_at, u, u_misprint] = study.ghia.u[i];
      const auto& [v_at, v, v_misprint] = study.ghia.v[i];
      const double n = run.cells;
      result.table.rows.push_back(
          {kCavityU, study.ghia.reynolds, n, u_at, Interpolate(run.u, u_at), u});
      result.table.rows.push_back(
          {kCavityV, study.ghia.reynolds, n, v_at, Interpolate(run.v, v_at), v});
    }
  }
  result.summary.figures.emplace_back(key + "_order", OrderOfCavity(study));
}

void AddBotella(const CavityRun& fine, Study& result) {
  const auto add = [&](const char* name, double ours, double reference) {
    result.figures.key_numbers.emplace_back(
        absl::StrCat("cavity Re 100: ", name, " (Botella 1998)"),
        absl::StrFormat("%.4f (%.4f)", ours, reference));
  };
  add("least u", fine.least_u, kCavityLeastU100);
  add("least v", fine.least_v, kCavityLeastV100);
  add("greatest v", fine.greatest_v, kCavityGreatestV100);
}

void AddChannels(const std::vector<ChannelRun>& runs, Study& result) {
  for (const ChannelRun& run : runs) {
    const std::string prefix = absl::StrCat("channel_n", run.cells);
    result.summary.figures.emplace_back(prefix + "_largest_error", run.largest_error);
    result.summary.figures.emplace_back(prefix + "_entrance", run.entrance);
    for (const LineSample& sample : run.profile) {
      result.table.rows.push_back({kChannel, kChannelReynolds, static_cast<double>(run.cells),
                                   sample.at, sample.speed, Parabola(sample.at)});
    }
  }
  const double published = DurstEntrance(kChannelReynolds);
  result.summary.figures.emplace_back("channel_entrance_durst", published);
  result.figures.key_numbers.emplace_back("channel: largest error of u / mean",
                                          absl::StrFormat("%.4f", runs.back().largest_error));
  result.figures.key_numbers.emplace_back(
      absl::StrFormat("channel Re %.0f: entrance (Durst 2005)", kChannelReynolds),
      absl::StrFormat("%.2f (%.2f) heights", runs.back().entrance, published));
}

void AddSteps(const std::vector<StepRun>& runs, Study& result) {
  for (const StepRun& run : runs) {
    const double re = run.published.reynolds;
    result.summary.figures.emplace_back(
        absl::StrFormat("step_re%.0f_n%d_reattachment", re, run.cells), run.length);
    result.table.rows.push_back(
        {kStep, re, static_cast<double>(run.cells), 0.0, run.length, run.published.length});
    const int finest = runs.back().cells;
    if (run.cells != finest) continue;
    result.figures.key_numbers.emplace_back(
        absl::StrFormat("step Re %.0f: x_r / height (Erturk 2008)", re),
        absl::StrFormat("%.2f (%.2f) %s", run.length, run.published.length,
                        Percent(run.length, run.published.length)));
  }
}

MapPanel CavityPanel(const CavityStudy& study) {
  const CavityRun& fine = study.runs.back();
  // Those above 0 lie in the eddies of the lower corners.
  const std::vector<double> stream_values = {-0.11, -0.1,  -0.09, -0.07, -0.05, -0.03,
                                             -0.01, -1e-3, 1e-6,  1e-5,  1e-4,  5e-4};
  return DrawFlow(CavityDomain(fine.cells), fine.velocity,
                  {absl::StrFormat("Cavity, Re %.0f", study.ghia.reynolds),
                   RegionOf(fine.velocity.geometry()), 1.0, stream_values});
}

MapPanel StepPanel(const StepRun& run) {
  constexpr double kShownUpstream = 1.0;
  constexpr double kShownBehind = 7.0;
  constexpr double kFastest = 1.5;  // of the parabola
  MapPanel panel =
      DrawFlow(StepDomain(run.cells, kLengthBehindStep), run.velocity,
               {absl::StrFormat("Step, Re %.0f", run.published.reynolds),
                {{kStepUpstream - kShownUpstream, 0.0}, {kStepUpstream + kShownBehind, 2.0}},
                kFastest,
                {-0.05, -0.03, -0.01, 0.0, 0.1, 0.3, 0.5, 0.7, 0.9}});
  panel.marks = {{MarkShape::kDisc, kSourceColor, {kStepUpstream + run.length, 0.0}},
                 {MarkShape::kCross, kStartColor, {kStepUpstream + run.published.length, 0.0}}};
  panel.legend = {{"reattachment, ours", MarkShape::kDisc, kSourceColor},
                  {"Erturk 2008", MarkShape::kCross, kStartColor}};
  return panel;
}

std::vector<std::string> MakeNotes() {
  return {
      "The solver behind the wind of our scenes (staggered grid, projection, van Leer's limiter, "
      "Heun's method) on laminar flows whose answers are published. Everything is in units of the "
      "flow: edge and lid of the cavity, height and mean speed of the channel, height of the step. "
      "Runs end when no speed changes by more than 1e-5 per unit of time.",
      "Cavity: dots are Ghia, Ghia and Shin (1982), tables I and II. Two of their sixty values lie "
      "off the smooth curve through their neighbours (u at y = 0.0703, Re 100; v at x = 0.9063, Re "
      "400); they are drawn but not counted. At Re 100 their whole table differs by up to 0.009 "
      "from the spectral solution of Botella and Peyret (1998), which ours converges to: more "
      "cells do not bring it closer to Ghia.",
      "Channel: uniform air at the inlet, Poiseuille's parabola at the end, centre line at 99 % of "
      "its last speed after the length that Durst et al. (2005) give. Step: channel twice as high "
      "behind it, Re by mean speed and twice the height before it; reattachment by Erturk (2008); "
      "measurements of Armaly et al. (1983) agree with two-dimensional flow up to Re 400 or so. "
      "The order is that of three rasters, each twice as fine as the one before."};
}

}  // namespace

absl::StatusOr<Study> RunWindValidation(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const FlowRuns results, RunPublishedFlows(options));
  Study study;
  study.figures.title = "Wind on published flows";
  study.figures.notes = MakeNotes();
  study.table.columns = {"flow", "reynolds", "cells", "at", "ours", "published"};
  for (const CavityStudy& cavity : results.cavities) {
    AddCavity(cavity, study);
    study.figures.panels.push_back(CavityPanel(cavity));
    study.figures.charts.push_back(CavityChart(cavity));
  }
  AddSteps(results.steps, study);
  AddBotella(results.cavities.front().runs.back(), study);
  AddChannels(results.channels, study);
  for (const StepRun& run : results.steps) {
    if (run.cells == results.steps.back().cells) study.figures.panels.push_back(StepPanel(run));
  }
  study.figures.charts.push_back(ConvergenceChart(results));
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
