#include "daemon/output/controllers/linuxcnc/linuxcnc.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "daemon/output/controllers/linuxcnc/ramp.h"
#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/text_lines.h"
#include "daemon/words/error_text.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr std::size_t kMostRows = 256, kLongestLine = 253;
constexpr int kDecimals = 9, kInchDecimals = 11;
constexpr const char* kIni = "compensation.ini";
constexpr const char* kUnits = "# [TRAJ] LINEAR_UNITS of these rows: ";
constexpr const char* kAxes = "XYZ";

std::string rows_text(const Series& s, double zero_m, bool inch) {
  const auto number = [inch](double m) {
    return inch ? fixed(m / kInch_m, kInchDecimals) : fixed(to_mm(m), kDecimals);
  };
  std::string text;
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    const auto trim = [&](double error) { return number(s.factor * error - zero_m); };
    text += number(s.position_m[i]) + " " + trim(s.forward[i]) + " " + trim(s.reverse[i]) + "\n";
  }
  return text;
}

std::vector<int> joints_of(char axis, const ExportOptions& options) {
  if (options.joints.empty()) return {axis - 'X'};
  std::vector<int> numbers;
  for (const ExportOptions::Joint& joint : options.joints)
    if (joint.axis == axis) numbers.push_back(joint.number);
  return numbers;
}

const ExportOptions::Travel* travel_of(char axis, const ExportOptions& options) {
  for (const ExportOptions::Travel& travel : options.travels)
    if (travel.axis == axis) return &travel;
  return nullptr;
}

// The constant that must be subtracted to make the trim 0 at home. If home is not given, the
// constant is 0, and a note states the trim at HOME of the ini file (default: 0).
double zero_of(const Series& s, const ExportOptions& options, Export& out) {
  if (const std::optional<double> home_m = options.home_m(s.along)) {
    const double there = s.factor * mean_error_at(s, *home_m);
    out.notes.push_back(zeroed_at_home_note(s, "trim", there, *home_m));
    return there;
  }
  const auto* const travel = travel_of(s.along, options);
  const double home_m = travel ? travel->home_m : 0;
  const double there = s.factor * mean_error_at(s, home_m);
  const std::string um = plain_number(to_um(there)) + " um";
  if (std::abs(there) > 1e-9)
    out.notes.push_back(s.error + ": the trim at " + plain_number(to_mm(home_m)) + " mm is " + um +
                        ", so the first motion after homing jumps by " + um + "; " +
                        words::remedy(Remedy::give_home));
  return 0;
}

// Beyond its ends, a table has no measured values.
void note_travel_beyond(const Series& s, const ExportOptions& options, Export& out) {
  const auto* const travel = travel_of(s.along, options);
  if (!travel || !travel->from_m || !travel->to_m) return;
  const double from_m = s.position_m.front(), to_m = s.position_m.back();
  if (*travel->from_m >= from_m && *travel->to_m <= to_m) return;
  const auto range = [](double from, double to) {
    return plain_number(to_mm(from)) + " to " + plain_number(to_mm(to)) + " mm";
  };
  out.notes.push_back(s.error + ": the soft limits permit " +
                      range(*travel->from_m, *travel->to_m) + ", but the table contains " +
                      range(from_m, to_m) +
                      ". Outside, LinuxCNC uses the value at the nearest end of the table");
}

std::string ini_of(const CompensationTable& table, const ExportOptions& options) {
  const std::string file = std::string(1, letter(table.axis)) + ".comp";
  std::string text;
  for (const std::string& line :
       head_lines(table, options,
                  std::string("columns are position, trim forward, trim reverse in ") +
                      (options.inch ? "inches" : "mm") + "; trim = -" +
                      positioning_name(table.axis) + ", added to the motor command"))
    text += "# " + line + "\n";
  for (const int joint : joints_of(letter(table.axis), options))
    text += "[JOINT_" + std::to_string(joint) + "]\nCOMP_FILE = " + file + "\nCOMP_FILE_TYPE = 1\n";
  return text;
}

Status add_joint(const CompensationTable& table, const ExportOptions& options, Export& out,
                 std::string& ini) {
  const std::string error = positioning_name(table.axis);
  const auto series = series_of(table);
  for (const Series& s : series)
    if (s.error != error)
      out.left_out.push_back(
          s.error + " of table " + std::to_string(table.id) +
          ": a COMP_FILE corrects only positioning errors, because LinuxCNC calculates the "
          "correction of a joint from the position of this joint only");
  const Series* along = find_series(series, error);
  if (!along)
    return bad_input("table " + std::to_string(table.id) + " has no " + error +
                         ", but a COMP_FILE of LinuxCNC stores only this error",
                     Remedy::import_positioning);
  if (joints_of(letter(table.axis), options).empty())
    return fail(ErrorCode::usage,
                std::string("table ") + std::to_string(table.id) + " is for axis " +
                    letter(table.axis) +
                    ", but the list of joints has no joint of this axis; add a joint, such as " +
                    letter(table.axis) + "=1");
  MDOF_TRY(const Series s, fitted(*along, table.id, kMostRows, options, out));
  note_unapplied_reversals(s, options, out);
  note_travel_beyond(s, options, out);
  out.files.push_back({std::string(1, letter(table.axis)) + ".comp",
                       rows_text(s, zero_of(s, options, out), options.inch)});
  ini += ini_of(table, options);
  return {};
}

Result<AppliedCorrection> read_comp(const ControllerFile& file, char axis, int type, bool inch) {
  AppliedCorrection read{{'E', axis, axis}, axis, axis, {}, {}, {}};
  const auto lines = lines_of(file.text);
  if (lines.empty() || lines.size() > kMostRows)
    return bad_input(file.name + ": the file has " + std::to_string(lines.size()) +
                     " rows, but LinuxCNC reads 1 to " + std::to_string(kMostRows) + " rows");
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const auto words = words_of(lines[n]);
    std::array<double, 3> row{};
    bool three = words.size() == row.size() && lines[n].size() <= kLongestLine;
    for (std::size_t i = 0; three && i < row.size(); ++i) {
      const auto x = decimal_from(words[i]);
      three = x.has_value();
      row[i] = inch ? x.value_or(0) * kInch_m : from_mm(x.value_or(0));
    }
    if (!three)
      return wrong_at(file.name, n + 1,
                      "three numbers in at most " + std::to_string(kLongestLine) +
                          " characters are expected; LinuxCNC would stop reading at this line");
    if (n > 0 && !(row[0] > read.position_m.back()))
      return wrong_at(
          file.name, n + 1,
          "the position is not larger than in the row before; LinuxCNC would skip this row");
    read.position_m.push_back(row[0]);
    read.forward.push_back(type == 0 ? row[0] - row[1] : row[1]);
    read.reverse.push_back(type == 0 ? row[0] - row[2] : row[2]);
  }
  return read;
}

// The values in the ini lines of one joint.
struct JointLines {
  std::string file;
  int type = 0;  // LinuxCNC's default
};

constexpr std::size_t kMostJoints = 16;

// The number of the joint in a line such as "[JOINT_12]"; nullopt: another line.
std::optional<std::size_t> joint_of(std::string_view line) {
  constexpr std::string_view kHead = "[JOINT_";
  if (!line.starts_with(kHead) || !line.ends_with("]")) return std::nullopt;
  const auto number = line.substr(kHead.size(), line.size() - kHead.size() - 1);
  std::size_t joint = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), joint);
  if (error != std::errc() || end != number.data() + number.size() || joint >= kMostJoints)
    return std::nullopt;
  return joint;
}

std::string joints_text(const ExportOptions& options) {
  if (options.joints.empty()) return "Joints 0, 1, 2 belong to axes X, Y, Z, in this order";
  std::string numbers, axes;
  for (const ExportOptions::Joint& joint : options.joints) {
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(joint.number);
    axes += (axes.empty() ? "" : ", ") + std::string(1, joint.axis);
  }
  if (options.joints.size() == 1) return "Joint " + numbers + " belongs to axis " + axes;
  return "Joints " + numbers + " belong to axes " + axes + ", in this order";
}

}  // namespace

Result<Export> write_linuxcnc(const std::vector<CompensationTable>& tables,
                              const ExportOptions& options) {
  MDOF_CHECK(check_one_table_an_axis(tables));
  Export out;
  std::string ini = std::string(
                        "# Copy these lines to the ini file of LinuxCNC, and copy the .comp files "
                        "to the folder of the ini file.\n") +
                    "# Restart LinuxCNC to change a table.\n# " + joints_text(options) +
                    ".\n# A joint with a table ignores BACKLASH.\n# Do not add comments to a .comp "
                    "file: LinuxCNC stops reading at a comment.\n";
  if (options.inch) ini += std::string(kUnits) + "inch\n";
  for (const CompensationTable& table : tables) MDOF_CHECK(add_joint(table, options, out, ini));
  out.files.push_back({kIni, ini});
  return out;
}

Result<std::vector<AppliedCorrection>> read_linuxcnc(const std::vector<ControllerFile>& files) {
  const ControllerFile* ini = find_file(files, kIni);
  if (!ini) return bad_input(std::string(kIni) + ": the file is missing");
  std::array<JointLines, kMostJoints> joints;
  std::size_t joint = joints.size(), n = 0;
  bool inch = false;
  for (const std::string_view line : lines_of(ini->text)) {
    ++n;
    if (line.starts_with(kUnits)) inch = line.ends_with(" inch");
    if (line.starts_with("#")) continue;
    const auto words = words_of(line);
    if (const auto number = joint_of(line)) {
      joint = *number;
    } else if (joint < joints.size() && words.size() == 3 && words[0] == "COMP_FILE") {
      joints[joint].file = std::string(words[2]);
    } else if (joint < joints.size() && words.size() == 3 && words[0] == "COMP_FILE_TYPE") {
      joints[joint].type = words[2] == "0" ? 0 : 1;
    } else {
      return wrong_at(
          kIni, n,
          "only these lines are allowed: [JOINT_0] to [JOINT_" + std::to_string(kMostJoints - 1) +
              "], and below such a line \"COMP_FILE = NAME\" and \"COMP_FILE_TYPE = 0\" (or 1)");
    }
  }
  std::vector<AppliedCorrection> all;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].file.empty()) continue;
    const ControllerFile* file = find_file(files, joints[j].file);
    if (!file)
      return bad_input(joints[j].file + ": the file is missing, so LinuxCNC would not start");
    // The first letter of the file name is the axis, because the ini file does not state the axis
    // of a joint.
    const std::size_t axis = std::string_view(kAxes).find(joints[j].file.front());
    if (axis == std::string_view::npos)
      return bad_input(joints[j].file +
                       ": the file name must begin with the letter of the axis, X, Y or Z");
    MDOF_TRY(AppliedCorrection read, read_comp(*file, kAxes[axis], joints[j].type, inch));
    all.push_back(std::move(read));
  }
  return all;
}

}  // namespace mdof::controllers
