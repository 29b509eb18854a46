#include "daemon/output/controllers/volume_files.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algo/compensation/volumetric/volumetric.h"
#include "daemon/output/controllers/series.h"
#include "daemon/output/controllers/text_lines.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr std::string_view kLinear = "XYZ";
constexpr const char* kIsgTable = "volcomp.csv";
constexpr const char* kIsgList = "volcomp.lis";
constexpr const char* kGeoTable = "geo_correction.txt";
constexpr double kStepsEqual_m = 1e-9;
constexpr std::size_t kMostOfGeoTable = 4000;  // largest number of rows, and of columns

std::string letter_of(std::size_t axis) {
  return std::string(1, kLinear[axis]);
}

void resize_to_grid(VolumetricTable& t) {
  t.correction_m.assign(t.nodes(), Vec3{});
  t.u_m.assign(t.nodes(), Vec3{});
}

std::vector<std::string_view> words_in(std::string_view line, char separator) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = line.find(separator);
    if (end > 0) words.push_back(line.substr(0, end));
    line = end == line.npos ? std::string_view() : line.substr(end + 1);
  }
  return words;
}

// The words of a line as numbers; nullopt if a word is not a number.
std::optional<std::vector<double>> numbers_in(std::string_view line, char separator) {
  std::vector<double> numbers;
  for (const std::string_view word : words_in(line, separator)) {
    const auto x = decimal_from(word);
    if (!x) return std::nullopt;
    numbers.push_back(*x);
  }
  return numbers;
}

// Sorts the positions of one axis and removes repeated positions.
std::vector<double> places_of(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string isg_list(const VolumetricTable& t, const std::vector<std::string>& head) {
  return commented(head, "#") +
         "# in the start-up list, set vol_comp[0].file_name, and set vol_comp[0].max_records to " +
         std::to_string(t.nodes()) + " or more" +
         "\n# 1, 2, 3 are assumed to be the logical numbers of the axes X, Y, Z\n"
         "X 1\nY 2\nZ 3\nworkpiece_axes 0\ninterpolation GRID\nfile[0] " +
         kIsgTable + "\nfile_format[0] ISG_CSV\n";
}

std::string largest_u_text(const VolumetricTable& t, std::size_t axis) {
  const double u_m = algo::largest_u_m(t, axis);
  return std::isnan(u_m) ? "unknown" : plain_number(to_um(u_m));
}

}  // namespace

std::vector<std::string> head_of(const VolumetricTable& t, const ExportOptions& options,
                                 const std::string& sense) {
  std::vector<std::string> lines{"mdof volumetric table " + std::to_string(t.id) + " of " +
                                     plain_ascii_line(t.name) + ", made " + t.created_utc,
                                 "sha256 of the table " + t.sha256,
                                 "machine " + t.machine.text + " (" +
                                     chain_travels_text(t.machine) + "), approach " + t.approach,
                                 "sense: " + sense};
  const auto mm = [](double m) { return plain_number(to_mm(m), 9); };
  std::string at = "valid for the tool point X, Y, Z = " + mm(t.tool_m[0]) + ", " +
                   mm(t.tool_m[1]) + ", " + mm(t.tool_m[2]) + " mm";
  for (std::size_t k = 0; k < 3; ++k)
    if (t.command_m[k].size() == 1 && t.machine.find(kLinear[k]))
      at += ", at the command " + letter_of(k) + " = " + mm(t.command_m[k].front()) + " mm";
  if (const std::string rotary = rotary_text(t); !rotary.empty()) at += ", only at " + rotary;
  lines.push_back(at);
  lines.push_back("largest u of the correction of X, Y, Z in um: " + largest_u_text(t, 0) + ", " +
                  largest_u_text(t, 1) + ", " + largest_u_text(t, 2) + "; u contains " +
                  plain_ascii_line(covers_text(t)));
  for (const std::string& mark : options.marks) lines.push_back(plain_ascii_line(mark));
  return lines;
}

void note_options(const ExportOptions& options, Export& out) {
  if (options.tolerance_m > 0)
    out.notes.emplace_back("tolerance_um has no effect, because all nodes are written");
  if (!options.homes.empty())
    out.notes.emplace_back("home_mm has no effect, because the grid is written unchanged");
}

void count_nodes(const VolumetricTable& t, Export& out) {
  for (std::size_t k = 0; k < 3; ++k)
    if (t.machine.find(kLinear[k])) out.written.push_back({letter_of(k), t.nodes(), t.nodes(), 0});
}

std::vector<std::size_t> grid_axes(const VolumetricTable& t) {
  std::vector<std::size_t> axes;
  for (std::size_t k = 0; k < 3; ++k)
    if (t.command_m[k].size() > 1) axes.push_back(k);
  return axes;
}

Result<double> equal_step(const VolumetricTable& t, std::size_t axis,
                          const std::string& controller) {
  const auto& c = t.command_m[axis];
  const double step = (c.back() - c.front()) / static_cast<double>(c.size() - 1);
  for (std::size_t i = 0; i < c.size(); ++i)
    if (std::abs(c[i] - c.front() - step * static_cast<double>(i)) > kStepsEqual_m)
      return bad_input("table " + std::to_string(t.id) + ": the steps along " + letter_of(axis) +
                       " are not equal, but " + controller + " needs equal steps");
  return step;
}

Result<Export> write_isg_csv(const VolumetricTable& t, const ExportOptions& options) {
  Export out;
  note_options(options, out);
  const auto axes = grid_axes(t);
  const auto head =
      head_of(t, options,
              "columns EXX, EYX, EZX in mm = actual - nominal position of the tool = -correction");
  std::string text = commented(head, "//");
  for (const std::size_t k : axes) text += letter_of(k) + " ";
  text += "EXX EYX EZX\n";
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const Vec3 at = t.command_at(node), c = t.correction_m[node];
    for (const std::size_t k : axes) text += fixed(to_mm(at[k]), 6) + " ";
    text +=
        fixed(-to_mm(c[0]), 9) + " " + fixed(-to_mm(c[1]), 9) + " " + fixed(-to_mm(c[2]), 9) + "\n";
  }
  out.files.push_back({kIsgTable, std::move(text)});
  out.files.push_back({kIsgList, isg_list(t, head)});
  out.notes.push_back("in the start-up list, set vol_comp[0].max_records to at least " +
                      std::to_string(t.nodes()));
  count_nodes(t, out);
  return out;
}

Result<VolumetricTable> read_isg_csv(const std::vector<ControllerFile>& files) {
  const ControllerFile* file = find_file(files, kIsgTable);
  if (!file) return bad_input(std::string(kIsgTable) + ": the file is missing");
  std::vector<std::size_t> axes;
  std::vector<std::vector<double>> rows;
  std::size_t n = 0;
  for (const std::string_view line : lines_of(file->text)) {
    ++n;
    if (line.starts_with("//")) continue;
    const auto words = words_in(line, ' ');
    if (axes.empty()) {  // this line contains the names of the columns
      for (const std::string_view word : words)
        if (word.size() == 1 && kLinear.find(word[0]) != kLinear.npos)
          axes.push_back(kLinear.find(word[0]));
      const std::size_t m = axes.size();
      if (m == 0 || words.size() != m + 3 || words[m] != "EXX" || words[m + 1] != "EYX" ||
          words[m + 2] != "EZX")
        return wrong_at(
            file->name, n,
            "the names of the columns are expected: axes (X, Y, Z), then EXX, EYX and EZX");
      continue;
    }
    auto row = numbers_in(line, ' ');
    if (!row || row->size() != axes.size() + 3)
      return wrong_at(file->name, n, "one number for each column is expected");
    rows.push_back(std::move(*row));
  }
  VolumetricTable t;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = std::find(axes.begin(), axes.end(), k);
    std::vector<double> places{0};
    if (at != axes.end()) {
      places.clear();
      for (const auto& row : rows)
        places.push_back(from_mm(row[static_cast<std::size_t>(at - axes.begin())]));
    }
    t.command_m[k] = places_of(std::move(places));
  }
  // In the mode GRID the controller accepts only complete grids.
  if (rows.empty() || t.nodes() != rows.size())
    return bad_input(file->name + ": the rows do not form a complete grid of positions");
  resize_to_grid(t);
  for (const auto& row : rows) {
    std::array<std::size_t, 3> index{};
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const auto& all = t.command_m[axes[i]];
      index[axes[i]] = static_cast<std::size_t>(
          std::lower_bound(all.begin(), all.end(), from_mm(row[i])) - all.begin());
    }
    Vec3& c = t.correction_m[t.node(index[0], index[1], index[2])];
    for (std::size_t k = 0; k < 3; ++k) c[k] = -from_mm(row[axes.size() + k]);
  }
  return t;
}

namespace {

// A length in inches. 12 decimals are necessary for a step, because KMotion multiplies it by the
// number of the row.
std::string inches(double m, int decimals = 12) {
  return fixed(m / kInch_m, decimals);
}

}  // namespace

Result<Export> write_dynomotion(const VolumetricTable& t, const ExportOptions& options) {
  const std::size_t columns = t.command_m[0].size(), rows = t.command_m[1].size();
  if (columns < 2 || rows < 2 || t.command_m[2].size() > 1)
    return bad_input("table " + std::to_string(t.id) +
                     " is not a table of the plane XY, but KMotion stores only that plane; build a "
                     "table of the plane XY");
  MDOF_TRY(const double step_x, equal_step(t, 0, "KMotion"));
  MDOF_TRY(const double step_y, equal_step(t, 1, "KMotion"));
  Export out;
  note_options(options, out);
  std::string text = std::to_string(rows) + "," + std::to_string(columns) + "\n" +
                     inches(step_x, 15) + "," + inches(step_y, 15) + "\n" +
                     inches(t.command_m[0].front()) + "," + inches(t.command_m[1].front()) + "\n";
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec3& c = t.correction_m[t.node(column, row, 0)];
      text += std::to_string(row) + "," + std::to_string(column) + "," +
              inches(t.command_m[0][column] + c[0]) + "," + inches(t.command_m[1][row] + c[1]) +
              "," + inches(c[2]) + "\n";
    }
  // KMotion reads as many rows as the first line states, and ignores the rest of the file. The
  // comments are therefore at the end.
  text +=
      commented(head_of(t, options,
                        "columns: row number, column number, corrected command of X, corrected "
                        "command of Y, correction that is added to the command of Z; all lengths "
                        "are in inch, and all positions are machine coordinates"),
                "//");
  out.files.push_back({kGeoTable, std::move(text)});
  out.notes.emplace_back(
      "beyond the grid KMotion extrapolates the last cell; keep the workpiece inside the grid");
  count_nodes(t, out);
  return out;
}

Result<VolumetricTable> read_dynomotion(const std::vector<ControllerFile>& files) {
  const ControllerFile* file = find_file(files, kGeoTable);
  if (!file) return bad_input(std::string(kGeoTable) + ": the file is missing");
  const auto lines = lines_of(file->text);
  std::array<std::vector<double>, 3> head;
  for (std::size_t i = 0; i < head.size(); ++i) {
    const auto two = i < lines.size() ? numbers_in(lines[i], ',') : std::nullopt;
    if (!two || two->size() != 2) return wrong_at(file->name, i + 1, "two numbers are expected");
    head[i] = *two;
  }
  for (const double size : head[0])
    if (!(size >= 2 && size <= kMostOfGeoTable) || size != std::floor(size))
      return wrong_at(file->name, 1, "2 to 4000 rows and columns are expected");
  const auto rows = static_cast<std::size_t>(head[0][0]);
  const auto columns = static_cast<std::size_t>(head[0][1]);
  VolumetricTable t;
  for (std::size_t i = 0; i < columns; ++i)
    t.command_m[0].push_back((head[2][0] + static_cast<double>(i) * head[1][0]) * kInch_m);
  for (std::size_t i = 0; i < rows; ++i)
    t.command_m[1].push_back((head[2][1] + static_cast<double>(i) * head[1][1]) * kInch_m);
  t.command_m[2] = {0};
  resize_to_grid(t);
  for (std::size_t i = 0; i < t.nodes(); ++i) {
    const auto row =
        head.size() + i < lines.size() ? numbers_in(lines[head.size() + i], ',') : std::nullopt;
    const bool right = row && row->size() == 5 && (*row)[0] >= 0 && (*row)[1] >= 0 &&
                       (*row)[0] < head[0][0] && (*row)[1] < head[0][1];
    if (!right)
      return wrong_at(file->name, head.size() + i + 1,
                      "row, column, X, Y and Z are expected, with row and column inside the grid");
    const auto y = static_cast<std::size_t>((*row)[0]), x = static_cast<std::size_t>((*row)[1]);
    t.correction_m[t.node(x, y, 0)] = {(*row)[2] * kInch_m - t.command_m[0][x],
                                       (*row)[3] * kInch_m - t.command_m[1][y],
                                       (*row)[4] * kInch_m};
  }
  return t;
}

}  // namespace mdof::controllers
