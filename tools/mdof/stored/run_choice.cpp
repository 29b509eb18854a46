#include "tools/mdof/stored/run_choice.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "tools/mdof/stored/database.h"

namespace mdof::tools {
namespace {

constexpr const char* kLatest = "latest";
constexpr std::int64_t kPage = 50;

std::int64_t number_of(const std::string& word) {
  std::int64_t n = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
  return error == std::errc() && end == word.data() + word.size() && n > 0 ? n : 0;
}

tl::unexpected<Error> no_run(const store::Store& store, std::optional<Axis> axis) {
  return fail(ErrorCode::not_found, store.file().string() + ": the database has no run" +
                                        (axis ? std::string(" of axis ") + letter(*axis) : "") +
                                        " that has ended; see mdof runs");
}

Result<std::int64_t> latest(store::Store& store, std::optional<Axis> axis) {
  for (std::int64_t offset = 0;; offset += kPage) {
    MDOF_TRY(const auto runs, store.list_runs(offset, kPage, axis));
    for (const auto& header : runs)
      if (header.state != RunState::open) return header.id;
    if (runs.empty()) return no_run(store, axis);
  }
}

}  // namespace

std::string run_argument_error(const std::string& word) {
  if (word == kLatest || number_of(word) > 0) return "";
  return "\"" + word + "\" is not a run; give the number of a run (see mdof runs), or \"latest\"";
}

CLI::Option* add_run_argument(CLI::App& command, const char* name, std::string& run,
                              const char* what) {
  return command.add_option(name, run, what)->required()->type_name("")->check(run_argument_error);
}

CLI::Option* add_run_arguments(CLI::App& command, std::vector<std::string>& runs,
                               const char* what) {
  return command.add_option("RUN", runs, what)
      ->required()
      ->type_name("")
      ->check(run_argument_error);
}

void add_latest_axis_option(CLI::App& command, std::string& axis) {
  command.add_option("--axis", axis, "Axis of the run, if the run is \"latest\"")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
}

Result<std::int64_t> run_number(store::Store& store, const std::string& run,
                                std::optional<Axis> axis) {
  if (run == kLatest) return latest(store, axis);
  const std::int64_t id = number_of(run);
  if (axis) {
    MDOF_TRY(const RunHeader header, store.run_header(id));
    if (header.axis != *axis)
      return bad_input("run " + run + " measures axis " + letter(header.axis) + ", not axis " +
                       letter(*axis) + "; give a run of the wanted axis (mdof runs --axis " +
                       letter(*axis) + ")");
  }
  return id;
}

Result<std::int64_t> run_number(const std::string& database, const std::string& run,
                                std::optional<Axis> axis) {
  if (run != kLatest && !axis) return number_of(run);
  MDOF_TRY(store::Store store, open_to_read(database));
  return run_number(store, run, axis);
}

Result<std::array<std::int64_t, 2>> run_pair(const std::string& database,
                                             const std::array<std::string, 2>& runs,
                                             const std::string& axes) {
  std::array<std::int64_t, 2> pair{};
  for (std::size_t i = 0; i < pair.size(); ++i) {
    std::optional<Axis> axis;
    if (!axes.empty())
      axis = axis_from(axes.substr(i, 1));
    else if (runs[i] == kLatest)
      axis = i == 0 ? Axis::x : Axis::y;
    MDOF_TRY(pair[i], run_number(database, runs[i], axis));
  }
  return pair;
}

void add_axes_option(CLI::App& command, std::string& axes) {
  command
      .add_option("--axes", axes,
                  "Axes of the two runs [default: from the runs; for \"latest\": X, then Y]")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}));
}

}  // namespace mdof::tools
