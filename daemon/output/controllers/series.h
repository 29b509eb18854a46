// What of a table can be written, and how it becomes points of a controller.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Of each error that has any value, in the order of the table; positioning last.
std::vector<Series> series_of(const CompensationTable& table);
// That of this name; nullptr: the table has none.
const Series* find_series(const std::vector<Series>& series, const std::string& error);

// `series` without holes, thinned by options.tolerance_m and not longer than `most` points; what
// became of it goes to `out`. Errors (bad_input) name table, error, position and remedy: a missing
// value, unless the range is to be cut; too many points, with the tolerance that would do.
Result<Series> fitted(const Series& series, std::int64_t table, std::size_t most,
                      const ExportOptions& options, Export& out);

// Of two tables of one axis only one can be meant.
Status check_one_table_an_axis(const std::vector<CompensationTable>& tables);

// The lines that every file with comments has: table, hash, sense, marks. Without comment signs.
std::vector<std::string> head_lines(const CompensationTable& table, const ExportOptions& options,
                                    const std::string& sense);
// "tool, 6, -4, -30 mm from the origin of the fixture"
std::string stated_place(const StatedAt& at);
// For a comment: in ASCII and without ends of lines.
std::string one_plain_line(std::string_view text);
// Each behind `sign` and a blank, with an end of line.
std::string commented(const std::vector<std::string>& lines, const std::string& sign);

// Mean of both approaches at a position: linear between the points, the ends held.
double mean_error_at(const Series& series, double position_m);

// What a file says whose numbers (`each`: "trim") had `taken_m` subtracted, so that they are 0 at
// home.
std::string zeroed_at_home_note(const Series& series, const std::string& each, double taken_m,
                                double home_m);
std::string fixed(double x, int decimals);  // never "-0"

}  // namespace mdof::controllers
