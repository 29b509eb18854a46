#include "daemon/output/controllers/error_rows.h"

#include <array>
#include <cmath>

#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/text_lines.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr std::size_t kWeihongPointLimit = 10'000, kSsfkPointLimit = 1499;
constexpr double kTenthOfMicrometre = 1e-7;
constexpr double kSsfkPositionLimit_m = 200;  // limit: the format stores 32-bit integers in 0.1 µm
constexpr const char* kWeihongFile = "axeserr.dat";

std::string tenths_text(double m) {
  return fixed(std::round(m / kTenthOfMicrometre), 0);
}

Result<ControllerFile> ssfk_of(const CompensationTable& table, const Series& s,
                               const ExportOptions& options) {
  const auto far = [](double m) { return !(std::abs(m) < kSsfkPositionLimit_m); };
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    if (far(s.position_m[i]) || far(s.forward[i]) || far(s.reverse[i]))
      return bad_input(
          s.error + ": a position or error is " + plain_number(kSsfkPositionLimit_m) +
          " m or more, which is too large for a lead screw table (32-bit numbers in 0.1 um)");
    if (i > 0 && tenths_text(s.position_m[i]) == tenths_text(s.position_m[i - 1]))
      return bad_input(s.error +
                       ": two neighbouring positions are equal when rounded to 0.1 um, the "
                       "resolution of a lead screw table");
  }
  std::string text = commented(
      head_lines(
          table, options,
          ".setpoint, .pos and .neg are in 0.1 um; .pos and .neg = actual - set = +" + s.error),
      "#");
  text +=
      "# unit 1 means 0.1 um; interval 0 means that each row has its own setpoint\n"
      "# to activate the table, set lr_param.ssfk 1\n"
      "kw.ssfk.interval 0\nkw.ssfk.unit 1\nkw.ssfk.bilateral 1\nkw.ssfk.modulo 0\n"
      "kw.ssfk.kw_startpos " +
      tenths_text(s.position_m.front()) + "\nkw.ssfk.kw_nr_max " +
      std::to_string(s.position_m.size()) + "\n";
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    const std::string row = "kw.ssfk.table[" + std::to_string(i) + "]";
    text += row + ".setpoint " + tenths_text(s.position_m[i]) + "\n" + row + ".pos " +
            tenths_text(s.forward[i]) + "\n" + row + ".neg " + tenths_text(s.reverse[i]) + "\n";
  }
  return ControllerFile{std::string("ssfk-") + s.along + ".lis", text};
}

AppliedCorrection empty_correction(char axis) {
  return {{'E', axis, axis}, axis, axis, {}, {}, {}};
}

// Reads the integer after `key`, which must be at the beginning of this line.
Result<double> whole_after(const ControllerFile& file, const std::vector<std::string_view>& lines,
                           std::size_t at, const std::string& key) {
  const auto words = at < lines.size() ? words_of(lines[at]) : std::vector<std::string_view>();
  const auto x = words.size() == 2 && words[0] == key && words[1].find('.') == words[1].npos
                     ? decimal_from(words[1])
                     : std::nullopt;
  if (!x) return wrong_at(file.name, at + 1, "\"" + key + "\" with a whole number is expected");
  return *x;
}

Result<AppliedCorrection> read_ssfk_file(const ControllerFile& file) {
  AppliedCorrection read = empty_correction(file.name.at(5));
  const auto lines = lines_of(file.text);
  std::size_t at = 0;
  while (at < lines.size() && lines[at].starts_with("#")) ++at;
  std::array<double, 6> head{};
  const char* const keys[] = {"interval", "unit",        "bilateral",
                              "modulo",   "kw_startpos", "kw_nr_max"};
  for (std::size_t k = 0; k < head.size(); ++k) {
    MDOF_TRY(head[k], whole_after(file, lines, at++, std::string("kw.ssfk.") + keys[k]));
  }
  const auto rows = static_cast<std::size_t>(head[5]);
  if (head[0] != 0 || head[1] != 1 || head[2] != 1 || head[3] != 0 || rows < 2 ||
      rows > kSsfkPointLimit)
    return bad_input(file.name +
                     ": kw.ssfk.interval must be 0, kw.ssfk.unit 1, kw.ssfk.bilateral 1, "
                     "kw.ssfk.modulo 0, and kw.ssfk.kw_nr_max from 2 to " +
                     std::to_string(kSsfkPointLimit));
  for (std::size_t i = 0; i < rows; ++i) {
    const std::string row = "kw.ssfk.table[" + std::to_string(i) + "]";
    MDOF_TRY(const double position, whole_after(file, lines, at++, row + ".setpoint"));
    MDOF_TRY(const double positive, whole_after(file, lines, at++, row + ".pos"));
    MDOF_TRY(const double negative, whole_after(file, lines, at++, row + ".neg"));
    read.position_m.push_back(position * kTenthOfMicrometre);
    read.forward.push_back(-positive * kTenthOfMicrometre);
    read.reverse.push_back(-negative * kTenthOfMicrometre);
  }
  if (at != lines.size())
    return wrong_at(file.name, at + 1, "the file has more rows than kw.ssfk.kw_nr_max");
  return read;
}

}  // namespace

Result<Series> positioning_of(const CompensationTable& table, std::size_t most,
                              const ExportOptions& options, const std::string& controller,
                              Export& out) {
  const std::string error = positioning_name(table.axis);
  const auto series = series_of(table);
  for (const Series& s : series)
    if (s.error != error)
      out.left_out.push_back(s.error + " of table " + std::to_string(table.id) + ": " + controller +
                             " stores only the positioning error of an axis");
  const Series* along = find_series(series, error);
  if (!along)
    return bad_input("table " + std::to_string(table.id) + " has no " + error + ", but " +
                         controller + " stores only this error",
                     Remedy::import_positioning);
  if (!options.homes.empty())
    out.notes.push_back("home_mm has no effect, because " + controller +
                        " contains the errors unchanged");
  return fitted(*along, table.id, most, options, out);
}

Result<Export> write_weihong(const std::vector<CompensationTable>& tables,
                             const ExportOptions& options) {
  MDOF_CHECK(check_one_table_an_axis(tables));
  Export out;
  std::string head, body;
  for (const CompensationTable& table : tables) {
    MDOF_TRY(const Series s, positioning_of(table, kWeihongPointLimit, options, kWeihongFile, out));
    head += commented(
        head_lines(
            table, options,
            "columns in mm: nominal position, forward error, backward error; error = +" + s.error),
        ";");
    body += std::string("[") + s.along + "]\n";
    for (std::size_t i = 0; i < s.position_m.size(); ++i)
      body += fixed(to_mm(s.position_m[i]), 6) + ", " + fixed(to_mm(s.forward[i]), 6) + ", " +
              fixed(to_mm(s.reverse[i]), 6) + "\n";
  }
  out.files.push_back({kWeihongFile, head + "unit = mm\n" + body});
  return out;
}

Result<std::vector<AppliedCorrection>> read_weihong(const std::vector<ControllerFile>& files) {
  const ControllerFile* file = find_file(files, kWeihongFile);
  if (!file) return bad_input(std::string(kWeihongFile) + ": the file is missing");
  std::vector<AppliedCorrection> all;
  bool unit = false;
  std::size_t n = 0;
  for (const std::string_view line : lines_of(file->text)) {
    ++n;
    if (line.starts_with(";")) continue;
    if (line == "unit = mm") {
      unit = true;
      continue;
    }
    if (line.size() == 3 && line[0] == '[' && line[2] == ']') {
      all.push_back(empty_correction(line[1]));
      continue;
    }
    std::string text(line);
    for (char& c : text) c = c == ',' ? ' ' : c;
    const auto words = words_of(text);
    std::array<double, 3> row{};
    bool right = unit && !all.empty() && words.size() == row.size();
    for (std::size_t i = 0; right && i < row.size(); ++i) {
      const auto x = decimal_from(words[i]);
      right = x.has_value();
      row[i] = from_mm(x.value_or(0));
    }
    if (!right)
      return wrong_at(
          file->name, n,
          "a row of three numbers is expected, below \"unit = mm\" and an axis such as \"[X]\"");
    if (!all.back().position_m.empty() && !(row[0] > all.back().position_m.back()))
      return wrong_at(file->name, n,
                      "the position is not larger than the position in the row before");
    all.back().position_m.push_back(row[0]);
    all.back().forward.push_back(-row[1]);
    all.back().reverse.push_back(-row[2]);
  }
  return all;
}

Result<Export> write_ssfk(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options) {
  MDOF_CHECK(check_one_table_an_axis(tables));
  Export out;
  for (const CompensationTable& table : tables) {
    MDOF_TRY(const Series s,
             positioning_of(table, kSsfkPointLimit, options, "a lead screw table", out));
    MDOF_TRY(ControllerFile file, ssfk_of(table, s, options));
    out.files.push_back(std::move(file));
  }
  return out;
}

Result<std::vector<AppliedCorrection>> read_ssfk(const std::vector<ControllerFile>& files) {
  std::vector<AppliedCorrection> all;
  for (const ControllerFile& file : files) {
    MDOF_TRY(AppliedCorrection read, read_ssfk_file(file));
    all.push_back(std::move(read));
  }
  return all;
}

}  // namespace mdof::controllers
