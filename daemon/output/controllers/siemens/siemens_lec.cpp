#include <algorithm>
#include <cmath>

#include "daemon/output/controllers/error_rows.h"
#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/siemens/siemens_steps.h"
#include "daemon/output/controllers/text_lines.h"
#include "daemon/words/words.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr const char* kLecHead = "%_N_AX_EEC_INI";
constexpr double kStepOfLec_m = 2e-9;  // resolution of the numbers in the file, with rounding

// The series with the mean of both approaches, because ENC_COMP has one value for both.
Series mean_of_approaches(Series s) {
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    s.forward[i] = s.reverse[i] = 0.5 * (s.forward[i] + s.reverse[i]);
  return s;
}

// Error: the mean of both approaches leaves a larger error than the self-test accepts, and the user
// did not set ExportOptions::one_approach.
Status check_reversal(const CompensationTable& table, const Series& s, const ExportOptions& options,
                      Export& out) {
  const double largest = largest_error_m(s);
  double reversal = 0;
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    reversal = std::max(reversal, std::abs(s.forward[i] - s.reverse[i]));
  if (!(reversal > 0)) return {};
  out.left_out.push_back(
      s.error + ": a reversal of up to " + plain_number(to_um(reversal)) +
      " um is not corrected, because ENC_COMP stores only the mean of both approaches");
  const double limit =
      algo::ResidualLimits{options.residual_m, options.residual_share}.of(largest, kStepOfLec_m);
  if (options.one_approach || reversal / 2 <= limit) return {};
  return bad_input("table " + std::to_string(table.id) + ": " + s.error +
                   " has a reversal of up to " + plain_number(to_um(reversal)) +
                   " um, but ENC_COMP stores one value for both approaches; " +
                   plain_number(to_um(reversal / 2)) + " um would remain in each approach (limit " +
                   plain_number(to_um(limit)) +
                   " um). Use a format with both approaches, or export the mean (option "
                   "one-approach) and set the "
                   "backlash compensation of the control (MD32450 BACKLASH)");
}

// Subtracts the correction at home from all values. The control activates ENC_COMP when the axis is
// referenced; if the value at this position were not 0, the axis would jump.
Series zeroed_at_home(Series s, const ExportOptions& options, Export& out) {
  const std::optional<double> home_m = options.home_m(s.along);
  const double there = mean_error_at(s, home_m.value_or(0.0));
  if (!home_m) {
    if (std::abs(there) > kStepOfLec_m)
      out.notes.push_back(s.error + ": the value at 0 mm is " + plain_number(to_um(there)) +
                          " um, so the axis jumps by " + plain_number(-to_um(there)) +
                          " um if its reference point is at 0 mm; " +
                          words::remedy(Remedy::give_home));
    return s;
  }
  out.notes.push_back(zeroed_at_home_note(s, "value", there, *home_m));
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    s.forward[i] -= there;
    s.reverse[i] -= there;
  }
  return s;
}

std::string lec_text(const CompensationTable& table, const Series& s, const EqualSteps& e,
                     const ExportOptions& options) {
  const std::string axis = siemens_axis(s.along);
  const std::string of = "[0," + axis + "]=";
  std::string text = std::string(kLecHead) + "\n";
  for (const std::string& line :
       head_lines(table, options,
                  "values in mm; value = +" + s.error +
                      ", mean of both approaches; a positive value moves the "
                      "axis in the negative direction"))
    text += "; " + line + "\n";
  text += "; " + axis + " is assumed to be the machine axis " + s.along +
          ".\n; Load this file with MD32700 = 0. Then set MD32700 = 1 and reset the control.\n"
          "; The axis must be referenced.\n" +
          kMetricOnly + "CHANDATA(1)\n";
  for (std::size_t i = 0; i < e.forward.size(); ++i)
    text += "$AA_ENC_COMP[0," + std::to_string(i) + "," + axis +
            "]=" + fixed(to_mm(e.forward[i]), 6) + "\n";
  return text + "$AA_ENC_COMP_STEP" + of + fixed(to_mm(e.step_m), 6) + "\n$AA_ENC_COMP_MIN" + of +
         fixed(to_mm(e.first_m), 6) + "\n$AA_ENC_COMP_MAX" + of + fixed(to_mm(e.last_m()), 6) +
         "\n$AA_ENC_COMP_IS_MODULO" + of + "0\nM17\n";
}

// The number in a line "$KEY[...]=number"; nullopt if the line does not begin with `to`.
std::optional<double> assigned(std::string_view line, const std::string& to) {
  if (!line.starts_with(to + "=")) return std::nullopt;
  return decimal_from(line.substr(to.size() + 1));
}

Result<AppliedCorrection> read_lec_file(const ControllerFile& file) {
  const char letter_of_axis = file.name.at(0);
  const std::string axis = siemens_axis(letter_of_axis);
  AppliedCorrection read{
      {'E', letter_of_axis, letter_of_axis}, letter_of_axis, letter_of_axis, {}, {}, {}};
  auto lines = lines_of(file.text);
  std::erase_if(lines, [](std::string_view line) { return line.starts_with(";"); });
  std::size_t at = 0;
  if (lines.size() < 2 || lines[at++] != kLecHead || lines[at++] != "CHANDATA(1)")
    return bad_input(file.name + ": the first lines must be " + kLecHead + " and CHANDATA(1)");
  for (; at < lines.size(); ++at) {
    const auto value = assigned(
        lines[at], "$AA_ENC_COMP[0," + std::to_string(read.forward.size()) + "," + axis + "]");
    if (!value) break;
    read.forward.push_back(-from_mm(*value));
  }
  double figures[4] = {};
  const char* const keys[] = {"STEP", "MIN", "MAX", "IS_MODULO"};
  for (std::size_t k = 0; k < 4; ++k, ++at) {
    const auto value =
        at < lines.size()
            ? assigned(lines[at], std::string("$AA_ENC_COMP_") + keys[k] + "[0," + axis + "]")
            : std::nullopt;
    if (!value)
      return bad_input(file.name + ": $AA_ENC_COMP_" + keys[k] + " with a number is expected");
    figures[k] = *value;
  }
  const auto n = static_cast<double>(read.forward.size());
  if (at + 1 != lines.size() || lines[at] != "M17" || n < 2 || n > kResamplingPointLimit ||
      figures[3] != 0 || std::abs(figures[1] + figures[0] * (n - 1) - figures[2]) > 1e-7)
    return bad_input(file.name + ": 2 to " + std::to_string(kResamplingPointLimit) +
                     " points are expected, with MAX = MIN + (points - 1) * STEP, IS_MODULO = 0 "
                     "and M17 as the last line");
  for (std::size_t i = 0; i < read.forward.size(); ++i)
    read.position_m.push_back(from_mm(figures[1] + figures[0] * static_cast<double>(i)));
  read.reverse = read.forward;
  return read;
}

}  // namespace

Result<Export> write_lec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options) {
  MDOF_CHECK(check_one_table_an_axis(tables));
  Export out;
  ExportOptions as_measured = without_tolerance(options, out);
  as_measured.homes.clear();  // zeroed_at_home() has already subtracted the value at home
  for (const CompensationTable& table : tables) {
    MDOF_TRY(const Series s,
             positioning_of(table, kResamplingPointLimit, as_measured, "ENC_COMP", out));
    const std::size_t told = out.left_out.size();
    MDOF_CHECK(check_reversal(table, s, as_measured, out));
    ExportOptions marked = options;
    for (std::size_t i = told; i < out.left_out.size(); ++i)
      marked.marks.push_back("REVERSAL NOT CORRECTED: " + out.left_out[i]);
    MDOF_TRY(const EqualSteps e,
             equal_steps(zeroed_at_home(mean_of_approaches(s), options, out), options, out));
    out.files.push_back({std::string(1, s.along) + "_EEC.INI", lec_text(table, s, e, marked)});
  }
  return out;
}

Result<std::vector<AppliedCorrection>> read_lec(const std::vector<ControllerFile>& files) {
  std::vector<AppliedCorrection> all;
  for (const ControllerFile& file : files) {
    MDOF_TRY(AppliedCorrection read, read_lec_file(file));
    all.push_back(std::move(read));
  }
  return all;
}

}  // namespace mdof::controllers
