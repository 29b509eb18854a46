#include "schema/recording/probe_log.h"

#include <algorithm>
#include <array>
#include <optional>

#include "schema/base/trimmed.h"

namespace mdof {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr const char* kTimeColumn = "time_s";
constexpr const char* kEncoderColumn = "encoder_mm";
constexpr std::string_view kTimeName = "time";

std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    fields.emplace_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::string where(const CsvHeader& header) {
  return header.source + ":" + std::to_string(header.lines) + ": ";
}

std::string where(const CsvHeader& header, std::size_t column) {
  return where(header) + "column " + std::to_string(column + 1) + " \"" + header.columns[column] +
         "\": ";
}

// Returns the channel of a column; nullopt: the unit is unknown.
std::optional<Channel> channel_of(const std::string& name) {
  static constexpr std::array kRead = {Unit::um, Unit::mm, Unit::volt, Unit::deg_c};
  static constexpr std::array kKept = {"s", "hz", "urad", "deg", "percent", "hPa", "kPa"};
  const std::size_t bar = name.rfind('_');
  if (bar == name.npos) return Channel{name, Unit::other};
  const std::string id = name.substr(0, bar), unit = name.substr(bar + 1);
  for (const Unit known : kRead)
    if (unit == suffix(known)) return Channel{id, known};
  if (id == kEncoderChannel && unit == suffix(Unit::metre)) return Channel{id, Unit::metre};
  if (std::find(kKept.begin(), kKept.end(), unit) != kKept.end()) return Channel{name, Unit::other};
  return std::nullopt;
}

char separator_of(std::string_view header_line) {
  for (const char separator : {',', ';', '\t'})
    if (header_line.find(separator) != header_line.npos) return separator;
  return ',';
}

// The message states which setting to change.
Status check_separator(const CsvHeader& header) {
  if (header.separator == ',' || header.kind != CsvKind::stream) return {};
  return bad_input(where(header) + "columns are separated by " +
                   (header.separator == ';' ? "semicolons, probably with decimal commas" : "tabs") +
                   "; send commas between columns and '.' in numbers");
}

std::string example_of(CsvKind kind) {
  if (kind == CsvKind::table) return "position_mm,deviation_um";
  return std::string(kind == CsvKind::probe_log ? "time_s," : "") + "encoder_mm,A_um,B_um";
}

Status check_first_name(const CsvHeader& header) {
  const std::string& name = header.columns[0];
  if (name.empty() || (name[0] != '-' && (name[0] < '0' || name[0] > '9'))) return {};
  return bad_input(where(header) +
                   "the line has numbers instead of the header; insert a header such as \"" +
                   example_of(header.kind) + "\" before this line");
}

bool has_time(CsvKind kind) {
  return kind == CsvKind::probe_log || kind == CsvKind::stream;
}

// Whether `name` is `of`, with or without a suffix: "encoder", "encoder_counts".
bool is_named(std::string_view name, std::string_view of) {
  return name == of || (name.starts_with(of) && name.substr(of.size()).starts_with('_'));
}

// Time and position must have known units. The message suggests the name that the user probably
// meant.
Status check_unit(const CsvHeader& header, std::size_t column) {
  const std::string& name = header.columns[column];
  if (is_named(name, kTimeName) && name != kTimeColumn && has_time(header.kind))
    return bad_input(where(header, column) +
                     (name == kTimeName ? "has no unit" : "the time must be in seconds") +
                     "; give seconds from the start and name the column time_s");
  if (!is_named(name, kEncoderChannel)) return {};
  for (const char* known : {kEncoderColumn, "encoder_um", "encoder_m", "encoder_V"})
    if (name == known) return {};
  return bad_input(where(header, column) +
                   (name == kEncoderChannel
                        ? "has no unit; name the column encoder_mm, "
                          "encoder_um, encoder_m or encoder_V"
                        : "the axis position must be in mm, um or m, or in V "
                          "if the rig has [encoder] um_per_V; convert the values "
                          "and name the column encoder_mm"));
}

bool is_of_words(std::string_view name) {
  return name == "u_covers" || name == "not_declared" || name == "u_not_declared" ||
         name == "flags" || name == "reason" || name == "travel";
}

Status add_column(CsvHeader& header, std::size_t column) {
  const std::string& name = header.columns[column];
  if (name.empty())
    return bad_input(where(header, column) +
                     "has no name; give the column a name or remove its comma");
  if (name == kTimeColumn && has_time(header.kind)) {
    if (header.time_column >= 0)
      return bad_input(where(header, column) + "is given twice; remove one of the columns");
    header.time_column = static_cast<int>(column);
    return {};
  }
  if (header.kind == CsvKind::table && is_of_words(name)) return {};
  MDOF_CHECK(check_unit(header, column));
  const std::optional<Channel> channel = header.kind == CsvKind::table && name == kSenseColumn
                                             ? Channel{name, Unit::other}
                                             : channel_of(name);
  if (!channel || channel->id.empty())
    return bad_input(where(header, column) + "unknown unit; " +
                     (header.kind == CsvKind::table
                          ? "known units are _um, _mm and _urad; convert the values and rename the "
                            "column"
                          : "known units are _um, _mm, _V and _C (columns in _s, _hz, _urad, _deg, "
                            "_percent, _hPa or _kPa are allowed, but not read); convert the values "
                            "(probes to um), or rename the column"));
  for (std::size_t k = 0; k < header.channels.size(); ++k)
    if (header.channels[k].id == channel->id)
      return bad_input(where(header, column) + "channel \"" + channel->id +
                       "\" is given twice (also as " + header.columns[header.channel_columns[k]] +
                       "); remove one of the columns");
  header.channels.push_back(*channel);
  header.channel_columns.push_back(column);
  return {};
}

Status check_required(const CsvHeader& header) {
  auto missing = [&](const char* name) {
    std::string found;
    for (const std::string& column : header.columns) found += (found.empty() ? "" : ", ") + column;
    return bad_input(
        where(header) + "no column " + name + " (columns: " + found +
        "); add this column, or rename the column that contains these values" +
        (header.columns.size() == 1
             ? "; if this line stands before the header, delete the line, or put # at its beginning"
             : ""));
  };
  if (header.kind == CsvKind::probe_log && header.time_column < 0) return missing(kTimeColumn);
  if (header.kind == CsvKind::table) return {};
  if (header.kind == CsvKind::stream) return header.channels.empty() ? missing("A_um") : Status{};
  const bool encoder =
      std::any_of(header.channels.begin(), header.channels.end(),
                  [](const Channel& channel) { return channel.id == kEncoderChannel; });
  if (!encoder) return missing(kEncoderColumn);
  if (header.channels.size() < 2)
    return bad_input(where(header) +
                     "the header has no column of a probe; add columns such as A_um");
  return {};
}

Status parse_names(CsvHeader& header, std::string_view line) {
  if (line.starts_with('"') && header.kind != CsvKind::table)
    return bad_input(where(header) +
                     "the names of the columns are in quotes; save the file without quotes");
  header.separator = separator_of(line);
  MDOF_CHECK(check_separator(header));
  header.columns = split(line, header.separator);
  MDOF_CHECK(check_first_name(header));
  for (std::size_t column = 0; column < header.columns.size(); ++column)
    MDOF_CHECK(add_column(header, column));
  return check_required(header);
}

Status check_encoding(std::string_view text, const std::string& source) {
  if (text.empty())
    return bad_input(source + ": the file is empty; check that the recording was saved");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return bad_input(source + ": the file is UTF-16; save the file as plain CSV (UTF-8)");
  return {};
}

}  // namespace

bool CsvHeader::may_be_missing(std::size_t channel) const {
  return kind == CsvKind::stream || kind == CsvKind::table ||
         channels[channel].id != kEncoderChannel;
}

bool CsvHeader::has_text_columns() const {
  return kind == CsvKind::table &&
         std::any_of(columns.begin(), columns.end(),
                     [](const auto& name) { return is_of_words(name) || name == kSenseColumn; });
}

bool CsvHeader::is_marked_simulated() const {
  return std::any_of(
      comments.begin(), comments.end(),
      [](const std::string& text) {  // "simulated": a log; "SIMULATED": an export of a run
        return text.starts_with("simulated") || text.starts_with("SIMULATED");
      });
}

bool CsvHeader::is_marked_noise_only() const {
  return std::any_of(comments.begin(), comments.end(),
                     [](const std::string& text) { return text.starts_with("NOISE ONLY"); });
}

Result<CsvHeader> parse_csv_header(std::string_view text, CsvKind kind, const std::string& source) {
  MDOF_CHECK(check_encoding(text, source));
  CsvHeader header;
  header.kind = kind;
  header.source = source;
  if (text.starts_with(kByteOrderMark)) header.bytes = kByteOrderMark.size();
  while (header.bytes < text.size()) {
    const std::size_t end = std::min(text.find('\n', header.bytes), text.size());
    const std::string_view line = trimmed(text.substr(header.bytes, end - header.bytes));
    header.bytes = std::min(end + 1, text.size());
    ++header.lines;
    if (line.starts_with('#')) {
      header.comments.emplace_back(trimmed(line.substr(1)));
    } else if (!line.empty()) {
      MDOF_CHECK(parse_names(header, line));
      return header;
    }
  }
  return bad_input(
      source + ": no header line in the first " + std::to_string(header.lines) +
      " lines, only comments; add a header that names the columns, such as time_s,encoder_mm,A_um");
}

}  // namespace mdof
