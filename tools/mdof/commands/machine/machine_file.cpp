#include "tools/mdof/commands/machine/machine_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "daemon/measure/machine/machine_files.h"
#include "daemon/measure/machine/stored_errors.h"
#include "daemon/words/words.h"
#include "schema/base/files.h"
#include "schema/notice/notice_json.h"
#include "schema/units.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kAxisLetters = "XYZABC";

Result<double> number_in(const std::string& text, const std::string& whole) {
  double x = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, x);
  if (error == std::errc() && last == end && std::isfinite(x) && std::abs(x) < 1e6) return x;
  return fail(ErrorCode::usage, "\"" + whole +
                                    "\" is not a position; write X,Y,Z in mm, such as 10,20,30, or "
                                    "X=10,C=90 (rotary axes in degrees)");
}

}  // namespace

Result<Machine> described_machine(const std::string& file) {
  MDOF_TRY(DescribedMachine described, described_with_text(file));
  return std::move(described.machine);
}

Result<DescribedMachine> described_with_text(const std::string& file) {
  DescribedMachine described;
  MDOF_TRY(described.text, read_text_file(file));
  MDOF_TRY(described.machine, parse_machine(described.text, file));
  MDOF_TRY(const std::string hashes,
           daemon::read_machine_files(described.machine, daemon::files_in_same_folder(file)));
  described.text += hashes;
  return described;
}

Status add_stored_errors(Machine& machine, const std::string& database) {
  if (!machine.names_stored_rows()) return {};
  MDOF_TRY(store::Store store, open_to_read(database));
  MDOF_TRY(const auto stored, daemon::read_stored_errors(store, machine));
  machine.notices = daemon::all_notices(stored);
  show_notices(machine.notices, true);
  return {};
}

Result<Machine> load_machine(const std::string& file, const std::string& database) {
  MDOF_TRY(Machine machine, described_machine(file));
  MDOF_CHECK(add_stored_errors(machine, database));
  return machine;
}

void add_machine_argument(CLI::App& command, std::string& file) {
  command
      .add_option("MACHINE", file,
                  "MACHINE.toml: kinematic chain of the machine and errors of the axes")
      ->required()
      ->type_name("");
}

void add_approach_option(CLI::App& command, std::string& approach) {
  command
      .add_option("--approach", approach,
                  "Approach whose errors mdof uses: forward, reverse, or the mean of both")
      ->check(CLI::IsMember({"mean", "forward", "reverse"}))
      ->capture_default_str();
}

algo::MachineApproach approach_from(const std::string& name) {
  return name == "forward"   ? algo::MachineApproach::forward
         : name == "reverse" ? algo::MachineApproach::reverse
                             : algo::MachineApproach::mean;
}

std::string approach_text(const Machine& machine, algo::MachineApproach approach) {
  const auto depends = [](const ErrorFunction& error) { return !error.reverse.empty(); };
  const bool any =
      std::any_of(machine.frames.begin(), machine.frames.end(), [&](const MachineFrame& frame) {
        return std::any_of(frame.error.begin(), frame.error.end(), depends);
      });
  if (!any) return "";
  return approach == algo::MachineApproach::forward ? "approach: forward\n"
         : approach == algo::MachineApproach::reverse
             ? "approach: reverse\n"
             : "approach: mean of forward and reverse (other values: --approach)\n";
}

Result<algo::Command> command_from(const Machine& machine, const std::string& text) {
  algo::Command command{};
  std::string given;
  const auto words = CLI::detail::split(text, ',');
  const bool named = text.find('=') != std::string::npos;
  if (!named && words.size() != 3) return tl::unexpected(number_in("", text).error());
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (named && (words[i].size() < 3 || words[i][1] != '='))
      return tl::unexpected(number_in("", text).error());
    const std::string letter = named ? words[i].substr(0, 1) : std::string(1, kAxisLetters[i]);
    MDOF_TRY(const double x, number_in(named ? words[i].substr(2) : words[i], text));
    const MachineFrame* frame = machine.find(letter);
    if (!frame || frame->kind == FrameKind::fixed)
      return bad_input("the chain " + machine.chain.text + " has no axis " + letter +
                       "; give only axes of the chain, such as X=10,Y=20");
    if (given.find(letter) != std::string::npos)
      return fail(ErrorCode::usage,
                  "\"" + text + "\" gives axis " + letter + " twice; give each axis once");
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

void write_stored_notices(JsonWriter& json, const Machine& machine) {
  write_notices(json, "notices", machine.notices, words::text);
}

void warn_outside_tables(const std::vector<std::string>& names) {
  if (!names.empty())
    warn("positions are beyond the ends of the error tables of " + joined(names) +
         "; there, mdof uses the value at the nearest end of each table");
}

std::string missing_text(const std::vector<std::string>& not_measured,
                         const std::vector<std::string>& no_u, std::size_t width) {
  std::string text;
  if (!not_measured.empty())
    text += wrapped("these errors were not measured, so the values do not contain them: " +
                        joined(not_measured),
                    width) +
            "\n";
  text += no_u.empty() ? ""
                       : wrapped(
                             "u of the result does not include these errors, because no u is "
                             "declared for them: " +
                                 joined(no_u),
                             width) +
                             "\n";
  return text;
}

}  // namespace mdof::tools
