#include "schema/form/map_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "schema/base/number/number.h"
#include "schema/base/number/number_text.h"
#include "schema/base/trimmed.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::array<const char*, 3> kColumns = {{"x_mm", "y_mm", "z_um"}};
constexpr std::size_t kMostLine = 64 * 1024;  // bytes

// Reads a cell that contains only a number with a decimal point. An empty cell or nan is a missing
// value.
bool read_number(std::string_view cell, double& x) {
  cell = trimmed(cell);
  if (cell.empty()) {
    x = SurfaceMap::kMissing;
    return true;
  }
  if (cell.front() == '+') cell.remove_prefix(1);
  const char* const end = cell.data() + cell.size();
  if (parse_double(cell.data(), end, x) == end) return !std::isinf(x);
  if (cell == "NaN" || cell == "NAN") {
    x = SurfaceMap::kMissing;
    return true;
  }
  return false;
}

// Stores the first three fields of a line. Returns the number of its fields.
std::size_t split(std::string_view text, const char* separators,
                  std::array<std::string_view, 3>& fields) {
  std::size_t count = 0;
  for (std::size_t at = text.find_first_not_of(separators); at != text.npos; ++count) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    if (count < 3) fields[count] = text.substr(at, end - at);
    at = text.find_first_not_of(separators, end);
  }
  return count;
}

std::string shown(std::string_view cell) {
  return "\"" + std::string(cell.substr(0, 40)) + (cell.size() > 40 ? "..." : "") + "\"";
}

std::optional<double> unit_m(std::string_view name) {
  if (name == "m") return 1;
  if (name == "mm") return 1e-3;
  if (name == "um") return 1e-6;
  if (name == "nm") return 1e-9;
  return {};
}

// Divides by 1e3 or 1e6, because x / 1e3 is rounded once and x * 1e-3 twice.
double in_m(double x, double unit_m) {
  if (unit_m == 1e-3) return from_mm(x);
  if (unit_m == 1e-6) return from_um(x);
  return unit_m == 1 ? x : x / 1e9;
}

}  // namespace

Result<XyzUnits> xyz_units(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto xy = unit_m(text.substr(0, comma));
  const auto z = comma == std::string::npos ? xy : unit_m(text.substr(comma + 1));
  if (xy && z) return XyzUnits{*xy, *z};
  return fail(
      ErrorCode::usage,
      "\"" + text +
          "\" is not a unit of a map; give m, mm, um or nm for all values, or two of these units, "
          "such as mm,um (mm for x and y, um for z). Convert values in other units first");
}

std::string MapTextReader::place(std::size_t line) const {
  return source_ + ":" + std::to_string(line) + ": ";
}

std::string MapTextReader::place_of_point(std::size_t point) const {
  auto after = std::upper_bound(line_groups_.begin(), line_groups_.end(), point,
                                [](std::size_t p, const auto& s) { return p < s.first; });
  --after;
  return place(after->second + point - after->first);
}

// Reserves memory for the points of the whole file. It assumes that the mean length of a row is the
// same as in the first piece.
void MapTextReader::reserve_points(std::size_t bytes_read) {
  const std::size_t read = points_.z_m.size();
  if (bytes_expected_ <= bytes_read || read == 0) return;
  const double all = 1.02 * static_cast<double>(read) * static_cast<double>(bytes_expected_) /
                     static_cast<double>(bytes_read);
  const auto most = static_cast<std::size_t>(std::min(static_cast<double>(kMostPixels), all));
  for (auto* column : {&points_.x_m, &points_.y_m, &points_.z_m}) column->reserve(most);
  bytes_expected_ = 0;
}

Status MapTextReader::feed(std::string_view piece) {
  const std::size_t size = piece.size();
  while (!piece.empty()) {
    const std::size_t end = piece.find('\n');
    if (end == std::string_view::npos) {
      rest_.append(piece);
      if (rest_.size() > kMostLine)
        return bad_input(place(line_ + 1) + "the line is longer than " + std::to_string(kMostLine) +
                         " bytes, so this is not a map");
      break;
    }
    if (rest_.empty()) {
      MDOF_CHECK(line(piece.substr(0, end)));
    } else {
      rest_.append(piece.substr(0, end));
      MDOF_CHECK(line(rest_));
      rest_.clear();
    }
    piece.remove_prefix(end + 1);
  }
  reserve_points(size);
  return {};
}

Status MapTextReader::line(std::string_view text) {
  ++line_;
  if (line_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  // Tabs at the ends of a line separate empty columns.
  if (separator_ == '\t' && text.ends_with('\r')) text.remove_suffix(1);
  if (separator_ != '\t' || trimmed(text).empty()) text = trimmed(text);
  if (text.empty() || text.front() == '#') return {};
  switch (form_) {
    case Form::csv:
      return csv_row(text);
    case Form::xyz:
      return xyz_row(text);
    case Form::unknown:
      break;
  }
  return first_line(text);
}

Status MapTextReader::first_line(std::string_view text) {
  const char c = text.front();
  if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') {
    form_ = Form::xyz;
    if (units_) {
      xy_m_ = units_->xy_m;
      z_m_ = units_->z_m;
    } else {
      notices_.push_back(notice(NoticeCode::map_units_assumed, source_));
    }
    return xyz_row(text);
  }
  return header(text);
}

Status MapTextReader::header(std::string_view text) {
  form_ = Form::csv;
  for (const char c : {'\t', ';'})
    if (text.find(c) != text.npos) separator_ = c;
  std::vector<std::string> names;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(separator_);
    std::string_view name = trimmed(rest.substr(0, comma));
    if (name.size() > 1 && name.front() == '"' && name.back() == '"')
      name = name.substr(1, name.size() - 2);
    names.emplace_back(name);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string wanted = kColumns[k];
    const auto at = std::find(names.begin(), names.end(), wanted);
    if (at != names.end()) {
      column_[k] = static_cast<std::size_t>(at - names.begin());
      continue;
    }
    for (const std::string& name : names)
      if (name == wanted.substr(0, 1) || name.starts_with(wanted.substr(0, 2)))
        return bad_input(place(line_) + "column " + name +
                         " does not have the expected name and unit; convert the values if "
                         "necessary, and rename the column to " +
                         wanted);
    return bad_input(place(line_) + "no column " + wanted + " in " + shown(text) +
                     "; a map is a CSV file with the header x_mm,y_mm,z_um, an XYZ file without "
                     "header, an .sdf file (ISO 25178-71) or a Zygo .dat file");
  }
  columns_ = names.size();
  return {};
}

tl::unexpected<Error> MapTextReader::bad_cell(std::size_t column, std::string_view cell) const {
  return bad_input(place(line_) + "column " + std::to_string(column + 1) + " is " +
                   shown(trimmed(cell)) + ", not a finite number");
}

Status MapTextReader::csv_row(std::string_view text) {
  std::array<double, 3> xyz{};
  std::size_t column = 0;
  for (std::string_view rest = text;; ++column) {
    const std::size_t comma = rest.find(separator_);
    const std::string_view cell = rest.substr(0, comma);
    for (std::size_t k = 0; k < 3; ++k)
      if (column_[k] == column && !read_cell(cell, xyz[k])) return bad_cell(column, cell);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (column + 1 != columns_)
    return bad_input(place(line_) + "the line has " + std::to_string(column + 1) +
                     " columns, but the header has " + std::to_string(columns_));
  return add(xyz);
}

Status MapTextReader::xyz_row(std::string_view text) {
  std::array<double, 3> xyz{};
  std::array<std::string_view, 3> field;
  const auto has_outer_comma = [](std::string_view f) {
    return f.starts_with(',') || f.ends_with(',');
  };
  separator_ = ';';  // or blanks
  std::size_t count = split(text, " \t;", field);
  if (count != 3 || std::any_of(field.begin(), field.end(), has_outer_comma)) {
    separator_ = ',';
    count = split(text, " \t;,", field);
  }
  for (std::size_t k = 0; k < std::min<std::size_t>(count, 3); ++k)
    if (!read_cell(field[k], xyz[k])) return bad_cell(k, field[k]);
  if (count != 3)
    return bad_input(place(line_) + "the line has " + std::to_string(count) +
                     " numbers; in a map without a header, each row has three numbers: x y z");
  return add(xyz);
}

bool MapTextReader::read_cell(std::string_view cell, double& x) {
  if (separator_ == ',') return read_number(cell, x);
  has_decimal_point_ = has_decimal_point_ || cell.find('.') != cell.npos;
  const std::size_t comma = cell.find(',');
  if (comma == cell.npos) return read_number(cell, x);
  has_decimal_comma_ = true;
  std::string number(cell);
  number[comma] = '.';
  return read_number(number, x);
}

Status MapTextReader::add(const std::array<double, 3>& xyz) {
  if (std::isnan(xyz[0]) || std::isnan(xyz[1]))
    return bad_input(
        place(line_) +
        "the line has no position (x or y is empty or nan); add the value or delete the line");
  if (has_decimal_comma_ && has_decimal_point_)
    return bad_input(place(line_) +
                     "the map has numbers with decimal commas and numbers with decimal points; use "
                     "the same decimal sign in all numbers");
  const std::size_t point = points_.z_m.size();
  if (point == kMostPixels)
    return bad_input(place(line_) + "the map has more than " + std::to_string(kMostPixels) +
                     " pixels; use a coarser map");
  if (line_groups_.empty() ||
      line_groups_.back().second + (point - line_groups_.back().first) != line_)
    line_groups_.emplace_back(point, line_);
  const std::array<double, 3> at_m = {
      {in_m(xyz[0], xy_m_), in_m(xyz[1], xy_m_), in_m(xyz[2], z_m_)}};
  for (const double x_m : at_m)
    if (std::abs(x_m) > kFarthest_m)
      return bad_input(place(line_) + plain_number(x_m, 3) +
                       " m is too large for a map (limit 1000 m); check the value and its unit");
  points_.x_m.push_back(at_m[0]);
  points_.y_m.push_back(at_m[1]);
  points_.z_m.push_back(at_m[2]);
  return {};
}

Result<SurfaceMap> MapTextReader::finish() {
  if (!rest_.empty()) {
    const std::string last = std::move(rest_);
    MDOF_CHECK(line(last));
  }
  if (form_ == Form::unknown)
    return bad_input(source_ + ": is empty; a map is a CSV file with the header x_mm,y_mm,z_um");
  MDOF_TRY(SurfaceMap map,
           grid_of(points_, source_, [this](std::size_t point) { return place_of_point(point); }));
  map.notices = std::move(notices_);
  return map;
}

Status write_map_csv(const SurfaceMap& map, const std::function<Status(std::string_view)>& take) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::string text = "x_mm,y_mm,z_um\n";
  std::array<char, 64> room;
  const auto number = [&](double x, int digits) {
    const auto end = std::to_chars(room.data(), room.data() + room.size(), x + 0.0,
                                   std::chars_format::general, digits);
    text.append(room.data(), end.ptr);
  };
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      number(to_mm(map.x_m(i)), 12);
      text += ',';
      number(to_mm(map.y_m(j)), 12);
      text += ',';
      if (const double z = map.at(i, j); !std::isnan(z)) number(to_um(z), 12);
      text += '\n';
      if (text.size() < kPiece) continue;
      MDOF_CHECK(take(text));
      text.clear();
    }
  return take(text);
}

}  // namespace mdof
