#include "daemon/output/controllers/table_json.h"

#include <simdjson.h>

#include <cmath>

#include "daemon/output/controllers/series.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

using simdjson::dom::element;

std::string document_of(const CompensationTable& table, const ExportOptions& options) {
  JsonWriter json;
  json.begin_object().field("format", "mdof compensation table").field("version", 1);
  json.key("marks").begin_array();
  for (const std::string& mark : options.marks) json.value(mark);
  json.end_array().key("table").raw(table_json(table)).end_object();
  return json.take() + "\n";
}

// Returns NaN if `of` has no number with this key. `of`: a JSON element, or a simdjson result that
// may be an error.
template <class Of>
double number_of(const Of& of, const std::string& key) {
  double x = std::nan("");
  return of[key].get(x) == simdjson::SUCCESS ? x : std::nan("");
}

Result<AppliedCorrection> correction_of(const element& table, const std::string& key,
                                        const element& rule, const std::string& file) {
  std::string_view axis, command;
  if (table["axis"].get(axis) != simdjson::SUCCESS || axis.size() != 1 ||
      rule["command"].get(command) != simdjson::SUCCESS || command.size() != 1)
    return bad_input(file + ": " + key +
                     ": the key \"axis\" of the table or the key \"command\" of this correction is "
                     "missing or wrong");
  const double factor = number_of(rule, "factor");
  AppliedCorrection read{key.substr(0, key.find('_')), axis[0], command[0], {}, {}, {}};
  simdjson::dom::array points;
  if (table["points"].get(points) != simdjson::SUCCESS)
    return bad_input(file + ": the table has no points");
  for (const element& point : points) {
    const double forward = number_of(point["forward"], key);
    const double reverse = number_of(point["reverse"], key);
    if (!std::isfinite(forward) || !std::isfinite(reverse)) continue;  // null: the value is missing
    read.position_m.push_back(from_mm(number_of(point, "position_mm")));
    read.forward.push_back(factor * from_um(forward));
    read.reverse.push_back(factor * from_um(reverse));
  }
  return read;
}

Status read_document(const ControllerFile& file, std::vector<AppliedCorrection>& all) {
  simdjson::dom::parser parser;
  element table;
  simdjson::dom::object rules;
  std::string_view format;
  const auto json = parser.parse(simdjson::padded_string(file.text));
  if (json["format"].get(format) != simdjson::SUCCESS || format != "mdof compensation table" ||
      json["table"].get(table) != simdjson::SUCCESS ||
      table["correction"].get(rules) != simdjson::SUCCESS)
    return bad_input(file.name + ": the file is not a compensation table in JSON");
  for (const auto& rule : rules) {
    if (!std::isfinite(number_of(rule.value, "factor"))) continue;
    MDOF_TRY(AppliedCorrection read,
             correction_of(table, std::string(rule.key), rule.value, file.name));
    if (!read.position_m.empty()) all.push_back(std::move(read));
  }
  return {};
}

}  // namespace

Result<Export> write_table_json(const std::vector<CompensationTable>& tables,
                                const ExportOptions& options) {
  Export out;
  for (const CompensationTable& table : tables) {
    out.files.push_back(
        {"table-" + std::to_string(table.id) + ".json", document_of(table, options)});
    for (const Series& s : series_of(table))
      out.written.push_back({s.error, s.position_m.size(), s.position_m.size(), 0});
  }
  if (options.tolerance_m > 0 || options.cut_range || !options.homes.empty())
    out.notes.emplace_back(
        "the JSON contains the unchanged table; tolerance_um, cut_range and home_mm have no "
        "effect");
  return out;
}

Result<std::vector<AppliedCorrection>> read_table_json(const std::vector<ControllerFile>& files) {
  std::vector<AppliedCorrection> all;
  for (const ControllerFile& file : files) MDOF_CHECK(read_document(file, all));
  return all;
}

}  // namespace mdof::controllers
