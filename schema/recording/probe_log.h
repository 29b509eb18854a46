// The CSV files of the bench: what their header says, and the errors it can have.
//
//   # any comment                                   no or more such lines
//   time_s,encoder_mm,A_um,B_um,temperature_C       probe log: time_s and encoder_mm must be there
//   encoder_mm,A_um,B_um                            frames: encoder_mm must be there
//   A_um,B_um                                       stream: live rows, any channels, time_s or not
//   position_mm,deviation_um                        table: measured series; the reader says which
//
// Columns in any order; comma separated, '.' decimal, LF or CRLF, a UTF-8 byte order mark is
// skipped. A column "A_um" is channel "A" in micrometres. Suffixes: _um _mm _V _C; a column that
// ends in another unit of the project (_s _hz _urad _deg _percent _hPa) or in none is kept as
// Unit::other under its whole name; any other suffix is an error. The axis position may also be
// encoder_um, encoder_m or, where the rig says its scale, encoder_V; in no other unit, and time in
// seconds alone.
//
// A table may have the columns of words of mdof's own documents (u_covers, not_declared, flags,
// reason, travel), which are not read and may be quoted; and positioning_sense with "command" or
// "body", which is read as kCommandSense or kBodySense.
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
  probe_log,  // samples against time: time_s must grow from row to row
  stream,     // rows as they come from a device
  frames,     // positions and readings in any order; time_s, if there, is a column like any other
  table,      // any named columns, in any order of rows; any cell may be missing
};

inline constexpr std::string_view kSenseColumn = "positioning_sense";
inline constexpr double kCommandSense = 1, kBodySense = 0;

struct CsvHeader {
  CsvKind kind = CsvKind::probe_log;
  std::string source;                        // file name, for messages
  std::vector<std::string> comments;         // without '#' and outer spaces
  std::vector<std::string> columns;          // names as in the file
  int time_column = -1;                      // -1: none (frames, stream)
  std::vector<Channel> channels;             // all other columns, in their order
  std::vector<std::size_t> channel_columns;  // [channel] -> column
  std::uint64_t lines = 0;                   // of the file, header included
  std::size_t bytes = 0;                     // of the file, header included

  // Whether a field of this channel may be empty or nan: a missing value. Not that of the encoder,
  // without which a row has no place (but for a stream, whose channels come when they come, and a
  // table, whose reader says which cells it needs).
  bool may_be_missing(std::size_t channel) const;
  // Whether a column of words is among them, so that a field may be quoted.
  bool has_words() const;
  // A comment begins so: no machine is behind the numbers.
  bool says_simulated() const;
  // A comment begins so: u is that of noise and repeatability.
  bool says_noise_only() const;
};

// `text` is the beginning of a file, or all of it; it must reach beyond the header line.
Result<CsvHeader> parse_csv_header(std::string_view text, CsvKind kind, const std::string& source);

}  // namespace mdof
