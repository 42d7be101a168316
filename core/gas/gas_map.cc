// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_map.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/gas/coarse_prior.h"
#include "core/gas/gas_scale.h"
#include "core/gas/unread_discount.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

std::int64_t CountActive(std::span<const CellInput> inputs) {
  return std::count_if(inputs.begin(), inputs.end(), [](const CellInput& i) { return i.active; });
}

std::unique_ptr<FieldEngine> MakeEngine(const GasLattice& lattice, std::vector<CellInput> inputs,
                                        const FieldOptions& options) {
  return std::make_unique<FieldEngine>(static_cast<std::size_t>(lattice.width),
                                       static_cast<std::size_t>(lattice.height), std::move(inputs),
                                       options);
}

// What `inputs` say and `engine` has not heard.
std::vector<CellChange> Differences(std::span<const CellInput> inputs, const FieldEngine& engine) {
  std::vector<CellChange> changes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i] != engine.input(i)) changes.push_back({i, inputs[i]});
  }
  return changes;
}

}  // namespace

GasMap::GasMap(const GasOptions& options, double resolution_m)
    : options_(options), inputs_(options, resolution_m) {
  field_options_.prior = PriorOf(options, {});
  assert(Validate(options).ok());
}

void GasMap::Add(std::int64_t time_ns, Point2 position, const GasReading& reading, bool is_part) {
  inputs_.Add(time_ns, position, reading, is_part);
  stale_ = true;
}

void GasMap::ReplaceReadings(ReadingStore readings, SensorOffsets sensors) {
  epoch_.reset();
  engine_.reset();
  origin_.reset();
  options_.lattice_factor = inputs_.factor();
  inputs_ = GasInputs(options_, std::move(readings), std::move(sensors));
  lattice_ = {};
  active_cells_ = 0;
  schedule_ = {};
  has_failed_ = false;
  stale_ = true;
  replaced_ = true;
  published_ = false;
}

void GasMap::AddFrom(const ReadingSource& source, std::int64_t time_ns, Point2 position,
                     const GasReading& reading) {
  inputs_.AddFrom(source, time_ns, position, reading);
  stale_ = true;
  published_ = false;  // sensors may have met: not for those alone who look only from now on
}

absl::Status GasMap::Refresh(const Grid<CellState>& states, std::int64_t time_ns) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<GasCell> changed, inputs_.Update(states, time_ns));
  stale_ = false;
  replaced_ = false;
  ++quality_.refreshes;
  published_ = false;
  if (inputs_.rect().empty()) return absl::OkStatus();
  const bool usable = engine_ != nullptr && !has_failed_ && HasRoom(lattice_, inputs_.rect(), 0);
  if (!usable) return Conclude(Rebuild(time_ns), time_ns);
  const Changes changes = ChangesIn(changed);
  const std::int64_t active = active_cells_ + changes.activated - changes.deactivated;
  const auto lattice_cells = static_cast<std::int64_t>(lattice_.size());
  const bool fits = FieldBytes(active, lattice_cells) <= most_field_bytes_;
  return Conclude(fits || !inputs_.CanCoarsen() ? Apply(changes) : Rebuild(time_ns), time_ns);
}

// What the engine has not heard.
GasMap::Changes GasMap::ChangesIn(std::span<const GasCell> changed) const {
  Changes changes;
  for (const GasCell gas_cell : changed) {
    if (!lattice_.Contains(gas_cell)) continue;  // beside the first cell that has been free
    const std::size_t index = lattice_.Index(gas_cell);
    const CellInput input = inputs_.Of(gas_cell);
    const CellInput heard = engine_->input(index);
    if (input == heard) continue;
    if (input.active && !heard.active) ++changes.activated;
    if (!input.active && heard.active) ++changes.deactivated;
    changes.cells.push_back({index, input});
  }
  return changes;
}

absl::Status GasMap::Apply(const Changes& changes) {
  schedule_.NoteRefresh(changes.activated + changes.deactivated);
  active_cells_ += changes.activated - changes.deactivated;
  if (!changes.cells.empty()) origin_.reset();
  const std::int64_t healed = engine_->healed();
  const absl::Status status = engine_->Apply(changes.cells);
  quality_.healed += engine_->healed() - healed;
  return status;
}

// All here and now: at the first free cell, and when the lattice no longer does.
absl::Status GasMap::Rebuild(std::int64_t time_ns) {
  epoch_.reset();
  engine_.reset();  // makes room
  origin_.reset();
  inputs_.AgeTo(time_ns);
  GasLattice lattice = RoomyLattice();
  std::vector<CellInput> inputs = inputs_.On(lattice);
  active_cells_ = CountActive(inputs);
  while (FieldBytes(active_cells_, static_cast<std::int64_t>(lattice.size())) > most_field_bytes_ &&
         inputs_.Coarsen()) {
    options_.lattice_factor = inputs_.factor();
    field_options_.prior = PriorOf(options_, prior_scale_);
    lattice_ = {};
    lattice = RoomyLattice();
    inputs = inputs_.On(lattice);
    active_cells_ = CountActive(inputs);
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckCells(inputs));
  FieldOrigin origin = {CellRuns(inputs), {}};
  auto engine = MakeEngine(lattice, std::move(inputs), field_options_);
  TakeOver(std::move(engine), lattice, std::move(origin));
  schedule_.NoteFresh(active_cells_);
  quality_.aged_to_ns = time_ns;
  const absl::Status status = engine_->Apply({});  // whether it is sound
  quality_.healed += engine_->healed();
  return status;
}

GasLattice GasMap::RoomyLattice() const {
  return MakeLattice(lattice_, inputs_.rect(), EpochSchedule::Margin_cells(inputs_.rect()));
}

void GasMap::TakeOver(std::unique_ptr<FieldEngine> engine, const GasLattice& lattice,
                      FieldOrigin origin) {
  engine_ = std::move(engine);
  origin_ = std::move(origin);
  lattice_ = lattice;
  published_ = false;
}

bool GasMap::epoch_due(std::int64_t time_ns) const {
  return epoch_possible() &&
         (schedule_.IsDue(lattice_, inputs_.rect()) || inputs_.watch().IsEpochDue(time_ns) ||
          (learns() && IsLessonDue(prior_scale_, counters().in_posterior)));
}

absl::Status GasMap::BeginEpoch(std::int64_t time_ns) {
  if (epoch_ != nullptr) {
    return absl::FailedPreconditionError("an epoch of the gas map is under way already");
  }
  if (engine_ == nullptr || has_failed_) {
    return absl::FailedPreconditionError("there is no gas field to begin an epoch with");
  }
  EpochInputs start;
  start.time_ns = time_ns;
  start.options = field_options_;
  start.prior_scale = prior_scale_;
  if (learns()) {
    start.prior_scale = Improved(prior_scale_, PriorFitOf(*engine_, lattice_, inputs_, options_),
                                 counters().in_posterior);
    start.is_same_model = start.prior_scale.theta == prior_scale_.theta;
    start.options.prior = PriorOf(options_, start.prior_scale);
  }
  start.lattice = RoomyLattice();
  start.cells = inputs_.On(start.lattice);
  start.mean_ppm.resize(start.lattice.size());
  start.variance_ppm2.resize(start.lattice.size());
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    const std::size_t index = start.lattice.Index(lattice_.CellAt(i));
    start.mean_ppm[index] = engine_->mean_ppm(i);
    start.variance_ppm2[index] = engine_->variance_ppm2(i);
  }
  for (const auto& [gas_cell, evidence] : inputs_.EvidenceAsOf(time_ns)) {
    const std::size_t index = start.lattice.Index(gas_cell);
    CellInput aged = start.cells[index];
    aged.precision = evidence.precision;
    aged.weighted_deviation = evidence.weighted_deviation;
    start.aged.push_back({index, aged});
  }
  epoch_ = std::make_shared<GasEpoch>(std::move(start));
  published_ = false;  // readings of like age may have been merged
  return absl::OkStatus();
}

bool GasMap::adoption_due(std::int64_t time_ns) const {
  return epoch_ != nullptr && time_ns - epoch_->time_ns() >= EpochSchedule::kRecompute_ns;
}

absl::Status GasMap::Adopt() {
  if (epoch_ == nullptr) {
    return absl::FailedPreconditionError("no epoch of the gas map is under way");
  }
  epoch_->Recompute();
  const std::shared_ptr<GasEpoch> epoch = std::exchange(epoch_, nullptr);
  if (!epoch->done()) return Conclude(epoch->failure(), time_ns_);
  inputs_.AgeTo(epoch->time_ns());
  const std::vector<CellInput> inputs = inputs_.On(epoch->lattice());
  std::unique_ptr<FieldEngine> engine = epoch->TakeEngine();
  std::vector<CellChange> differences = Differences(inputs, *engine);
  const absl::Status status = engine->Apply(differences);
  quality_.healed += engine->healed();
  if (!status.ok()) return Conclude(status, time_ns_);
  FieldOrigin origin = epoch->TakeOrigin();
  if (!differences.empty()) origin.changes.push_back(std::move(differences));
  TakeOver(std::move(engine), epoch->lattice(), std::move(origin));
  active_cells_ = CountActive(inputs);
  schedule_.NoteFresh(active_cells_);
  quality_.aged_to_ns = epoch->time_ns();
  ++quality_.epochs;
  prior_scale_ = epoch->prior_scale();
  field_options_.prior = epoch->prior();
  if (epoch->drift()) {
    quality_.drift_mean_ppm = epoch->drift()->mean_ppm;
    quality_.drift_variance_ratio = epoch->drift()->variance_ratio;
  }
  return Conclude(absl::OkStatus(), time_ns_);
}

bool GasMap::audit_due() const {
  const std::int64_t period = options_.audit_period_epochs;
  return period > 0 && quality_.epochs > 0 && (quality_.epochs - 1) % period == 0;
}

std::shared_ptr<const AuditInputs> GasMap::MakeAudit(std::size_t species) const {
  if (engine_ == nullptr || has_failed_ || epoch_ != nullptr) return nullptr;
  auto audit = std::make_shared<AuditInputs>();
  audit->species = species;
  audit->options = WithPriorScale(options_, prior_scale_);
  audit->states = inputs_.states().states();
  audit->corner = inputs_.states().At(0);
  audit->evidence = inputs_.AllEvidence();
  audit->lattice = lattice_;
  audit->mean_ppm.resize(lattice_.size());
  audit->variance_ppm2.resize(lattice_.size());
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    audit->mean_ppm[i] = engine_->mean_ppm(i);
    audit->variance_ppm2[i] = engine_->variance_ppm2(i);
  }
  audit->certified_mean_ppm = quality_.mean_error_ppm;
  audit->certified_variance_ratio = quality_.variance_error_ratio;
  return audit;
}

// What is left to do when a field was `computed`, or could not be.
absl::Status GasMap::Conclude(const absl::Status& computed, std::int64_t time_ns) {
  published_ = false;
  has_failed_ = !computed.ok();
  if (has_failed_) {
    epoch_.reset();
    origin_.reset();
    abandoned_ = abandoned_ || absl::IsCancelled(computed);
    if (absl::IsCancelled(computed)) return computed;
    ++quality_.failures;
    return absl::InternalError(absl::StrCat("gas map: ", computed.ToString()));
  }
  time_ns_ = time_ns;
  quality_.mean_error_ppm = engine_->error_bound().mean_ppm;
  quality_.variance_error_ratio = engine_->error_bound().variance_ratio;
  quality_.ageing_error_ratio = inputs_.watch().Error(time_ns);
  return absl::OkStatus();
}

absl::Status GasMap::MakeFieldAgain() {
  published_ = false;
  options_.lattice_factor = inputs_.factor();
  field_options_.prior = PriorOf(options_, prior_scale_);
  engine_.reset();
  if (!origin_) return absl::OkStatus();
  auto engine = MakeField(*origin_, lattice_, field_options_);
  if (absl::IsCancelled(engine.status())) return engine.status();
  if (!engine.ok())
    return absl::DataLossError(absl::StrCat("gas map: ", engine.status().message()));
  engine_ = *std::move(engine);
  return absl::OkStatus();
}

void GasMap::Publish() const {
  if (published_) return;
  constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
  const AnchoredStates& known = inputs_.states();
  mean_ppm_ = Grid<float>(known.states().geometry(), kNoValue);
  variance_ppm2_ = mean_ppm_;
  error_variance_ppm2_ = has_own_errors() ? mean_ppm_ : Grid<float>();
  noise_ = {};
  most_told_ppm_ = 0.0;
  what_if_ = nullptr;
  published_ = true;
  sensor_offsets_ = inputs_.sensors().Known();
  if (engine_ == nullptr || has_failed_) return;
  OffsetEstimate beside;
  if (inputs_.sensors().HasColumns()) beside = EstimateSensors();
  const bool has_offsets = !beside.mean_ppm.empty();
  if (options_.estimate_noise) {
    FieldFit fit = FitOf(*engine_, lattice_, inputs_, options_);
    // Offsets explain as much of each cell's part.
    if (fit.energy > 0.0) fit.level_energy *= std::max(0.0, 1.0 - beside.explained / fit.energy);
    fit.energy -= beside.explained;
    noise_ = NoiseOf(fit, prior_scale_);
  }
  AddVarianceWithinCells(WithPriorScale(options_, prior_scale_), lattice_.size(),
                         beside.variance_ppm2);
  const UnreadDiscount discount(options_);
  known.ForEachFree([&](std::size_t i, AnchorCell cell) {
    const std::size_t index = lattice_.Index(GasCellOf(cell, inputs_.factor()));
    double deviation = engine_->mean_ppm(index);
    double variance = engine_->variance_ppm2(index);
    if (has_offsets) deviation += beside.mean_ppm[index];
    if (!beside.variance_ppm2.empty()) variance += beside.variance_ppm2[index];
    const double told = discount.Of(deviation, prior_scale_.theta * variance);
    most_told_ppm_ = std::max(most_told_ppm_, std::abs(told));
    const GasEstimate gas =
        OffScale(options_, told, noise_.VarianceOf_ppm2(options_, variance, told, deviation));
    mean_ppm_[i] = static_cast<float>(gas.median_ppm);
    variance_ppm2_[i] = static_cast<float>(prior_scale_.theta * variance);
    if (has_own_errors()) error_variance_ppm2_[i] = static_cast<float>(gas.variance_ppm2);
  });
  beside_ppm2_ = std::move(beside.variance_ppm2);
}

// Fills in sensor_offsets_.
OffsetEstimate GasMap::EstimateSensors() const {
  const std::vector<SensorOffsets::Column> sensors = inputs_.sensors().Columns();
  std::vector<OffsetColumn> columns;
  for (const SensorOffsets::Column& sensor : sensors) {
    std::map<std::size_t, Evidence> by_cell;
    for (const CellEvidence& e : sensor.cells) {
      by_cell[lattice_.Index(GasCellOf(e.cell, inputs_.factor()))] += e.evidence;
    }
    OffsetColumn& column = columns.emplace_back();
    column.prior_precision_per_ppm2 = sensor.prior_precision_per_ppm2;
    for (const auto& [cell, evidence] : by_cell) column.cells.push_back({cell, evidence});
  }
  OffsetEstimate estimate = EstimateOffsets(*engine_, columns);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    SensorOffset& known = sensor_offsets_[sensors[k].sensor];
    known.offset_ppm = estimate.offset_ppm[k];
    known.stddev_ppm = estimate.stddev_ppm[k];
    known.estimated = true;
  }
  return estimate;
}

const std::vector<SensorOffset>& GasMap::sensor_offsets() const {
  Publish();
  return sensor_offsets_;
}

const Grid<float>& GasMap::mean_ppm() const {
  Publish();
  return mean_ppm_;
}

const Grid<float>& GasMap::error_variance_ppm2() const {
  Publish();
  return has_own_errors() ? error_variance_ppm2_ : variance_ppm2_;
}

GasQuality GasMap::quality() const {
  Publish();
  GasQuality quality = quality_;
  quality.mean_error_ppm = UnreadDiscount(options_).ErrorOf_ppm(
      most_told_ppm_, quality_.mean_error_ppm, quality_.variance_error_ratio);
  quality.noise_scale = noise_.scale;
  quality.noise_log_stddev = noise_.log_stddev;
  quality.clean_air_scale = noise_.VarianceOf_ppm2(options_, 1.0, 0.0, 0.0);
  quality.prior_precision_scale = prior_scale_.theta;
  quality.prior_precision_log_stddev = prior_scale_.log_stddev;
  return quality;
}

const Grid<float>& GasMap::variance_ppm2() const {
  Publish();
  return variance_ppm2_;
}

std::shared_ptr<const GasWhatIf> GasMap::what_if() const {
  Publish();
  // Nothing of what it is made from changes without a Publish after it.
  if (what_if_ == nullptr && has_field()) {
    what_if_ = std::make_shared<const GasWhatIf>(engine_->Snapshot(), lattice_, inputs_,
                                                 prior_scale_.theta, std::move(beside_ppm2_));
  }
  return what_if_;
}

}  // namespace plumescout
