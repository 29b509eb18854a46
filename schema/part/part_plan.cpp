#include "schema/part/part_plan.h"

#include <charconv>
#include <cmath>

#include "schema/base/toml/toml_reader.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr const char* kLayers[] = {"axes", "budget", "form", "milling"};

bool needs_source(const std::string& layer) {
  return layer == "form" || layer == "milling";
}

// The value is `layer = true`, `layer = "file"`, or a table { from = "file", on = true, compensated
// = false }.
void read_layer(TomlTable& layers, PartLayer& layer) {
  const std::string& key = layer.name;
  if (layers.is_table(key)) {
    TomlTable table = *layers.table(key);
    if (table.is_array("from"))
      layer.from = table.strings("from");
    else if (table.has("from"))
      layer.from = {table.string("from")};
    layer.on = table.boolean("on", true);
    layer.compensated = table.boolean("compensated", false);
    if (key == "form" && table.has("u_um")) {
      layer.u_m = from_um(table.number("u_um"));
      if (!(*layer.u_m >= 0 && std::isfinite(*layer.u_m)))
        table.reject("u_um", "must be 0 or greater");
    }
  } else if (layers.is_array(key)) {
    layer.from = layers.strings(key);
  } else if (layers.is_string(key)) {
    layer.from = {layers.string(key)};
  } else if (layers.is_boolean(key) || !needs_source(key)) {
    layer.on = layers.boolean(key);
  }
  if (needs_source(key) && layer.on && layer.from.size() != 1)
    layers.reject(key, "needs one file, such as " + key + " = \"" +
                           (key == "form" ? "clamp.csv" : "plan.toml") + "\"");
  if (key == "budget" && !layer.from.empty())
    layers.reject(key, "must be true or false; the error sources are listed in the machine file");
  for (const std::string& from : layer.from)
    if (key == "axes" && !table_number(from))
      layers.reject(key, "is \"" + from +
                             "\", but must be true (mdof then uses the errors of the machine file) "
                             "or a list of stored tables, such as \"table:12\"");
}

}  // namespace

std::optional<std::int64_t> table_number(std::string_view from) {
  constexpr std::string_view kBegin = "table:";
  if (!from.starts_with(kBegin)) return {};
  from.remove_prefix(kBegin.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), number);
  if (error != std::errc() || end != from.data() + from.size() || number < 1) return {};
  return number;
}

Result<PartPlan> parse_part_plan(std::string_view text, const std::string& source) {
  MDOF_TRY(TomlTable root, TomlTable::parse(text, source));
  PartPlan plan;
  plan.name = root.string("name", "");
  plan.machine = root.string("machine");
  plan.path = root.string("path");
  auto layers = root.table("layers");
  if (!layers)
    root.reject("layers",
                "table [layers] is missing; add it with at least one of the keys axes, budget, "
                "form and milling");
  for (const char* name : kLayers) {
    if (!layers || !layers->has(name)) continue;
    PartLayer layer{name, {}, true, false, {}};
    read_layer(*layers, layer);
    // Another form of the switch: axes_on = false.
    const std::string on = std::string(name) + "_on";
    if (layers->has(on)) layer.on = layers->boolean(on);
    plan.layers.push_back(layer);
  }
  MDOF_CHECK(root.finish());
  bool any = false;
  for (const PartLayer& layer : plan.layers) any = any || layer.on;
  if (!any)
    return bad_input(
        source + ": all layers are off; switch on at least one of axes, budget, form and milling");
  return plan;
}

}  // namespace mdof
