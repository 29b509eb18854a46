#include <algorithm>
#include <cmath>

#include "daemon/output/controllers/error_rows.h"
#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/text_lines.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr std::size_t kMostOfLec = 200, kMostBefore = 20'000;
constexpr double kSameStep_m = 1e-9;

struct EqualSteps {
  double first_m = 0, step_m = 0;
  std::vector<double> error;  // mean of both approaches
  double loss_m = 0;          // at a point of the table, by resampling
};

double error_at(const EqualSteps& e, double at_m) {
  const double place =
      std::clamp((at_m - e.first_m) / e.step_m, 0.0, static_cast<double>(e.error.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), e.error.size() - 2);
  return e.error[i] + (e.error[i + 1] - e.error[i]) * (place - static_cast<double>(i));
}

// As many steps as the smallest of the table asks for; steps of whole nanometres, as they are
// written.
EqualSteps equal_steps(const Series& s) {
  const auto& x = s.position_m;
  const double range = x.back() - x.front();
  double smallest = range;
  for (std::size_t i = 1; i < x.size(); ++i) smallest = std::min(smallest, x[i] - x[i - 1]);
  const double wanted = std::min(std::round(range / smallest), static_cast<double>(kMostOfLec - 1));
  EqualSteps e;
  e.first_m = std::round(x.front() / kSameStep_m) * kSameStep_m;
  e.step_m = std::round(range / std::max(wanted, 1.0) / kSameStep_m) * kSameStep_m;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(std::max(wanted, 1.0)); ++i)
    e.error.push_back(mean_error_at(s, e.first_m + static_cast<double>(i) * e.step_m));
  for (const double at : x)
    e.loss_m = std::max(e.loss_m, std::abs(error_at(e, at) - mean_error_at(s, at)));
  return e;
}

std::string lec_text(const CompensationTable& table, const Series& s, const EqualSteps& e,
                     const ExportOptions& options) {
  const std::string axis = "AX" + std::to_string(static_cast<int>(table.axis) + 1);
  const std::string of = "[0," + axis + "]=";
  std::string text;
  for (const std::string& line :
       head_lines(table, options,
                  "mm; value = +" + s.error +
                      ", mean of both approaches; a positive value moves the "
                      "axis in the negative direction"))
    text += "; " + line + "\n";
  text += "; " + axis + " is taken for the machine axis " + s.along +
          ". Load with MD32700 = 0, then enable and reset; the axis must be referenced.\n"
          "CHANDATA(1)\n";
  for (std::size_t i = 0; i < e.error.size(); ++i)
    text += "$AA_ENC_COMP[0," + std::to_string(i) + "," + axis +
            "]=" + fixed(to_mm(e.error[i]), 6) + "\n";
  const double last_m = e.first_m + e.step_m * static_cast<double>(e.error.size() - 1);
  return text + "$AA_ENC_COMP_STEP" + of + fixed(to_mm(e.step_m), 6) + "\n$AA_ENC_COMP_MIN" + of +
         fixed(to_mm(e.first_m), 6) + "\n$AA_ENC_COMP_MAX" + of + fixed(to_mm(last_m), 6) +
         "\n$AA_ENC_COMP_IS_MODULO" + of + "0\nM17\n";
}

// "$KEY[...]=number" of a line that begins so; nothing: it does not.
std::optional<double> assigned(std::string_view line, const std::string& to) {
  if (!line.starts_with(to + "=")) return std::nullopt;
  return decimal_from(line.substr(to.size() + 1));
}

Result<AppliedCorrection> read_lec_file(const ControllerFile& file) {
  const char letter_of_axis = file.name.at(0);
  const std::string axis = std::string("AX") + static_cast<char>('1' + (letter_of_axis - 'X'));
  AppliedCorrection read{
      {'E', letter_of_axis, letter_of_axis}, letter_of_axis, letter_of_axis, {}, {}, {}};
  auto lines = lines_of(file.text);
  std::erase_if(lines, [](std::string_view line) { return line.starts_with(";"); });
  std::size_t at = 0;
  if (lines.empty() || lines[at++] != "CHANDATA(1)")
    return bad_input(file.name + ": does not begin with CHANDATA(1)");
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
    if (!value) return bad_input(file.name + ": $AA_ENC_COMP_" + keys[k] + " is expected");
    figures[k] = *value;
  }
  const auto n = static_cast<double>(read.forward.size());
  if (at + 1 != lines.size() || lines[at] != "M17" || n < 2 || n > kMostOfLec || figures[3] != 0 ||
      std::abs(figures[1] + figures[0] * (n - 1) - figures[2]) > 1e-7)
    return bad_input(file.name + ": points, step, MIN and MAX do not fit, or M17 is not its end");
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
  ExportOptions as_measured = options;
  as_measured.tolerance_m = 0;
  if (options.tolerance_m > 0)
    out.notes.emplace_back("--tolerance-um is of no effect: the points stand at equal steps");
  for (const CompensationTable& table : tables) {
    MDOF_TRY(const Series s, positioning_of(table, kMostBefore, as_measured, "ENC_COMP", out));
    const EqualSteps e = equal_steps(s);
    double reversal = 0;
    for (std::size_t i = 0; i < s.position_m.size(); ++i)
      reversal = std::max(reversal, std::abs(s.forward[i] - s.reverse[i]));
    if (reversal > 0)
      out.left_out.push_back(s.error + ": a reversal of up to " + plain_number(to_um(reversal)) +
                             " um: ENC_COMP has one value for both approaches, their mean");
    if (e.loss_m > kSameStep_m)
      out.notes.push_back(s.error + ": " + std::to_string(s.position_m.size()) + " points became " +
                          std::to_string(e.error.size()) + " at equal steps of " +
                          plain_number(to_mm(e.step_m), 7) + " mm, by which up to " +
                          plain_number(to_um(e.loss_m)) + " um are lost");
    out.written.back().points = e.error.size();
    out.written.back().largest_deviation = e.loss_m;
    out.files.push_back({std::string(1, s.along) + "_EEC.INI", lec_text(table, s, e, options)});
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
