// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_sheet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/report/cairo_canvas.h"
#include "lab/report/font.h"
#include "lab/report/palette.h"
#include "lab/report/plan_names.h"

namespace plumescout::lab {
namespace {

constexpr int kMargin_px = 32;
constexpr int kGap_px = 32;
constexpr int kPanel_px = 480;
constexpr int kTop_px = 104;  // title, sentence and effort
constexpr int kTableTitle_px = 30;
constexpr int kRow_px = 24;
constexpr double kText_px = 12.0;
constexpr int kWidth_px = 2 * kMargin_px + 2 * kPanel_px + kGap_px;

struct Column {
  const char* name;
  double x_px;  // of its text's start, or end if `numeric`, from the left of the table
  bool numeric = false;
};

struct TableRow {
  std::vector<std::string> texts;  // one per column
  bool highlighted = false;
};

struct Table {
  std::string title;
  std::vector<Column> columns;
  std::vector<TableRow> rows;

  int height_px() const {
    return kTableTitle_px + kRow_px * (1 + static_cast<int>(rows.size())) + kGap_px / 2;
  }
};

std::string InformationOf(const Candidate& candidate) {
  if (candidate.expected_information_nats) {
    return absl::StrFormat("%.1f", *candidate.expected_information_nats);
  }
  if (candidate.information_bound_nats) {
    return absl::StrFormat("at most %.1f", *candidate.information_bound_nats);
  }
  return "-";
}

Table CandidateTable(const Plan& plan) {
  Table table{absl::StrCat("Candidates (", plan.candidates.size(), ")"),
              {{"", 0.0},
               {"goal", 30.0},
               {"cost J", 295.0, true},
               {"length, m", 370.0, true},
               {"duration, s", 455.0, true},
               {"mean UCB, 0–1", 560.0, true},
               {"mean gas, ppm", 665.0, true},
               {"exp. information, nats", 825.0, true},
               {"path from", 845.0}},
              {}};
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& c = plan.candidates[i];
    const bool chosen = static_cast<int>(i) == plan.chosen;
    table.rows.push_back(
        {{CandidateLabel(i), absl::StrCat(NameOf(c.goal.kind), chosen ? " - chosen" : ""),
          absl::StrFormat("%.2f", c.cost), absl::StrFormat("%.2f", c.length_m),
          absl::StrFormat("%.1f", c.duration_s), absl::StrFormat("%.3f", c.mean_ucb),
          absl::StrFormat("%.2f", c.mean_concentration_ppm), InformationOf(c),
          NameOf(c.path_source)},
         chosen});
  }
  return table;
}

Table RejectionTable(const Plan& plan) {
  Table table{absl::StrCat("Rejected goals (", plan.rejected.size(), ")"),
              {{"", 0.0}, {"goal", 30.0}, {"at, m", 200.0}, {"why", 300.0}, {"detail", 500.0}},
              {}};
  const std::size_t listed = std::min(kListedRejections, plan.rejected.size());
  for (std::size_t i = 0; i < listed; ++i) {
    const RejectedGoal& r = plan.rejected[i];
    table.rows.push_back({{RejectionLabel(i), NameOf(r.goal.kind),
                           absl::StrFormat("%.1f, %.1f", r.goal.position.x_m, r.goal.position.y_m),
                           NameOf(r.reason), r.detail}});
  }
  if (listed < plan.rejected.size()) {
    table.rows.push_back(
        {{"", absl::StrCat("and ", plan.rejected.size() - listed, " more (crosses)"), "", "", ""}});
  }
  return table;
}

void DrawRow(Canvas& canvas, const PixelBox& box, const std::vector<Column>& columns,
             const TableRow& row) {
  constexpr Rgb kHighlight{252, 232, 244};
  if (row.highlighted) canvas.FillBox(box, kHighlight);
  const PixelPoint rule[] = {{box.x, box.bottom()}, {box.right(), box.bottom()}};
  canvas.Polyline(rule, {kGridLine, 1.0});
  constexpr double kIndent_px = 6.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool bold = row.highlighted || i == 0;
    const double x = kIndent_px + columns[i].x_px;
    const bool last = i + 1 == columns.size();
    const double size_px =
        last ? SizeToFit_px(row.texts[i], kText_px, box.width - x, bold) : kText_px;
    canvas.Text({box.x + x, box.bottom() - 7.0}, row.texts[i],
                {size_px, kInk, columns[i].numeric ? Anchor::kEnd : Anchor::kStart, bold});
  }
}

void DrawTable(Canvas& canvas, double top, const Table& table) {
  canvas.Text({kMargin_px, top + 16.0}, table.title, {16.0, kInk, Anchor::kStart, true});
  PixelBox row{kMargin_px, top + kTableTitle_px, kWidth_px - 2.0 * kMargin_px, kRow_px};
  TableRow names;
  for (const Column& column : table.columns) names.texts.emplace_back(column.name);
  DrawRow(canvas, row, table.columns, names);
  for (const TableRow& texts : table.rows) {
    row.y += kRow_px;
    DrawRow(canvas, row, table.columns, texts);
  }
}

void DrawHead(Canvas& canvas, const PlanPicture& picture) {
  const Plan& plan = picture.plan;
  constexpr double kContent_px = kWidth_px - 2 * kMargin_px;
  const std::string effort = absl::StrFormat(
      "Search: %s; %d samples, %d vertices, %d edges priced, %d of %d paths by the grid guard; "
      "seed %u.",
      NameOf(plan.end), plan.effort.samples, plan.effort.vertices, plan.effort.edges_evaluated,
      plan.effort.goals_by_guard, plan.candidates.size(), plan.seed);
  canvas.Text({kMargin_px, 50.0}, picture.title,
              {SizeToFit_px(picture.title, 26.0, kContent_px, true), kInk, Anchor::kStart, true});
  canvas.Text({kMargin_px, 78.0}, plan.explanation,
              {SizeToFit_px(plan.explanation, 15.0, kContent_px), kInk});
  canvas.Text({kMargin_px, 100.0}, effort, {SizeToFit_px(effort, 13.0, kContent_px), kFaintInk});
}

}  // namespace

Image DrawPlanSheet(const PlanPicture& picture) {
  const std::vector<MapPanel> panels = MakePlanPanels(picture);
  const Table tables[] = {CandidateTable(picture.plan), RejectionTable(picture.plan)};
  const double panel_height_px = std::ceil(MapPanelHeight_px(panels.front(), kPanel_px));
  const int tables_top = kMargin_px + kTop_px + static_cast<int>(panel_height_px) + kGap_px / 2;
  int height_px = tables_top + kMargin_px;
  for (const Table& table : tables) height_px += table.height_px();

  return DrawImage(kWidth_px, height_px, kPaper, [&](Canvas& canvas) {
    DrawHead(canvas, picture);
    double x = kMargin_px;
    for (const MapPanel& panel : panels) {
      DrawMapPanel(canvas, {x, kMargin_px + kTop_px, kPanel_px, panel_height_px}, panel);
      x += kPanel_px + kGap_px;
    }
    double top = tables_top;
    for (const Table& table : tables) {
      DrawTable(canvas, top, table);
      top += table.height_px();
    }
  });
}

}  // namespace plumescout::lab
