#include "drivers/simulator/options.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/random.h"
#include "schema/targets.h"

namespace mdof::drivers {
namespace {

constexpr double kLongest_mm = 10'000;
constexpr double kMostTargets = 10'000;
constexpr double kLongest_s = 1e9;

std::string text_of(double x) {
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// Sets `value` if the key is given. Rejects NaN and values outside [min, max].
void read(TomlTable& table, std::string_view key, double& value, double min, double max) {
  value = table.number(key, value);
  if (!(value >= min && value <= max))
    table.reject(key, "must be from " + text_of(min) + " to " + text_of(max));
}

// Returns true if the value of `key` is `yes`, false if it is `no`, and `fallback` if the key is
// missing.
bool read_choice(TomlTable& table, std::string_view key, const char* yes, const char* no,
                 bool fallback) {
  const std::string word = table.string(key, fallback ? yes : no);
  if (word != yes && word != no)
    table.reject(key, "must be \"" + std::string(yes) + "\" or \"" + no + "\"");
  return word == yes;
}

void read_spaced_targets(TomlTable& table, SimulatorOptions& options) {
  TargetSpacing spacing;
  read(table, "from_mm", spacing.from_mm, -kLongest_mm, kLongest_mm);
  read(table, "to_mm", spacing.to_mm, -kLongest_mm, kLongest_mm);
  read(table, "interval_mm", spacing.interval_mm, 0.001, kLongest_mm);
  read(table, "jitter_mm", spacing.jitter_mm, 0, kLongest_mm);
  spacing.seed = options.seed;
  if (const auto wrong = check_spacing(spacing)) return table.reject(wrong->key, wrong->why);
  options.targets_mm = spaced_targets_mm(spacing);
}

void read_targets(TomlTable& table, SimulatorOptions& options) {
  if (!table.has("targets_mm")) return read_spaced_targets(table, options);
  for (const char* key : {"from_mm", "to_mm", "interval_mm", "jitter_mm"})
    if (table.has(key))
      return table.reject(key, "contradicts targets_mm; give only one of the two keys");
  auto& targets_mm = options.targets_mm = table.numbers("targets_mm");
  if (targets_mm.empty() || targets_mm.size() > kMostTargets)
    return table.reject("targets_mm",
                        "must list from 1 to " + text_of(kMostTargets) + " positions");
  for (std::size_t i = 0; i < targets_mm.size(); ++i) {
    if (!(std::abs(targets_mm[i]) <= kLongest_mm))
      return table.reject("targets_mm", "must contain positions from -" + text_of(kLongest_mm) +
                                            " to " + text_of(kLongest_mm));
    if (i > 0 && !(targets_mm[i] > targets_mm[i - 1]))
      return table.reject("targets_mm", "must contain increasing positions");
  }
}

void read_motion(TomlTable& table, SimulatorOptions& options) {
  read(table, "overrun_mm", options.overrun_mm, 0, 1000);
  const std::int64_t repeats = table.integer("repeats", options.repeats);
  if (repeats < 1 || repeats > 1'000'000) table.reject("repeats", "must be from 1 to 1000000");
  options.repeats = static_cast<int>(repeats);
  read(table, "dwell_s", options.dwell_s, 0, 3600);
  read(table, "speed_mm_s", options.speed_mm_s, 0.001, 10'000);
  read(table, "acceleration_mm_s2", options.acceleration_mm_s2, 0.1, 1e6);
  read(table, "settle_um", options.settle_um, 0, 1000);
  read(table, "settle_hz", options.settle_hz, 0, 10'000);
  read(table, "settle_s", options.settle_s, 0, 10);
}

NamedError read_error(TomlTable table) {
  NamedError error;
  error.name = table.string("name");
  const bool angle = error.name.size() > 1 && error.name[1] >= 'A' && error.name[1] <= 'C';
  const std::string unit = angle ? "_urad" : "_um";
  read(table, "amplitude" + unit, error.amplitude, 0, 1000);
  read(table, "period_mm", error.period_mm, 0.01, 1e6);
  read(table, "phase_turns", error.phase_turns, -1, 1);
  read(table, "slope" + unit + "_per_mm", error.slope_per_mm, -1000, 1000);
  read(table, "reversal" + unit, error.reversal, -1000, 1000);
  return error;
}

Bursts read_bursts(TomlTable& parent, std::string_view key) {
  Bursts bursts;
  auto table = parent.table(key);
  if (!table) return bursts;
  read(*table, "probability", bursts.probability, 0, 1);
  read(*table, "length_s", bursts.length_s, 1e-4, 3600);
  return bursts;
}

Interval read_interval(TomlTable& table) {
  Interval interval;
  interval.from_s = table.number("from_s");
  interval.to_s = table.number("to_s");
  if (!(interval.from_s >= 0)) table.reject("from_s", "must be 0 or greater");
  if (!(interval.to_s > interval.from_s && interval.to_s <= kLongest_s))
    table.reject("to_s", "must be greater than from_s and at most " + text_of(kLongest_s));
  return interval;
}

void read_faults(TomlTable& table, SimulatorOptions& options) {
  read(table, "spike_probability", options.spike_probability, 0, 1);
  read(table, "spike_um", options.spike_um, 0, 10'000);
  options.saturation = read_bursts(table, "saturation");
  options.gap = read_bursts(table, "gap");
  for (TomlTable lost : table.tables("lost"))
    options.lost.push_back({lost.string("probe"), read_interval(lost)});
  for (TomlTable gone : table.tables("disconnect"))
    options.disconnects.push_back(read_interval(gone));
}

// Amplitudes, periods and slopes of a plausible small machine, in the order of error_names().
std::vector<NamedError> plausible_errors(Axis axis) {
  const NamedError plausible[] = {{"", 1.5, 60, 0.0, 0.02, 0.3},
                                  {"", 2.0, 45, 0.2, -0.01, 0.2},
                                  {"", 8.0, 50, 0.1, 0.05, 1.0},
                                  {"", 12.0, 70, 0.3, 0.1, 1.5},
                                  {"", 15.0, 55, 0.6, -0.1, 2.0}};
  std::vector<NamedError> errors(std::begin(plausible), std::end(plausible));
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i].name = error_names(axis)[i].name;
  return errors;
}

std::string names_of(Axis axis) {
  std::string list;
  for (const ErrorName& name : error_names(axis)) list += std::string(" ") + name.name;
  return list;
}

// Returns the errors in the order of error_names(). Errors that are not given are zero.
Result<std::vector<NamedError>> in_order(const std::vector<NamedError>& given, Axis axis) {
  std::vector<NamedError> ordered(kErrorCount);
  for (const NamedError& error : given) {
    const auto& names = error_names(axis);
    const auto name = std::find_if(names.begin(), names.end(),
                                   [&](const ErrorName& n) { return n.name == error.name; });
    if (name == names.end())
      return bad_input("[[error]] name \"" + error.name + "\" is not an error of axis " +
                       letter(axis) + "; the errors of this axis are" + names_of(axis));
    NamedError& place = ordered[static_cast<std::size_t>(name - names.begin())];
    if (!place.name.empty())
      return bad_input("[[error]] name \"" + error.name +
                       "\" is given twice; remove one of the two");
    place = error;
  }
  return ordered;
}

}  // namespace

Status read_options(TomlTable& table, SimulatorOptions& options) {
  read(table, "rate_hz", options.rate_hz, 1, 10'000);
  read(table, "packet_ms", options.packet_ms, 0.1, 1000);
  options.real_time = read_choice(table, "pace", "real-time", "fast", options.real_time);
  options.loop = table.boolean("loop", options.loop);
  options.seed = table.integer("seed", options.seed);
  read_targets(table, options);
  read_motion(table, options);
  for (TomlTable& error : table.tables("error")) options.errors.push_back(read_error(error));
  read(table, "noise_um", options.noise_um, 0, 1000);
  read(table, "encoder_noise_nm", options.encoder_noise_nm, 0, 1e6);
  read(table, "encoder_resolution_nm", options.encoder_resolution_nm, 0, 1e6);
  read_faults(table, options);
  return table.finish();
}

Status fit_to_rig(SimulatorOptions& options, const Rig& rig) {
  if (options.targets_mm.empty()) options.targets_mm = spaced_targets_mm({});
  if (options.errors.empty()) options.errors = plausible_errors(rig.axis);
  MDOF_TRY(options.errors, in_order(options.errors, rig.axis));
  for (const LostProbe& lost : options.lost)
    if (!rig.probe_index(lost.probe))
      return bad_input("[[lost]] probe \"" + lost.probe + "\" is not in the rig \"" + rig.name +
                       "\"");
  return {};
}

}  // namespace mdof::drivers
