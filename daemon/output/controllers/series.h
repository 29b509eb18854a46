// Selects the errors of a table that can be written, and converts them to the points of a
// controller file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// All errors that have at least one finite value, in the order of the table. The positioning error
// is the last one.
std::vector<Series> series_of(const CompensationTable& table);
// The series with this name, or nullptr.
const Series* find_series(const std::vector<Series>& series, const std::string& error);

// Returns `series` without missing values, with points omitted within options.tolerance_m, and with
// at most `most` points. Adds the numbers of points to out.written. Errors (bad_input; the message
// names the table and the error):
// - a value is missing and options.cut_range is false; the message states the position
// - there are no two neighbouring positions with values for both approaches
// - more than `most` points; the message states the tolerance that is required
Result<Series> fitted(const Series& series, std::int64_t table, std::size_t most,
                      const ExportOptions& options, Export& out);

// Error (usage): two tables are for the same axis.
Status check_one_table_an_axis(const std::vector<CompensationTable>& tables);
// Error (usage): two tables contain the same error.
Status check_no_error_twice(const std::vector<CompensationTable>& tables);

// With options.cut_range: for each error with missing values, a text that states the missing value
// and the exported range. The files contain these texts.
std::vector<std::string> cut_range_texts(const CompensationTable& table);

// The lines of the comment at the beginning of a file: number and hash of the table, meaning of the
// values, warnings. The lines contain no comment signs.
std::vector<std::string> head_lines(const CompensationTable& table, const ExportOptions& options,
                                    const std::string& sense);
// Describes the reference point: its name and its position in mm from the origin of the measuring
// fixture.
std::string reference_point_text(const StatedAt& at);
// Converts a text to one line of printable ASCII characters, for a comment in a file.
std::string plain_ascii_line(std::string_view text);
// Joins the lines to a text. Each line begins with `sign` and a space.
std::string commented(const std::vector<std::string>& lines, const std::string& sign);

// The mean of both approaches at a position, interpolated linearly. Beyond the ends of the series,
// the result is the value at the end.
double mean_error_at(const Series& series, double position_m);

// The note that `taken_m` was subtracted from all numbers in a file, and that the number at home is
// therefore 0. `each`: name of one number, "trim".
std::string zeroed_at_home_note(const Series& series, const std::string& each, double taken_m,
                                double home_m);
std::string fixed(double x, int decimals);  // "0" instead of "-0"

}  // namespace mdof::controllers
