// The header of CSV files with measurements, and the errors in such headers.
//
//   # any comment                                   zero or more such lines
//   time_s,encoder_mm,A_um,B_um,temperature_C       probe log: time_s and encoder_mm are required
//   encoder_mm,A_um,B_um                            frames: encoder_mm is required
//   A_um,B_um                                       stream: live rows, any channels, time_s or not
//   position_mm,deviation_um                        table: measured series, any columns
//
// Columns may have any order. Fields are separated by commas, and the decimal sign is '.'. If the
// header has no comma, the fields may be separated by semicolons or tabs, and the decimal sign may
// be a comma (not in a stream). Lines end in LF or CRLF, and a UTF-8 byte order mark is skipped. A
// column "A_um" is channel "A" in micrometres. Suffixes: _um _mm _V _C. A column with another unit
// of the project (_s _hz _urad _deg _percent _hPa _kPa) or without a unit is kept as Unit::other
// under its whole name; any other suffix is an error. The axis position may also be encoder_um,
// encoder_m or, if the rig declares the scale, encoder_V. Time must be in seconds.
//
// A table may contain the text columns of mdof's own documents (u_covers, not_declared, flags,
// reason, travel); they are not read and may be quoted. It may also contain positioning_sense with
// "command" or "body", which is read as kCommandSense or kBodySense.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof {

enum class CsvKind {
  probe_log,  // samples as a function of time; time_s must increase from row to row
  stream,     // rows as a device sends them
  frames,     // positions and readings in any order; time_s is optional and has no special meaning
  table,      // columns with any names, rows in any order; any cell may be empty
};

inline constexpr std::string_view kSenseColumn = "positioning_sense";
inline constexpr double kCommandSense = 1, kBodySense = 0;

struct CsvHeader {
  CsvKind kind = CsvKind::probe_log;
  std::string source;                 // file name, for messages
  std::vector<std::string> comments;  // without '#' and outer spaces
  std::vector<std::string> columns;   // names as in the file
  int time_column = -1;           // index of the time column; -1: no time column (frames, stream)
  std::vector<Channel> channels;  // all other columns, in the order of the file
  std::vector<std::size_t> channel_columns;  // [channel] -> column
  char separator = ',';                      // of the fields: ',', ';' or tab
  std::uint64_t lines = 0;                   // number of lines up to and including the header
  std::size_t bytes = 0;                     // number of bytes up to and including the header

  // Whether a field of this channel may be empty or nan, which means a missing value. The encoder
  // must have a value, because a row without it has no position. There are two exceptions: in a
  // stream, the channels arrive independently of each other; in a table, the reader checks which
  // cells are required.
  bool may_be_missing(std::size_t channel) const;
  // Whether the file has a text column, so that fields may be quoted.
  bool has_text_columns() const;
  // Whether a comment begins with "simulated" or "SIMULATED": the data were not measured on a
  // machine.
  bool is_marked_simulated() const;
  // Whether a comment states that u contains noise and repeatability only.
  bool is_marked_noise_only() const;
};

// `text`: the whole file or its beginning; it must contain the complete header line.
Result<CsvHeader> parse_csv_header(std::string_view text, CsvKind kind, const std::string& source);

}  // namespace mdof
