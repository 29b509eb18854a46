// Height maps as text with one pixel a row: CSV with the header x_mm,y_mm,z_um, and XYZ, which has
// no header and separates by blanks.
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

// Units of a file without header, as a factor to metres.
struct XyzUnits {
  double xy_m = 1e-3, z_m = 1e-6;
};
// "mm": all three columns; "mm,um": x and y, and z. Known units: m, mm, um, nm.
Result<XyzUnits> xyz_units(const std::string& text);

// Reads one file in pieces of any size. Rows may be in any order, and so may the columns of a
// header; other columns are ignored. A height is missing if its pixel has no row, z is empty or z
// is nan. Lines that begin with # are ignored. Errors name file and line. Without `units` an XYZ
// file has the units of the CSV, with a notice.
class MapTextReader {
 public:
  MapTextReader(std::string source, std::optional<XyzUnits> units)
      : source_(std::move(source)), units_(units) {}
  // Size of the whole file, if known, to reserve memory once.
  void expect_bytes(std::size_t bytes) { bytes_expected_ = bytes; }
  Status feed(std::string_view piece);
  Result<SurfaceMap> finish();
  // Whether the file has a header, whose names state the units. `units` is then not used.
  bool has_header() const { return form_ == Form::csv; }

 private:
  enum class Form { unknown, csv, xyz };
  Status line(std::string_view text);
  Status first_line(std::string_view text);
  Status header(std::string_view text);
  Status csv_row(std::string_view text);
  Status xyz_row(std::string_view text);
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
  double xy_m_ = 1e-3, z_m_ = 1e-6;
  std::string rest_;  // start of a line that continues in the next piece
  std::size_t line_ = 0;
  std::size_t bytes_expected_ = 0;
  MapPoints points_;
  // Starts of groups of points on consecutive lines: (point, its line).
  std::vector<std::pair<std::size_t, std::size_t>> line_groups_;
  Notices notices_;
};

// Writes such a CSV with a row for every pixel, in pieces.
Status write_map_csv(const SurfaceMap& map, const std::function<Status(std::string_view)>& take);

}  // namespace mdof
