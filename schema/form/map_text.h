// Height maps as text with one pixel in each row. Formats: CSV with the header x_mm,y_mm,z_um, and
// XYZ without a header and with blanks between the values.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/base/result.h"
#include "schema/form/height_map.h"
#include "schema/form/map_grid.h"

namespace mdof {

// Units of a file without header, as factors that convert to metres.
struct XyzUnits {
  double xy_m = 1e-3, z_m = 1e-6;
};
// `text` is for example "mm" (unit of all three columns) or "mm,um" (unit of x and y, unit of z).
// Known units: m, mm, um, nm.
Result<XyzUnits> xyz_units(const std::string& text);

// Reads one file in pieces of any size. The rows may be in any order. The columns of a file with a
// header may be in any order; other columns are ignored. If semicolons, tabs or (in XYZ) blanks
// separate the columns, numbers may have decimal commas. A height is missing if its pixel has no
// row, or if z is empty or nan. Lines that begin with # are ignored. Errors state file and line.
// Without `units`, an XYZ file has the units of the CSV format, and a notice states this
// assumption.
class MapTextReader {
 public:
  MapTextReader(std::string source, std::optional<XyzUnits> units)
      : source_(std::move(source)), units_(units) {}
  // Sets the size of the whole file, so that the memory is reserved once. The call is optional.
  void expect_bytes(std::size_t bytes) { bytes_expected_ = bytes; }
  Status feed(std::string_view piece);
  Result<SurfaceMap> finish();
  // Returns whether the file has a header. The names in the header state the units, so `units` is
  // not used.
  bool has_header() const { return form_ == Form::csv; }

 private:
  enum class Form { unknown, csv, xyz };
  Status line(std::string_view text);
  Status first_line(std::string_view text);
  Status header(std::string_view text);
  Status csv_row(std::string_view text);
  Status xyz_row(std::string_view text);
  bool read_cell(std::string_view cell, double& x);
  Status add(const std::array<double, 3>& xyz);
  void reserve_points(std::size_t bytes_read);
  std::string place(std::size_t line) const;
  tl::unexpected<Error> bad_cell(std::size_t column, std::string_view cell) const;
  std::string place_of_point(std::size_t point) const;

  std::string source_;
  std::optional<XyzUnits> units_;
  Form form_ = Form::unknown;
  std::array<std::size_t, 3> column_{{0, 1, 2}};  // columns of x, y, z
  std::size_t columns_ = 3;
  // Another separator than the comma: numbers may have decimal commas.
  char separator_ = ',';
  bool has_decimal_comma_ = false, has_decimal_point_ = false;
  double xy_m_ = 1e-3, z_m_ = 1e-6;
  std::string rest_;  // start of a line that is completed in the next piece
  std::size_t line_ = 0;
  std::size_t bytes_expected_ = 0;
  MapPoints points_;
  // For each group of points on consecutive lines: index of the first point, and its line number.
  std::vector<std::pair<std::size_t, std::size_t>> line_groups_;
  Notices notices_;
};

// Writes a map in the CSV format, with one row for each pixel. Calls `take` for pieces of the text.
Status write_map_csv(const SurfaceMap& map, const std::function<Status(std::string_view)>& take);

}  // namespace mdof
