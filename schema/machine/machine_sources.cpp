#include "schema/machine/machine_sources.h"

#include <algorithm>
#include <cmath>

#include "schema/units.h"

namespace mdof {
namespace {

constexpr double kLargestFactor = 1e9;

struct NamedError {
  std::string name;
  std::size_t frame = 0, k = 0;
  bool of_line = false;
};

std::vector<NamedError> errors_of(const Machine& machine) {
  std::vector<NamedError> all;
  for (std::size_t i = 0; i < machine.frames.size(); ++i) {
    const MachineFrame& frame = machine.frames[i];
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      all.push_back({error_name(frame, k), i, k, false});
      if (has_location(frame, k)) all.push_back({location_name(frame, k), i, k, true});
    }
  }
  return all;
}

double read_factor(TomlTable& table, const std::string& key) {
  const double factor = table.number(key);
  if (std::abs(factor) <= kLargestFactor) return factor;
  table.reject(key, "must be from -1e9 to 1e9; check the unit of the factor");
  return 0;
}

// Reads factor_per_mm for a linear axis, or factor_per_deg for a rotary axis.
void read_factor_per_position(TomlTable& table, const Machine& machine, SourceEffect& effect) {
  const std::string of = table.string("of");
  const MachineFrame* axis = machine.find(of);
  if (!axis || axis->kind == FrameKind::fixed) {
    table.reject("of", "\"" + of + "\" is not an axis of the chain " + machine.chain.text);
    return;
  }
  effect.of = static_cast<std::size_t>(axis - machine.frames.data());
  const std::string key = std::string("factor_per_") + position_unit(*axis);
  effect.factor_per_position = from_um(read_factor(table, key)) / position_from_written(*axis, 1);
}

SourceEffect read_effect(TomlTable& table, const Machine& machine,
                         const std::vector<NamedError>& errors) {
  SourceEffect effect;
  const std::string name = table.string("error");
  const auto found = std::find_if(errors.begin(), errors.end(),
                                  [&](const NamedError& e) { return e.name == name; });
  if (found == errors.end()) {
    std::vector<std::string> names;
    for (const NamedError& e : errors) names.push_back(e.name);
    const std::string near = nearest_candidate(name, names);
    table.reject("error", "this machine has no error \"" + name + "\"; " +
                              (near.empty() ? "give an error such as " + errors.front().name
                                            : "did you mean \"" + near + "\"?"));
    return effect;
  }
  effect.frame = found->frame;
  effect.k = found->k;
  effect.of_line = found->of_line;
  if (table.has("of")) read_factor_per_position(table, machine, effect);
  if (table.has("factor"))
    effect.factor = from_um(read_factor(table, "factor"));
  else if (!table.has("of"))
    table.reject(
        "factor",
        "is missing; give \"factor\" (the error in µm or µrad per unit of the source), or "
        "\"factor_per_mm\" (\"factor_per_deg\" for a rotary axis) together with \"of\" (the axis)");
  return effect;
}

SourceShape read_shape(TomlTable& table) {
  const std::string name = table.string("distribution", "normal");
  for (const SourceShape shape : {SourceShape::normal, SourceShape::rectangular,
                                  SourceShape::triangular, SourceShape::u_shaped})
    if (name == to_string(shape)) return shape;
  if (name == "uniform") return SourceShape::rectangular;
  if (name == "arcsine") return SourceShape::u_shaped;
  table.reject("distribution", "\"" + name +
                                   "\" is not a distribution; give \"normal\", \"rectangular\", "
                                   "\"triangular\" or \"u-shaped\"");
  return SourceShape::normal;
}

ErrorSource read_source(TomlTable& table, const Machine& machine,
                        const std::vector<NamedError>& errors) {
  ErrorSource source;
  source.name = table.string("name");
  if (source.name.empty()) table.reject("name", "must not be empty");
  for (const ErrorSource& other : machine.sources)
    if (other.name == source.name)
      table.reject("name",
                   "\"" + source.name + "\" is given twice; give each source a different name");
  for (const NamedError& error : errors)
    if (error.name == source.name)
      table.reject("name",
                   "\"" + source.name + "\" is the name of an error; give the source another name");
  source.unit = table.string("unit");
  if (source.unit.empty() || source.unit.size() > 16)
    table.reject("unit", "must be a word such as um, urad or deg");
  source.u = table.number("u");
  if (!(source.u >= 0))
    table.reject("u", "must be a standard uncertainty: a number of 0 or greater");
  source.shape = read_shape(table);
  for (TomlTable& effect : table.tables("acts_on"))
    source.acts_on.push_back(read_effect(effect, machine, errors));
  if (source.acts_on.empty())
    table.reject("acts_on",
                 "must list the errors that the source changes, such as "
                 "[{error = \"EXX\", factor = 1}]");
  return source;
}

}  // namespace

void read_sources(TomlTable& root, Machine& machine) {
  auto tables = root.tables("source");
  if (tables.empty()) return;
  const auto errors = errors_of(machine);
  for (TomlTable& table : tables) {
    ErrorSource source = read_source(table, machine, errors);
    machine.sources.push_back(std::move(source));
  }
}

}  // namespace mdof
