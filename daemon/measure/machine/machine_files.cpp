#include "daemon/measure/machine/machine_files.h"

#include <filesystem>

#include "daemon/measure/machine/table_functions.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/files.h"
#include "schema/base/output/printable.h"
#include "schema/base/sha256.h"
#include "schema/recording/probe_log.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

// Converts µm to m, or µrad to rad. The factor is the same.
std::vector<double> from_key_unit(const std::vector<double>& values) {
  std::vector<double> si;
  for (const double v : values) si.push_back(from_um(v));
  return si;
}

std::vector<double> positions_of(const MachineFrame& frame, const std::vector<double>& column) {
  std::vector<double> positions;
  for (const double p : column) positions.push_back(position_from_written(frame, p));
  return positions;
}

std::string position_column(const MachineFrame& frame) {
  return std::string("position_") + position_unit(frame);
}

// Whether error k is the error of a linear axis along its own direction.
bool is_positioning(const MachineFrame& frame, std::size_t k) {
  return frame.kind == FrameKind::linear && k == frame.direction;
}

// If the file has no standard uncertainty, f.u is the value in MACHINE.toml, for all positions.
Status complete(ErrorFunction& f, std::size_t k, const std::string& where) {
  if (f.u.size() == 1 && f.position.size() != 1) f.u.assign(f.position.size(), f.u.front());
  return check_function(f, k, where);
}

// An opened file: name in MACHINE.toml, path, and the comment line with the hash of the file.
struct OpenedFile {
  std::string name, path, line;

  Status named(Status status) const {
    if (status) return status;
    std::string& message = status.error().message;
    if (const auto at = message.find(path); at != std::string::npos)
      message.replace(at, path.size(), name);
    return status;
  }
};

Result<OpenedFile> open_named(const FindFile& find, const std::string& name) {
  OpenedFile file{name, {}, {}};
  MDOF_TRY(file.path, find(name));
  const auto text = read_text_file(file.path, kMostBytes);
  if (!text) return tl::unexpected(file.named(tl::unexpected(text.error())).error());
  file.line = "# " + printable(name) + ": sha256 " + sha256_hex(*text) + "\n";
  return file;
}

// Reads the sense of the positioning error. `sense`: values of the sense column; empty if the file
// has no such column. Error: the sense is unknown and the axis has travel "-". With travel "+",
// both senses have the same sign.
Status read_sense_column(MachineFrame& frame, const drivers::CsvTable& csv,
                         const std::vector<double>& sense) {
  const std::string name = csv.source + ":" + std::to_string(csv.header_line) + ": " +
                           error_name(frame, frame.direction) + ": ";
  for (const double s : sense)
    if (s != sense.front())
      return bad_input(name + "column " + std::string(kSenseColumn) +
                       " contains both \"command\" and \"body\", but all errors must have the same "
                       "sense; write the same word in each row");
  if (!sense.empty()) {
    const StatedSense stated =
        sense.front() == kCommandSense ? StatedSense::command : StatedSense::body;
    if (frame.positioning_sense != StatedSense::none && frame.positioning_sense != stated)
      return bad_input(name + "column " + std::string(kSenseColumn) + " says \"" +
                       (stated == StatedSense::command ? "command" : "body") +
                       "\", but positioning_sense of axis " + frame.id +
                       " in MACHINE.toml says the opposite; remove the wrong value");
    frame.positioning_sense = stated;
  }
  if (frame.positioning_sense != StatedSense::none || !frame.against_command) return {};
  return bad_input(
      name + "the file does not state the sense of the errors. Axis " + frame.id +
      " has travel \"-\", so the sign of the errors depends on this sense. Add a column " +
      std::string(kSenseColumn) +
      " with \"command\" (actual minus commanded position) or \"body\" (positive in the + "
      "direction of the machine axis), or set positioning_sense for the axis in MACHINE.toml");
}

Status read_own_file(Machine& machine, MachineFrame& frame, std::size_t k,
                     const std::string& path) {
  ErrorFunction& f = frame.error[k];
  const std::string unit = k < 3 ? "_um" : "_urad";
  MDOF_TRY(const auto csv,
           drivers::read_csv_table(path, {position_column(frame), "deviation" + unit},
                                   {"reverse" + unit, "u" + unit, std::string(kSenseColumn)}));
  if (is_positioning(frame, k)) MDOF_CHECK(read_sense_column(frame, csv, csv.columns[4]));
  f.position = positions_of(frame, csv.columns[0]);
  f.forward = from_key_unit(csv.columns[1]);
  f.reverse = from_key_unit(csv.columns[2]);
  if (!csv.columns[3].empty()) f.u = from_key_unit(csv.columns[3]);
  machine.simulated = machine.simulated || csv.simulated;
  f.noise_only = csv.noise_only;
  return complete(f, k, csv.source + ": " + error_name(frame, k));
}

// Reads a file with up to six columns for each error. The file must contain at least one error. A
// column without values is treated as missing. If an error has values for one approach only, these
// values are used for the other approach, too.
Status read_shared_file(Machine& machine, MachineFrame& frame, const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const std::string key = with_unit(error_name(frame, k), k);
    for (const char* prefix : {"", "forward_", "reverse_", "u_", "u_forward_", "u_reverse_"})
      names.push_back(prefix + key);
  }
  const std::size_t sense = 1 + names.size();
  names.emplace_back(kSenseColumn);
  MDOF_TRY(const auto csv, drivers::read_csv_table(path, {position_column(frame)}, names));
  bool any = false;
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const auto column = [&](std::size_t i) { return from_key_unit(csv.columns[1 + 6 * k + i]); };
    auto forward = column(0).empty() ? column(1) : column(0);
    if (forward.empty()) forward = column(2);
    const std::string where = csv.source + ": " + error_name(frame, k);
    ErrorFunction& f = frame.error[k];
    const std::vector<double> declared = f.u;
    if (forward.empty() && !declared.empty() && !f.known() && f.file.empty())
      return bad_input(where + " is missing, but MACHINE.toml contains u_" +
                       with_unit(error_name(frame, k), k) +
                       "; add the column of the error, or remove this key");
    if (forward.empty()) continue;
    if (f.known() || !f.file.empty())
      return bad_input(where + " is also in MACHINE.toml; give this error only once");
    if (is_positioning(frame, k)) MDOF_CHECK(read_sense_column(frame, csv, csv.columns[sense]));
    f.position = positions_of(frame, csv.columns[0]);
    f.forward = forward;
    f.reverse = column(2);
    f.u = column(3);
    if (f.u.empty())
      f.u = column(4).empty() || column(5).empty() ? column(4) : larger(column(4), column(5));
    if (f.u.empty()) f.u = column(5);
    if (f.u.empty()) f.u = declared;
    f.noise_only = csv.noise_only;
    MDOF_CHECK(complete(f, k, where));
    any = true;
  }
  machine.simulated = machine.simulated || csv.simulated;
  if (any) return {};
  return bad_input(csv.source + ": no column contains an error of axis " + frame.id + ", such as " +
                   names[0] + "; add such a column, or rename the column that contains the error");
}

}  // namespace

bool has_table_files(const Machine& machine) {
  for (const MachineFrame& frame : machine.frames) {
    if (!frame.file.empty()) return true;
    for (const ErrorFunction& error : frame.error)
      if (!error.file.empty()) return true;
  }
  return false;
}

Result<std::string> read_machine_files(Machine& machine, const FindFile& find) {
  std::string lines;
  for (MachineFrame& frame : machine.frames) {
    if (!frame.file.empty()) {
      MDOF_TRY(const OpenedFile file, open_named(find, frame.file));
      MDOF_CHECK(file.named(read_shared_file(machine, frame, file.path)));
      lines += file.line;
    }
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      if (frame.error[k].file.empty()) continue;
      MDOF_TRY(const OpenedFile file, open_named(find, frame.error[k].file));
      MDOF_CHECK(file.named(read_own_file(machine, frame, k, file.path)));
      lines += file.line;
    }
    convert_positioning(frame);
  }
  add_curvatures(machine);
  return lines;
}

FindFile files_in_same_folder(const std::string& machine_file) {
  return [folder = std::filesystem::path(machine_file).parent_path()](
             const std::string& name) -> Result<std::string> { return (folder / name).string(); };
}

}  // namespace mdof::daemon
