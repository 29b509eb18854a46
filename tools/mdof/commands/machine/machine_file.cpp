#include "tools/mdof/commands/machine/machine_file.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "daemon/measure/machine/stored_errors.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/files.h"
#include "schema/units.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kAxisLetters = "XYZABC";

// µm and µrad to m and rad: the same power of ten.
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

// A standard uncertainty of MACHINE.toml holds where the file has none.
Status take(ErrorFunction& f, std::size_t k, const std::string& where) {
  if (f.u.size() == 1 && f.position.size() != 1) f.u.assign(f.position.size(), f.u.front());
  return check_function(f, k, where);
}

Status read_own_file(Machine& machine, MachineFrame& frame, std::size_t k,
                     const std::filesystem::path& folder) {
  ErrorFunction& f = frame.error[k];
  const std::string unit = k < 3 ? "_um" : "_urad";
  MDOF_TRY(const auto csv, drivers::read_csv_table((folder / f.file).string(),
                                                   {position_column(frame), "deviation" + unit},
                                                   {"reverse" + unit, "u" + unit}));
  f.position = positions_of(frame, csv.columns[0]);
  f.forward = from_key_unit(csv.columns[1]);
  f.reverse = from_key_unit(csv.columns[2]);
  if (!csv.columns[3].empty()) f.u = from_key_unit(csv.columns[3]);
  machine.simulated = machine.simulated || csv.simulated;
  machine.noise_only = machine.noise_only || csv.noise_only;
  return take(f, k, csv.source + ": " + error_name(frame, k));
}

// Four columns an error, none of which has to be there: but one of all.
Status read_shared_file(Machine& machine, MachineFrame& frame,
                        const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const std::string key = with_unit(error_name(frame, k), k);
    for (const char* prefix : {"", "forward_", "reverse_", "u_", "u_forward_"})
      names.push_back(prefix + key);
  }
  MDOF_TRY(const auto csv, drivers::read_csv_table((folder / frame.file).string(),
                                                   {position_column(frame)}, names));
  bool any = false;
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const auto column = [&](std::size_t i) { return from_key_unit(csv.columns[1 + 5 * k + i]); };
    const auto forward = column(0).empty() ? column(1) : column(0);
    if (forward.empty()) continue;
    const std::string where = csv.source + ": " + error_name(frame, k);
    ErrorFunction& f = frame.error[k];
    if (f.known() || !f.file.empty())
      return bad_input(where + " is in MACHINE.toml too; give it once");
    f.position = positions_of(frame, csv.columns[0]);
    f.forward = forward;
    f.reverse = column(2);
    f.u = column(3).empty() ? column(4) : column(3);
    MDOF_CHECK(take(f, k, where));
    any = true;
  }
  machine.simulated = machine.simulated || csv.simulated;
  machine.noise_only = machine.noise_only || csv.noise_only;
  if (any) return {};
  return bad_input(csv.source + ": no column of an error of axis " + frame.id + ", such as " +
                   names[0] + "; add it or rename the one that holds it");
}

Result<double> number_in(const std::string& text, const std::string& whole) {
  double x = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, x);
  if (error == std::errc() && last == end && std::isfinite(x) && std::abs(x) < 1e6) return x;
  return fail(ErrorCode::usage, "\"" + whole +
                                    "\" is no place; write X,Y,Z in mm, such as 10,20,30, or "
                                    "X=10,C=90 (rotary axes in degrees)");
}

}  // namespace

Result<Machine> described_machine(const std::string& file) {
  MDOF_TRY(const std::string text, read_text_file(file));
  MDOF_TRY(Machine machine, parse_machine(text, file));
  const auto folder = std::filesystem::path(file).parent_path();
  for (MachineFrame& frame : machine.frames) {
    if (!frame.file.empty()) MDOF_CHECK(read_shared_file(machine, frame, folder));
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (!frame.error[k].file.empty()) MDOF_CHECK(read_own_file(machine, frame, k, folder));
    turn_positioning(frame);
  }
  return machine;
}

Status add_stored_errors(Machine& machine, const std::string& database) {
  if (!machine.names_stored_rows()) return {};
  MDOF_TRY(store::Store store, open_to_read(database));
  MDOF_TRY(const auto stored, daemon::take_stored_errors(store, machine));
  show_notices(stored.notices, true);
  return {};
}

Result<Machine> load_machine(const std::string& file, const std::string& database) {
  MDOF_TRY(Machine machine, described_machine(file));
  MDOF_CHECK(add_stored_errors(machine, database));
  return machine;
}

void add_machine_argument(CLI::App& command, std::string& file) {
  command.add_option("MACHINE", file, "MACHINE.toml: the chain and the errors of its axes")
      ->required()
      ->type_name("");
}

void add_approach_option(CLI::App& command, std::string& approach) {
  command
      .add_option("--approach", approach,
                  "The way the axes have come, where tables distinguish them")
      ->check(CLI::IsMember({"mean", "forward", "reverse"}))
      ->capture_default_str();
}

algo::MachineApproach approach_from(const std::string& name) {
  return name == "forward"   ? algo::MachineApproach::forward
         : name == "reverse" ? algo::MachineApproach::reverse
                             : algo::MachineApproach::mean;
}

Result<algo::Command> command_from(const Machine& machine, const std::string& text) {
  algo::Command command{};
  std::string given;
  const auto words = CLI::detail::split(text, ',');
  const bool named = text.find('=') != std::string::npos;
  if (!named && words.size() != 3) return tl::unexpected(number_in("", text).error());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string letter = named ? words[i].substr(0, 1) : std::string(1, kAxisLetters[i]);
    if (named && words[i].substr(1, 1) != "=") return tl::unexpected(number_in("", text).error());
    MDOF_TRY(const double x, number_in(named ? words[i].substr(2) : words[i], text));
    const MachineFrame* frame = machine.find(letter);
    if (!frame || frame->kind == FrameKind::fixed)
      return bad_input("the chain " + machine.chain.text + " has no axis " + letter +
                       "; name those that it has, such as X=10,Y=20");
    if (given.find(letter) != std::string::npos)
      return fail(ErrorCode::usage,
                  "\"" + text + "\" gives axis " + letter + " twice; give it once");
    given += letter;
    command[kAxisLetters.find(letter)] = position_from_written(*frame, x);
  }
  return command;
}

void write_components(JsonWriter& json, const char* key, const algo::Vector6& error) {
  json.key(key).begin_object();
  for (int k = 0; k < 6; ++k) json.field(kComponents[k], to_key_unit(error[k]));
  json.end_object();
}

void write_command(JsonWriter& json, const char* key, const Machine& machine,
                   const algo::Command& command) {
  json.key(key).begin_object();
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind != FrameKind::fixed)
      json.field(frame.id + "_" + position_unit(frame),
                 written_position(frame, algo::command_of(frame, command)));
  json.end_object();
}

void warn_beyond(const std::vector<std::string>& names) {
  if (!names.empty())
    warn("beyond the ends of the tables of " + joined(names) + ": the value of the end is held");
}

std::string missing_text(const std::vector<std::string>& not_measured,
                         const std::vector<std::string>& no_u, std::size_t width) {
  std::string text;
  if (!not_measured.empty())
    text +=
        wrapped("not measured, and not in these figures: " + joined(not_measured), width) + "\n";
  text += no_u.empty() ? "" : wrapped("u is without that of: " + joined(no_u), width) + "\n";
  return text;
}

}  // namespace mdof::tools
