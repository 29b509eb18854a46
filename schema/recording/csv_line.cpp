#include "schema/recording/csv_line.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number.h"
#include "schema/base/number/seconds.h"
#include "schema/base/trimmed.h"

namespace mdof {
namespace {

using State = CsvLine::State;

// A quoted field ends after a quote that is not doubled (RFC 4180).
std::size_t end_of_field(std::string_view line, std::size_t begin, bool may_be_quoted) {
  std::size_t from = begin;
  if (may_be_quoted && begin < line.size() && line[begin] == '"')
    from = std::min(line.find('"', begin + 1), line.size());
  while (from + 1 < line.size() && line[from] == '"' && line[from + 1] == '"')
    from = std::min(line.find('"', from + 2), line.size());
  return std::min(line.find(',', from), line.size());
}

std::vector<std::string_view> split(std::string_view line, bool may_be_quoted) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = end_of_field(line, begin, may_be_quoted);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::string_view without_plus(std::string_view field) {
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  return field.substr(plus ? 1 : 0);
}

bool parse_whole_field(std::string_view field, double& x) {
  const char* const end = field.data() + field.size();
  return !field.empty() && parse_double(field.data(), end, x) == end;
}

// Returns a short, printable form of a field for messages.
std::string quoted(std::string_view field) {
  std::string text = "\"";
  for (const char c : field.substr(0, 40)) text += c >= ' ' && c < 127 ? c : '?';
  return text + (field.size() > 40 ? "...\"" : "\"");
}

// Returns the reason why the field is invalid; empty: the field is a finite number.
std::string reason_against(std::string_view field, bool parsed, double x) {
  if (field.empty()) return "is empty";
  if (!parsed) return quoted(field) + " is not a number";
  if (!std::isfinite(x)) return quoted(field) + " is not a finite number";
  return {};
}

CsvLine wrong_count(std::string_view line, std::size_t fields, std::size_t columns) {
  CsvLine result;
  result.state = State::bad;
  result.reason = std::to_string(fields) + " fields in the line, but the header has " +
                  std::to_string(columns) + " columns";
  if (fields == 1 && line.find(';') != line.npos) {
    result.state = State::fatal;
    result.reason +=
        "; columns are separated by semicolons: save the file with commas between "
        "columns and '.' in numbers, not a decimal comma";
  } else if (2 * fields > 3 * columns && line.find('.') == line.npos) {
    result.state = State::fatal;
    result.reason += "; numbers have a decimal comma: save the file with '.' in numbers";
  }
  return result;
}

bool read_sense(std::string_view word, double& x) {
  x = word == "command" ? kCommandSense : kBodySense;
  return word == "command" || word == "body";
}

// Whether the reader uses the column.
bool is_read(const CsvHeader& header, std::size_t column) {
  return std::find(header.channel_columns.begin(), header.channel_columns.end(), column) !=
         header.channel_columns.end();
}

}  // namespace

bool is_missing_value(std::string_view field) {
  if (field.starts_with('-')) field.remove_prefix(1);  // the "-nan" of printf
  const auto is = [&](std::size_t i, char c) { return (field[i] | 0x20) == c; };
  return field.empty() || (field.size() == 3 && is(0, 'n') && is(1, 'a') && is(2, 'n'));
}

Result<bool> is_between_rows(std::string_view line, const CsvHeader& header) {
  line = trimmed(line);
  if (header.has_text_columns() || line.empty()) return false;
  if (line[0] == '#') return true;
  if (header.time_column < 0) return false;
  const std::vector<std::string_view> fields = split(line, false);
  const std::string& time = header.columns[static_cast<std::size_t>(header.time_column)];
  if (std::find(fields.begin(), fields.end(), time) == fields.end()) return false;
  if (std::equal(fields.begin(), fields.end(), header.columns.begin(), header.columns.end()))
    return true;
  return bad_input(
      "this header has other columns than the header at the start of the file; split the file "
      "before this line");
}

CsvLine parse_csv_line(std::string_view line, const CsvHeader& header) {
  CsvLine result;
  line = trimmed(line);
  if (line.empty()) {
    result.state = State::blank;
    return result;
  }
  const bool words = header.has_text_columns();
  const std::vector<std::string_view> fields = split(line, words);
  if (fields.size() != header.columns.size())
    return wrong_count(line, fields.size(), header.columns.size());
  for (std::size_t column = 0; column < fields.size(); ++column) {
    const std::string_view field = without_plus(fields[column]);
    const bool is_time = static_cast<int>(column) == header.time_column;
    if (words && !is_read(header, column)) continue;
    if (!is_time && is_missing_value(field) && header.may_be_missing(result.values.size())) {
      result.values.push_back(kNaN);
      continue;
    }
    double x = 0;
    const bool is_sense = words && header.columns[column] == kSenseColumn;
    const bool parsed = is_sense ? read_sense(field, x) : parse_whole_field(field, x);
    std::string reason = is_sense && !parsed ? quoted(field) + " is not valid; give command or body"
                                             : reason_against(field, parsed, x);
    if (!is_time) {
      result.values.push_back(x);
    } else if (reason.empty() && !parse_seconds(field, result.time_ns)) {
      reason = quoted(field) + " s is not a time; give seconds from the start of the recording";
    }
    if (reason.empty()) continue;
    result.state = State::bad;
    result.reason = "column " + header.columns[column] + ": " + reason;
    return result;
  }
  return result;
}

}  // namespace mdof
