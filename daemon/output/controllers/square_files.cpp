#include "daemon/output/controllers/square_files.h"

#include <cmath>

#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/text_lines.h"
#include "schema/base/number/number_text.h"
#include "schema/rig/correction.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr double kSide_mm = 100;
constexpr const char* kGcode = "skew.gcode";
constexpr const char* kHal = "skew.hal";

std::vector<std::string> head_of(const SquareAxes& axes, const ExportOptions& options) {
  const Budget& b = axes.budget;
  std::vector<std::string> lines{
      "squareness " + std::to_string(axes.id) +
          " of mdof: the angle from +X to +Y is 90 deg + EC0Y",
      "EC0Y " + plain_number(to_urad(axes.EC0Y_rad), 6) + " urad, U " +
          plain_number(to_urad(b.U), 3) + " urad (k " + plain_number(b.coverage_factor, 3) +
          ", 95 %); U contains " + plain_ascii_line(covers_text(b)),
      "the angle is valid at the " + reference_point_text(axes.at),
      "machine " + axes.machine.text + " (" + chain_travels_text(axes.machine) + ")"};
  for (const std::string& mark : options.marks) lines.push_back(plain_ascii_line(mark));
  return lines;
}

// Makes a file with comment lines for readers and one line for the controller.
Result<Export> exported(const SquareAxes& axes, const ExportOptions& options, const char* name,
                        const char* sign, const std::vector<std::string>& how,
                        const std::string& line) {
  Export out;
  if (options.tolerance_m > 0) out.notes.emplace_back("tolerance_um has no effect on an angle");
  if (!options.homes.empty()) out.notes.emplace_back("home_mm has no effect on an angle");
  std::vector<std::string> head = head_of(axes, options);
  head.insert(head.end(), how.begin(), how.end());
  out.files.push_back({name, commented(head, sign) + line + "\n"});
  return out;
}

// The text after `begin`, with which the commands of the file must begin, up to the end of its
// line.
Result<std::string_view> value_of(const std::vector<ControllerFile>& files, const char* name,
                                  char sign, std::string_view begin) {
  const ControllerFile* file = find_file(files, name);
  if (!file) return bad_input(std::string(name) + ": the file is missing");
  std::size_t n = 0;
  for (const std::string_view line : lines_of(file->text)) {
    ++n;
    if (line.starts_with(sign)) continue;
    const std::string_view rest =
        std::string_view(file->text)
            .substr(static_cast<std::size_t>(line.data() - file->text.data()));
    if (rest.starts_with(begin)) {
      const std::string_view value = rest.substr(begin.size());
      return value.substr(0, value.find('\n'));
    }
    return wrong_at(name, n, "a line that begins with \"" + std::string(begin) + "\" is expected");
  }
  return bad_input(std::string(name) + ": no line begins with \"" + std::string(begin) + "\"");
}

Result<double> number_of(const std::vector<ControllerFile>& files, const char* name, char sign,
                         std::string_view begin) {
  MDOF_TRY(const std::string_view text, value_of(files, name, sign, begin));
  if (const auto x = decimal_from(text)) return *x;
  return bad_input(std::string(name) + ": a number is expected after \"" + std::string(begin) +
                   "\"");
}

}  // namespace

Result<double> shear_of(const SquareAxes& axes) {
  if (!axes.machine.known())
    return bad_input(
        "the chain of the machine is unknown, so the sign of the correction is unknown; set the "
        "key \"chain\" in [machine] of the rig files of both runs, such as \"w-Y-X-b-Z-t\", and "
        "measure or replay both runs again");
  const ChainAxis* x = axes.machine.find('X');
  const ChainAxis* y = axes.machine.find('Y');
  if (!x || !y)
    return bad_input("the chain " + axes.machine.text + " has no axis " + (x ? "Y" : "X") +
                     ", but the squareness of X and Y needs both axes");
  return sign_of_command(*x) * sign_of_command(*y) * std::tan(axes.EC0Y_rad);
}

Result<Export> write_klipper(const SquareAxes& axes, const ExportOptions& options) {
  MDOF_TRY(const double k, shear_of(axes));
  // ABCD is the figure that the machine draws without correction for a square with the side s. A is
  // at (0, 0), B at (s, 0). D is in the direction (-k, 1) from A, and AD = s.
  const double cosine = k / std::hypot(1, k);  // cosine of the angle at B between BA and BC
  const double AC = kSide_mm * std::sqrt(2 - 2 * cosine);
  const double BD = kSide_mm * std::sqrt(2 + 2 * cosine);
  return exported(axes, options, kGcode, ";",
                  {"this command needs [skew_correction] in printer.cfg; save the values with "
                   "SKEW_PROFILE SAVE=mdof"},
                  "SET_SKEW XY=" + fixed(AC, 10) + "," + fixed(BD, 10) + "," + fixed(kSide_mm, 10));
}

Result<double> read_klipper(const std::vector<ControllerFile>& files) {
  MDOF_TRY(std::string_view text, value_of(files, kGcode, ';', "SET_SKEW XY="));
  double length[3] = {};
  for (double& x : length) {
    const auto read = decimal_from(text.substr(0, text.find(',')));
    if (!read)
      return bad_input(std::string(kGcode) + ": three lengths are expected after \"SET_SKEW XY=\"");
    x = *read;
    text = text.find(',') == text.npos ? std::string_view() : text.substr(text.find(',') + 1);
  }
  // As in the firmware: calculates the side AB from both diagonals and AD, and then the angle at A
  // by the cosine rule.
  const double AC = length[0], BD = length[1], AD = length[2];
  const double side = std::sqrt(2 * AC * AC + 2 * BD * BD - 4 * AD * AD) / 2;
  const double angle = std::acos((AC * AC - side * side - AD * AD) / (2 * side * AD));
  return -std::tan(std::acos(0.0) - angle);
}

Result<Export> write_marlin(const SquareAxes& axes, const ExportOptions& options) {
  MDOF_TRY(const double k, shear_of(axes));
  return exported(
      axes, options, kGcode, ";",
      {"this command needs SKEW_CORRECTION and SKEW_CORRECTION_GCODE; save the value with M500",
       "G21 selects mm: M852 reads its value as a length, so with inches (G20) the value would be "
       "25.4 times too large"},
      "G21\nM852 I" + fixed(-k, 10));
}

Result<double> read_marlin(const std::vector<ControllerFile>& files) {
  MDOF_TRY(const double I, number_of(files, kGcode, ';', "G21\nM852 I"));
  return -I;
}

Result<Export> write_reprapfirmware(const SquareAxes& axes, const ExportOptions& options) {
  MDOF_TRY(const double k, shear_of(axes));
  return exported(axes, options, kGcode, ";", {"copy this command to config.g"},
                  "M556 S100 X" + fixed(k * kSide_mm, 8));
}

Result<double> read_reprapfirmware(const std::vector<ControllerFile>& files) {
  MDOF_TRY(const double X, number_of(files, kGcode, ';', "M556 S100 X"));
  return X / kSide_mm;
}

Result<Export> write_matrixkins(const SquareAxes& axes, const ExportOptions& options) {
  MDOF_TRY(const double k, shear_of(axes));
  return exported(axes, options, kHal, "#",
                  {"this command needs [KINS] KINEMATICS = matrixkins; copy this command to the "
                   "HAL file, after loadrt"},
                  "setp matrixkins.C_xy " + fixed(k, 12));
}

Result<double> read_matrixkins(const std::vector<ControllerFile>& files) {
  return number_of(files, kHal, '#', "setp matrixkins.C_xy ");
}

}  // namespace mdof::controllers
