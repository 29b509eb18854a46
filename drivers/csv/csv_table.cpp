#include "drivers/csv/csv_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "drivers/csv/csv_rows.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers {
namespace {

std::string stem_of(const std::string& name) {
  return name.substr(0, name.rfind('_'));
}

tl::unexpected<Error> no_column(const CsvHeader& header, const std::string& name) {
  const std::string place = header.source + ":" + std::to_string(header.lines) + ": ";
  std::string found;
  for (const std::string& column : header.columns) {
    if (stem_of(column) == stem_of(name))
      return bad_input(place + "column " + column +
                       " does not have the expected unit; convert the values and " +
                       "rename the column to " + name);
    found += (found.empty() ? "" : ", ") + column;
  }
  return bad_input(place + "no column " + name + " (columns: " + found +
                   "); add this column, or rename the column that contains these values");
}

// Returns the index of the channel for each column name.
Result<std::vector<std::size_t>> channels_of(const CsvHeader& header,
                                             const std::vector<std::string>& names) {
  std::vector<std::size_t> channels;
  for (const std::string& name : names) {
    const auto at =
        std::find_if(header.channel_columns.begin(), header.channel_columns.end(),
                     [&](std::size_t column) { return header.columns[column] == name; });
    if (at == header.channel_columns.end()) return no_column(header, name);
    channels.push_back(static_cast<std::size_t>(at - header.channel_columns.begin()));
  }
  return channels;
}

// Also requests a column that has the same name with another unit, so that channels_of() reports
// the wrong unit.
std::vector<std::string> existing_columns(const CsvHeader& header, std::vector<std::string> names,
                                          const std::vector<std::string>& optional) {
  for (const std::string& name : optional)
    if (std::any_of(header.columns.begin(), header.columns.end(),
                    [&](const std::string& column) { return stem_of(column) == stem_of(name); }))
      names.push_back(name);
  return names;
}

std::string folded(const std::string& name) {
  std::string text;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// The capital letters and digits of a name, which name its quantity: "EXX" of "reverse_EXX_um".
std::string quantity_of(const std::string& name) {
  std::string quantity;
  for (const unsigned char c : name)
    if (std::isupper(c) != 0 || std::isdigit(c) != 0) quantity += static_cast<char>(c);
  return quantity;
}

std::string unit_of(const std::string& name) {
  return name.substr(name.rfind('_') + 1);  // without "_": the name
}

// Whether `column` is a misspelt `name`: "Direction", "runs", "dirction", "revers_EXX_um". Returns
// false for short names. A name with a capital letter must have the same quantity and unit, because
// a name that differs in these can be another quantity (EYX_um, EZX_um).
bool is_misspelling(const std::string& column, const std::string& name) {
  constexpr std::size_t kLongName = 5;
  const std::string is = folded(column), wanted = folded(name);
  if (is == wanted || is == wanted + "s") return true;
  const bool plain =
      std::none_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c) != 0; });
  if (!plain && (quantity_of(column) != quantity_of(name) || unit_of(column) != unit_of(name)))
    return false;
  return wanted.size() > kLongName && edit_distance(is, wanted) <= 1;
}

// Without this check, an optional column with a misspelt name would be ignored without a message.
Status check_misspelt_columns(const CsvHeader& header, const std::vector<std::string>& names,
                              const std::vector<std::string>& optional) {
  const auto is_read = [&](const std::string& column) {
    return std::find(names.begin(), names.end(), column) != names.end() ||
           std::find(optional.begin(), optional.end(), column) != optional.end();
  };
  for (const std::string& name : optional) {
    if (std::find(header.columns.begin(), header.columns.end(), name) != header.columns.end())
      continue;
    for (const std::string& column : header.columns)
      if (!is_read(column) && is_misspelling(column, name))
        return bad_input(header.source + ":" + std::to_string(header.lines) + ": column " + column +
                         " is not read. If this column contains the values of " + name +
                         ", rename the column to " + name + "; if not, delete the column");
  }
  return {};
}

void place_optional_columns(CsvTable& table, const std::vector<std::string>& wanted,
                            std::size_t required, const std::vector<std::string>& optional) {
  std::size_t there = required;
  for (std::size_t i = 0; i < optional.size(); ++i) {
    if (there < wanted.size() && wanted[there] == optional[i])
      ++there;
    else
      table.columns.emplace(table.columns.begin() + static_cast<std::ptrdiff_t>(required + i));
  }
}

bool is_missing(double x) {
  return std::isnan(x);
}

// The columns from index `required` on are optional: they may be empty in all rows.
Status check_values(CsvTable& table, const std::vector<std::string>& names, std::size_t required) {
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<double>& value = table.columns[k];
    const auto missing = std::find_if(value.begin(), value.end(), is_missing);
    if (missing == value.end()) continue;
    if (k < required || !std::all_of(value.begin(), value.end(), is_missing))
      return bad_input(table.where(static_cast<std::size_t>(missing - value.begin())) + "column " +
                       names[k] + ": no value (empty or nan); add the value or delete the line");
    value.clear();
  }
  return {};
}

Status append(CsvTable& table, const SampleBlock& block, const std::vector<std::size_t>& channels,
              std::size_t most_rows) {
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const std::vector<double>& value = block.value[channels[k]];
    table.columns[k].insert(table.columns[k].end(), value.begin(), value.end());
  }
  if (table.rows() <= most_rows) return {};
  return bad_input(table.source + ": has more than " + std::to_string(most_rows) +
                   " rows, which is the limit; leave out rows");
}

}  // namespace

// The line number is correct, because no line between the rows is skipped (bad_lines = 0).
std::string CsvTable::where(std::size_t row) const {
  return source + ":" + std::to_string(header_line + 1 + row) + ": ";
}

Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& names,
                                const std::vector<std::string>& optional, std::size_t most_rows,
                                int descriptor) {
  CsvRowsOptions options;
  options.kind = CsvKind::table;
  options.limits.bad_lines = 0;
  options.sha256 = false;
  options.descriptor = descriptor;
  MDOF_TRY(const auto rows, CsvRows::open(path, options));
  const CsvHeader& header = rows->header();
  CsvTable table;
  table.source = header.source;
  table.header_line = header.lines;
  table.simulated = header.is_marked_simulated();
  table.noise_only = header.is_marked_noise_only();
  MDOF_CHECK(check_misspelt_columns(header, names, optional));
  const auto wanted = existing_columns(header, names, optional);
  MDOF_TRY(const auto channels, channels_of(header, wanted));
  table.columns.resize(wanted.size());
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const ReadState state, rows->next(block));
    if (state == ReadState::end) break;
    MDOF_CHECK(append(table, block, channels, most_rows));
  }
  MDOF_CHECK(check_values(table, wanted, names.size()));
  place_optional_columns(table, wanted, names.size(), optional);
  return table;
}

}  // namespace mdof::drivers
