// Selects the errors of a table that can be written, and converts them to points of a controller.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// All errors that have any value, in the order of the table; positioning comes last.
std::vector<Series> series_of(const CompensationTable& table);
// The series with this name, or nullptr.
const Series* find_series(const std::vector<Series>& series, const std::string& error);

// `series` without missing values, thinned by options.tolerance_m to at most `most` points. `out`
// gets the counts. Errors (bad_input) state table, error, position and remedy: a missing value,
// unless the range may be cut; too many points, with the required tolerance.
Result<Series> fitted(const Series& series, std::int64_t table, std::size_t most,
                      const ExportOptions& options, Export& out);

// Error: two tables of one axis, because only one can be meant.
Status check_one_table_an_axis(const std::vector<CompensationTable>& tables);

// The lines for the comments of all files: table, hash, sense, marks. Without comment signs.
std::vector<std::string> head_lines(const CompensationTable& table, const ExportOptions& options,
                                    const std::string& sense);
// "tool, 6, -4, -30 mm from the origin of the fixture"
std::string reference_point_text(const StatedAt& at);
// For a comment: converts to ASCII without line ends.
std::string plain_ascii_line(std::string_view text);
// Puts `sign` and a space before each line, and a line end after it.
std::string commented(const std::vector<std::string>& lines, const std::string& sign);

// Mean of both approaches at a position: linear between the points, constant beyond the ends.
double mean_error_at(const Series& series, double position_m);

// Note of a file from whose numbers (`each`: "trim") `taken_m` was subtracted, so that they are 0
// at home.
std::string zeroed_at_home_note(const Series& series, const std::string& each, double taken_m,
                                double home_m);
std::string fixed(double x, int decimals);  // never "-0"

}  // namespace mdof::controllers
