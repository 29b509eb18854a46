#include "daemon/output/controllers/siemens/siemens_cec.h"

#include <algorithm>
#include <cmath>

#include "algo/compensation/volumetric/separable.h"
#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/siemens/siemens_lines.h"
#include "daemon/output/controllers/siemens/siemens_steps.h"
#include "daemon/output/controllers/text_lines.h"
#include "daemon/output/controllers/volume_files.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr std::size_t kTablesOf828D = 8;
constexpr double kSamePlace_m = 1e-10;
constexpr const char* kFile = "NC_CEC.INI";
constexpr const char* kHead = "%_N_NC_CEC_INI";

// One CEC table of the control.
struct CecTable {
  char input = 'X', output = 'X';
  int direction = 0;  // direction of the input axis: 1 positive, -1 negative, 0 both
  double first_m = 0, step_m = 0;
  std::vector<double> correction_m;  // the correction, or one factor of a product
  std::size_t multiply_by = 0;       // index + 1 of the table with the other factor; 0: no product
};

constexpr int kDecimalsOfAxis = 6;  // mm
// Decimals of a value in mm if the CEC tables are made from a volumetric table. More decimals are
// needed than for the table of one axis, because the control adds about ten values.
constexpr int kDecimalsOfVolume = 9;

std::string cec_text(std::size_t t, const CecTable& table, const std::string& error,
                     int decimals = kDecimalsOfAxis) {
  const std::string index = "[" + std::to_string(t) + "]=";
  std::string text = "; " + error + "\n";
  for (std::size_t i = 0; i < table.correction_m.size(); ++i)
    text += "$AN_CEC[" + std::to_string(t) + "," + std::to_string(i) +
            "]=" + fixed(to_mm(table.correction_m[i]), decimals) + "\n";
  const double last_m =
      table.first_m + table.step_m * static_cast<double>(table.correction_m.size() - 1);
  return text + "$AN_CEC_INPUT_AXIS" + index + "(" + siemens_axis(table.input) +
         ")\n$AN_CEC_OUTPUT_AXIS" + index + "(" + siemens_axis(table.output) + ")\n$AN_CEC_STEP" +
         index + fixed(to_mm(table.step_m), decimals) + "\n$AN_CEC_MIN" + index +
         fixed(to_mm(table.first_m), decimals) + "\n$AN_CEC_MAX" + index +
         fixed(to_mm(last_m), decimals) + "\n$AN_CEC_DIRECTION" + index +
         std::to_string(table.direction) + "\n$AN_CEC_MULT_BY_TABLE" + index +
         std::to_string(table.multiply_by) + "\n$AN_CEC_IS_MODULO" + index + "0\n";
}

CecTable table_of(const Series& s, const EqualSteps& e, const std::vector<double>& errors,
                  int direction) {
  CecTable table{s.along, s.command, direction, e.first_m, e.step_m, {}, 0};
  for (const double error : errors) table.correction_m.push_back(s.factor * error);
  return table;
}

// Writes the errors of one compensation table. `t` is the number of the next CEC table.
Status add_errors(const CompensationTable& table, const ExportOptions& options, Export& out,
                  std::string& text, std::size_t& t) {
  const std::string of_table = " of table " + std::to_string(table.id) + ": ";
  const std::size_t before = t;
  std::string gap;
  for (const Series& measured : series_of(table)) {
    if (measured.angle || measured.factor == 0) {
      if (!measured.angle) gap = measured.error + ": " + measured.gap;
      out.left_out.push_back(measured.error + of_table +
                             (measured.angle ? "the effect of an angle depends on a lever arm, but "
                                               "a CEC table uses the position of one axis only"
                                             : measured.gap));
      continue;
    }
    MDOF_TRY(const Series s, fitted(measured, table.id, kResamplingPointLimit, options, out));
    MDOF_TRY(const EqualSteps e, equal_steps(s, options, out));
    const bool both = e.forward == e.reverse;
    text += cec_text(t++, table_of(s, e, e.forward, both ? 0 : 1), s.error);
    if (!both) text += cec_text(t++, table_of(s, e, e.reverse, -1), s.error);
    if (s.along == s.command) continue;
    const std::string axes = std::string("the squareness of ") + s.along + " and " + s.command;
    out.notes.push_back(s.error + ": " +
                        (table.slope_removed
                             ? "the CEC table does not contain " + axes
                             : "the CEC table contains the slope of the straightness, which is "
                               "part of " +
                                   axes + "; do not correct this squareness again"));
    text += (table.slope_removed ? "; NOT IN THIS FILE: " : "; ") + out.notes.back() + "\n";
  }
  if (t == before)
    return bad_input("table " + std::to_string(table.id) +
                     " contains no error that CEC can store. CEC stores positioning errors, and "
                     "straightness errors if the sign of the correction is known" +
                     (gap.empty() ? "" : "; " + gap));
  return {};
}

// The axis in a text such as "(AX2)"; nullopt: another text.
std::optional<char> axis_in(const std::optional<std::string_view>& text) {
  for (const char axis : {'X', 'Y', 'Z'})
    if (text && *text == "(" + siemens_axis(axis) + ")") return axis;
  return std::nullopt;
}

Result<CecTable> read_table(SiemensLines& lines, std::size_t t) {
  const std::string index = "[" + std::to_string(t) + "]";
  CecTable table;
  while (const auto x = lines.number("$AN_CEC[" + std::to_string(t) + "," +
                                     std::to_string(table.correction_m.size()) + "]"))
    table.correction_m.push_back(from_mm(*x));
  const auto input = axis_in(lines.value("$AN_CEC_INPUT_AXIS" + index));
  if (!input) return lines.expected("$AN_CEC_INPUT_AXIS" + index);
  const auto output = axis_in(lines.value("$AN_CEC_OUTPUT_AXIS" + index));
  if (!output) return lines.expected("$AN_CEC_OUTPUT_AXIS" + index);
  double figures[6] = {};
  const char* const keys[] = {"STEP", "MIN", "MAX", "DIRECTION", "MULT_BY_TABLE", "IS_MODULO"};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto x = lines.number(std::string("$AN_CEC_") + keys[k] + index);
    if (!x) return lines.expected(std::string("$AN_CEC_") + keys[k] + index);
    figures[k] = *x;
  }
  const std::size_t n = table.correction_m.size();
  const double last = figures[1] + figures[0] * (static_cast<double>(n) - 1);
  if (n < 2 || n > kResamplingPointLimit || std::abs(last - figures[2]) > 1e-6 || figures[4] < 0 ||
      figures[5] != 0)
    return lines.expected("a table of 2 to " + std::to_string(kResamplingPointLimit) +
                          " points with MAX = MIN + (points - 1) * STEP, MULT_BY_TABLE 0 or more "
                          "and IS_MODULO 0");
  table.input = *input;
  table.output = *output;
  table.step_m = from_mm(figures[0]);
  table.first_m = from_mm(figures[1]);
  table.direction = static_cast<int>(figures[3]);
  table.multiply_by = static_cast<std::size_t>(figures[4]);
  return table;
}

AppliedCorrection applied_by(const CecTable& table) {
  AppliedCorrection applied{
      {'E', table.output, table.input}, table.input, table.output, {}, {}, {}};
  for (std::size_t i = 0; i < table.correction_m.size(); ++i)
    applied.position_m.push_back(table.first_m + table.step_m * static_cast<double>(i));
  const std::vector<double> none(table.correction_m.size(), 0.0);
  applied.forward = table.direction >= 0 ? table.correction_m : none;
  applied.reverse = table.direction <= 0 ? table.correction_m : none;
  return applied;
}

// Adds `more` to the correction of the same error, if there is one, as the control does. All tables
// of one error have the same positions.
bool add_to(std::vector<AppliedCorrection>& all, const AppliedCorrection& more) {
  for (AppliedCorrection& one : all) {
    if (one.error != more.error) continue;
    if (one.position_m.size() != more.position_m.size() ||
        std::abs(one.position_m.back() - more.position_m.back()) > kSamePlace_m)
      return false;
    for (std::size_t i = 0; i < one.position_m.size(); ++i) {
      one.forward[i] += more.forward[i];
      one.reverse[i] += more.reverse[i];
    }
    return true;
  }
  all.push_back(more);
  return true;
}

Result<std::vector<CecTable>> read_tables(const std::vector<ControllerFile>& files) {
  const ControllerFile* file = find_file(files, kFile);
  if (!file) return bad_input(std::string(kFile) + ": the file is missing");
  SiemensLines lines(*file);
  if (!lines.take(kHead)) return lines.expected(kHead);
  if (!lines.take("CHANDATA(1)")) return lines.expected("CHANDATA(1)");
  std::vector<CecTable> tables;
  while (!lines.take("M17")) {
    MDOF_TRY(CecTable table, read_table(lines, tables.size()));
    tables.push_back(std::move(table));
  }
  if (!lines.at_end()) return lines.expected("the end of the file after M17");
  for (const CecTable& table : tables)
    if (table.multiply_by > tables.size())
      return bad_input(std::string(kFile) + ": $AN_CEC_MULT_BY_TABLE refers to table " +
                       std::to_string(table.multiply_by) + ", but the file has " +
                       std::to_string(tables.size()) + " tables");
  return tables;
}

std::string file_text(const std::string& head, const std::string& tables) {
  return std::string(kHead) + "\n" + head +
         "; AX1, AX2, AX3 are assumed to be the machine axes X, Y, Z. Load this file with\n"
         "; MD32710 = 0. Then set MD32710 = 1 for each output axis and SD41300 = 1 for each\n"
         "; table, and reset the control. The input axes must be referenced.\n" +
         kMetricOnly + "CHANDATA(1)\n" + tables + "M17\n";
}

// Error: the number of tables exceeds the limit that the user stated for the control. If the user
// stated no limit, adds a note with the limit of an 828D.
Status check_count(std::size_t tables, const ExportOptions& options, Export& out) {
  const std::string count = std::to_string(tables) + " CEC tables are needed, but ";
  if (options.siemens_tables > 0 && tables > options.siemens_tables)
    return bad_input(count + "the control has " + std::to_string(options.siemens_tables) +
                     " (option siemens-tables); export the tables of fewer axes");
  if (options.siemens_tables == 0 && tables > kTablesOf828D)
    out.notes.push_back(count + "an 828D allows only " + std::to_string(kTablesOf828D) +
                        "; on other controls MD18342 sets the limit");
  return {};
}

// Comment lines with the omitted errors; the file itself must state the omitted errors.
std::string left_out_lines(const Export& out) {
  std::string text;
  for (const std::string& left : out.left_out)
    text += "; NOT IN THIS FILE: " + plain_ascii_line(left) + "\n";
  return text;
}

}  // namespace

Result<Export> write_cec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options) {
  MDOF_CHECK(check_no_error_twice(tables));
  Export out;
  const ExportOptions as_measured = without_tolerance(options, out);
  if (!options.homes.empty())
    out.notes.emplace_back(
        "home_mm has no effect, because mdof does not shift the corrections in CEC tables to 0 at "
        "the home position");
  std::string head, text;
  std::size_t t = 0;
  for (const CompensationTable& table : tables) {
    for (const std::string& line : head_lines(
             table, options,
             "values in mm; value = correction that is added to the command of the output axis"))
      head += "; " + line + "\n";
    MDOF_CHECK(add_errors(table, as_measured, out, text, t));
  }
  MDOF_CHECK(check_count(t, options, out));
  out.files.push_back({kFile, file_text(head + left_out_lines(out), text)});
  return out;
}

Result<std::vector<AppliedCorrection>> read_cec(const std::vector<ControllerFile>& files) {
  MDOF_TRY(const auto tables, read_tables(files));
  std::vector<AppliedCorrection> all;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const std::string place = std::string(kFile) + ": table " + std::to_string(t) + ": ";
    if (tables[t].multiply_by != 0)
      return bad_input(place + "$AN_CEC_MULT_BY_TABLE must be 0 in a correction of single axes");
    if (!add_to(all, applied_by(tables[t])))
      return bad_input(place +
                       "the positions differ from those in the earlier table of the same axes");
  }
  return all;
}

namespace {

constexpr std::string_view kLinearAxes = "XYZ";
// Accuracy with which the sum of products represents a correction that depends on two axes
// together.
constexpr double kProductAccuracy_m = 2e-9;

// Converts factors in √m to the numbers in the file. The product of two such numbers is in mm.
std::vector<double> factor_numbers(std::vector<double> factor) {
  for (double& x : factor) x *= std::sqrt(1e-3);
  return factor;
}

double largest_factor(const std::vector<CecTable>& tables) {
  double most = 0;
  for (std::size_t i = 0; i < tables.size(); ++i)
    if (tables[i].multiply_by > 0)
      for (const double x : tables[i].correction_m) most = std::max(most, std::abs(x));
  return most;
}

// Adds the CEC tables of one output axis.
void add_correction(const VolumetricTable& t, const std::array<double, 3>& step_m, char output,
                    const algo::SeparableCorrection& sum, std::vector<CecTable>& tables) {
  const auto add = [&](std::size_t axis, const std::vector<double>& values, bool multiply) {
    tables.push_back({kLinearAxes[axis], output, 0, t.command_m[axis].front(), step_m[axis], values,
                      multiply ? tables.size() + 2 : 0});
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!sum.along[axis].empty()) add(axis, sum.along[axis], false);
  for (const algo::AxisProduct& product : sum.products) {
    add(product.first, factor_numbers(product.of_first), true);
    add(product.second, factor_numbers(product.of_second), false);
  }
}

// The positions of the nodes along an axis. All CEC tables with this input axis have the same
// positions.
Result<std::vector<double>> node_commands(const std::vector<CecTable>& tables, char axis) {
  std::vector<double> commands;
  for (const CecTable& table : tables) {
    if (table.input != axis) continue;
    std::vector<double> own;
    for (std::size_t i = 0; i < table.correction_m.size(); ++i)
      own.push_back(table.first_m + table.step_m * static_cast<double>(i));
    if (!commands.empty() && commands != own)
      return bad_input(std::string(kFile) + ": the tables of axis " + axis +
                       " have different positions");
    commands = std::move(own);
  }
  if (commands.empty()) commands = {0};
  return commands;
}

// The correction that the control applies at a node: the sum of all tables and products. A table
// that is the second factor of a product is not a summand itself.
Vec3 sum_at(const std::vector<CecTable>& tables, const std::array<std::size_t, 3>& index) {
  const auto value = [&](const CecTable& table) {
    return table.correction_m[index[kLinearAxes.find(table.input)]];
  };
  std::vector<bool> is_factor(tables.size(), false);
  for (const CecTable& table : tables)
    if (table.multiply_by > 0) is_factor[table.multiply_by - 1] = true;
  Vec3 sum{};
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (is_factor[t]) continue;
    const std::size_t by = tables[t].multiply_by;
    // In the file, the product of the two numbers is in mm.
    const double factor = by > 0 ? to_mm(value(tables[by - 1])) : 1;
    sum[kLinearAxes.find(tables[t].output)] += value(tables[t]) * factor;
  }
  return sum;
}

}  // namespace

Result<Export> write_cec_volume(const VolumetricTable& t, const ExportOptions& options) {
  Export out;
  note_options(options, out);
  std::array<double, 3> step_m{};
  for (const std::size_t axis : grid_axes(t)) {
    MDOF_TRY(step_m[axis], equal_step(t, axis, "CEC"));
    if (t.command_m[axis].size() > most_points(options))
      return bad_input(
          "table " + std::to_string(t.id) + ": " + std::to_string(t.command_m[axis].size()) +
          " positions of " + kLinearAxes[axis] + ", but a CEC table has at most " +
          std::to_string(most_points(options)) +
          " points; build a table with larger steps, or state the limit of the control "
          "(option siemens-points)");
  }
  std::vector<CecTable> tables;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!t.machine.find(kLinearAxes[k])) continue;
    const auto sum = algo::separate(t, k, kProductAccuracy_m);
    out.left_m = std::max(out.left_m, sum.left_m);
    add_correction(t, step_m, kLinearAxes[k], sum, tables);
  }
  std::string text;
  for (std::size_t i = 0; i < tables.size(); ++i)
    text += cec_text(i, tables[i],
                     tables[i].multiply_by > 0 ? "first factor of a product"
                     : i > 0 && tables[i - 1].multiply_by > 0
                         ? "second factor of the product"
                         : std::string("correction of ") + tables[i].output +
                               " by the position of " + tables[i].input,
                     kDecimalsOfVolume);
  auto head =
      head_of(t, options,
              "values in mm; value = correction that is added to the command of the output axis");
  out.notes.push_back(
      "the correction is written as sums and products of one-axis tables; largest residual: " +
      plain_number(to_um(out.left_m), 2) + " um");
  if (std::any_of(tables.begin(), tables.end(),
                  [](const CecTable& one) { return one.multiply_by > 0; })) {
    out.notes.emplace_back(
        "products (MULT_BY_TABLE): in the example of the manual, the control adds the product of "
        "two tables, but not the two tables themselves. Check this on the machine: if the control "
        "also adds the tables themselves, each table adds up to " +
        plain_number(to_um(largest_factor(tables)), 2) + " um");
    head.push_back(out.notes.back());
  }
  out.files.push_back({kFile, file_text(commented(head, ";"), text)});
  MDOF_CHECK(check_count(tables.size(), options, out));
  count_nodes(t, out);
  return out;
}

Result<VolumetricTable> read_cec_volume(const std::vector<ControllerFile>& files) {
  MDOF_TRY(const auto tables, read_tables(files));
  VolumetricTable t;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    MDOF_TRY(t.command_m[axis], node_commands(tables, kLinearAxes[axis]));
  }
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const std::size_t nx = t.command_m[0].size(), ny = t.command_m[1].size();
    t.correction_m.push_back(sum_at(tables, {node % nx, node / nx % ny, node / (nx * ny)}));
  }
  t.u_m.assign(t.nodes(), Vec3{});
  return t;
}

}  // namespace mdof::controllers
